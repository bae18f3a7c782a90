"""The options of the engine as keywords. Their names, values and meanings come from its one table."""

import difflib
import inspect
import json
import os
import re
import textwrap

import numpy as np

from . import _engine, arrays

TABLE = {option["name"].replace("-", "_"): option for option in _engine.option_table()}

# Keywords that only a library can have.
EXTRA = {
    "size_function": "function of an (n, 3) array of points, in the units of the input, that returns n edge lengths;\n"
                     "infinity where any length will do. It is called from any thread, with the GIL",
    "progress": "function of a stage's name, the amount done, and the total (0: unknown). It is called when a stage\n"
                "begins, and then at most twenty times a second. What it raises ends the work",
}


def takes_options(*names):
    """Gives a function, which ends in ``**options``, the signature and the description of these options."""

    def decorate(function):
        signature = inspect.signature(function)
        own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        keywords = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in names]
        function.__signature__ = signature.replace(parameters=own + keywords)
        listed = "".join(_description(name) for name in names)
        function.__doc__ = inspect.cleandoc(function.__doc__).replace("OPTIONS", listed.rstrip())
        return function

    return decorate


def engine_options(keywords, names):
    """
    :param names: those that the function has
    :raises TypeError: for a keyword that is not among them; names the nearest
    :raises InputError: for a value that the option cannot have
    """
    options = _engine.Options()
    # A number that is given replaces that of a size field.
    for name, value in sorted(keywords.items(), key=lambda item: item[0] != "size_field"):
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            raise TypeError(f"there is no option {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))
        if value is None or name == "progress":
            continue
        setter = {"sizes": _set_sizes, "size_field": _set_field, "size_function": _set_function}.get(name)
        setter(options, value) if setter else options.set(name, _text_of(value))
    return options


def _text_of(value):
    """A value as on the command line."""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (int, float, np.number)):
        number = float(value)
        return str(int(number)) if number.is_integer() and abs(number) < 2**53 else repr(number)
    return str(value)


def _set_sizes(options, sizes):
    if isinstance(sizes, (str, os.PathLike)):
        options.read_background(os.fspath(sizes))
        return
    vertices, *tetrahedra, lengths = sizes
    options.set_background(arrays.points(vertices, "places of sizes"),
                           arrays.indices(tetrahedra[0] if tetrahedra else [], 4, "tetrahedra of sizes"),
                           arrays.numbers(lengths, "sizes"))


def _set_field(options, field):
    """A size field is a file or a dict as the schema ccdt.sizefield/1 says."""
    if isinstance(field, (str, os.PathLike)):
        options.set_field_name(os.fspath(field))
        with open(field, encoding="utf-8") as file:
            field = json.load(file)
    field = {key: value for key, value in field.items() if key not in ("$schema", "schema", "what")}
    for size in field.pop("sizes", []):
        size = dict(size)
        places = size.pop("markers", [])
        size["markers"] = [m for m in places if not isinstance(m, str)]
        size["names"] = [m for m in places if isinstance(m, str)]
        size["boxes"] = [(box["low"], box["high"]) for box in size.get("boxes", [])]
        size["balls"] = [(ball["center"], ball["radius"]) for ball in size.get("balls", [])]
        options.add_size(**size)
    for name, value in field.items():
        options.set(name, _text_of(value))


def _set_function(options, function):
    if not callable(function):
        raise TypeError("size_function must be a function of an (n, 3) array")
    options.set_function(function)


def _description(name):
    if name in EXTRA:
        return f"{name}:\n{textwrap.indent(EXTRA[name], '    ')}\n"
    option = TABLE[name]
    what = _in_keywords(option["what"])
    if name == "threads":
        what += "; default: all cores, or one where little is to be done"
    if name == "sizes":
        what += "; or (points, lengths), or (points, tetrahedra, lengths)"
    if name == "size_field":
        what += "; or such a dict"
    lines = textwrap.wrap(what, 92)
    lines += [f"  {choice!r}: {_in_keywords(meaning)}" for choice, meaning in option["choices"].items()]
    default = option["default"]
    shown = "" if default is None or option["is_file"] else f" (default {_shown(default)})"
    return f"{name}{shown}:\n" + textwrap.indent("\n".join(lines), "    ") + "\n"


def _shown(default):
    return f"{default:g}" if isinstance(default, float) else repr(default)


def _in_keywords(text):
    """The words of the command line in those of Python."""
    text = re.sub(r", with exit code \d", "", text).replace("\n", " ")
    text = re.sub(r"--([a-z-]+) ([a-z]+)", _as_keyword, text)
    return re.sub(r"--([a-z-]+)", lambda found: found[1].replace("-", "_"), text)


def _as_keyword(found):
    name, word = found[1].replace("-", "_"), found[2]
    is_value = name in TABLE and word in TABLE[name]["choices"]
    return f'{name}="{word}"' if is_value else f"{name} {word}"
