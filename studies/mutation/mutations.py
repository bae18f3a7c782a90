"""Lists of mutations, and source text with all of them in it."""

import json
import os
import re
from pathlib import Path

SCHEMA = "ccdt.mutations/1"
SWITCH = Path("studies/mutation/is_on.h")
NEAR = 40  # lines between `near` and `find`, at most

FIELDS_OF_LIST = {"schema": str, "targets": list, "tests": str, "mutations": list}
FIELDS = {"id": str, "file": str, "find": str, "replace": str, "kind": str, "what": str}
MORE_FIELDS = {"near": str, "tests": str, "equivalent": str}


class Wrong(Exception):
    """A list is wrong, or no longer fits the source."""


def check_fields(value, required, optional, where):
    if not isinstance(value, dict):
        raise Wrong(f"{where}: not an object")
    for name in value.keys() - required.keys() - optional.keys():
        raise Wrong(f"{where}: unknown field \"{name}\"")
    for name, kind in (required | optional).items():
        if name in required and name not in value:
            raise Wrong(f"{where}: no field \"{name}\"")
        if name in value and not isinstance(value[name], kind):
            raise Wrong(f"{where}: \"{name}\" is not a {kind.__name__}")


def is_balanced(text):
    closing = {")": "(", "]": "[", "}": "{"}
    opened = []
    for letter in re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'|//.*', "", text):
        if letter in closing.values():
            opened.append(letter)
        elif letter in closing and (not opened or opened.pop() != closing[letter]):
            return False
    return not opened


def check_mutation(mutation):
    name = mutation["name"]
    if not re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", mutation["id"]):
        raise Wrong(f"{name}: ids are lowercase words with dashes")
    if mutation["kind"] not in ("expression", "statement"):
        raise Wrong(f"{name}: \"kind\" is \"expression\" or \"statement\"")
    for field in ("find", "replace"):
        text = mutation[field].strip()
        if not is_balanced(text):
            raise Wrong(f"{name}: \"{field}\" has a parenthesis or brace without the other")
        if mutation["kind"] == "expression" and (not text or text[-1] == ";"):
            raise Wrong(f"{name}: \"{field}\" is not an expression")
        if mutation["kind"] == "statement" and text[-1:] not in (";", "}") and (text or field == "find"):
            raise Wrong(f"{name}: \"{field}\" is not a statement: the last character is ; or }}")
    if mutation["find"] == mutation["replace"]:
        raise Wrong(f"{name}: nothing is replaced")
    try:
        re.compile(mutation["tests"])
    except re.error as error:
        raise Wrong(f"{name}: \"tests\": {error}")


def read_list(file):
    """The list of a file. Each mutation gets a `name`, LIST/ID, and the tests of the list if it has none of its own."""
    try:
        content = json.loads(file.read_text())
    except (OSError, ValueError) as error:
        raise Wrong(f"{file}: {error}")
    check_fields(content, FIELDS_OF_LIST, {}, file)
    if content["schema"] != SCHEMA:
        raise Wrong(f"{file}: the schema is not {SCHEMA}")
    for number, mutation in enumerate(content["mutations"]):
        check_fields(mutation, FIELDS, MORE_FIELDS, f"{file}, mutation {number}")
        mutation["name"] = f"{file.stem}/{mutation['id']}"
        mutation.setdefault("tests", content["tests"])
        check_mutation(mutation)
    names = [mutation["name"] for mutation in content["mutations"]]
    for name in names:
        if names.count(name) > 1:
            raise Wrong(f"{name}: two mutations have this id")
    return content


def place_of(text, mutation):
    """Where the mutation is in the text of its file: begin and end."""
    name, find, near = mutation["name"], mutation["find"], mutation.get("near")
    if near is None:
        if text.count(find) != 1:
            raise Wrong(f"{name}: \"find\" occurs {text.count(find)} times in {mutation['file']}")
        begin = text.index(find)
    else:
        if text.count(near) != 1:
            raise Wrong(f"{name}: \"near\" occurs {text.count(near)} times in {mutation['file']}")
        after = text.index(near) + len(near)
        begin = text.find(find, after)
        if begin < 0 or text.count("\n", after, begin) > NEAR:
            raise Wrong(f"{name}: \"find\" does not occur in {mutation['file']} in the {NEAR} lines after \"near\"")
    return begin, begin + len(find)


def switch(mutations, original):
    """The text of one place: a switch between the original and its mutations."""
    for mutation in reversed(mutations):
        on = f"::ccdt_mutations::is_on(\"{mutation['name']}\")"
        if mutation["kind"] == "expression":
            original = f"({on} ? ({mutation['replace']}) : ({original}))"
        else:
            original = f"{{ if ({on}) {{ {mutation['replace']} }} else {{ {original} }} }}"
    return original


def with_places(text, begin, end, places):
    """The text from begin to end, with switches at these places. The places are in order, outer ones first."""
    result = ""
    while places:
        place, (first, last) = places[0][1], places[0][0]
        mutations = [mutation for where, mutation in places if where == (first, last)]
        inside = [other for other in places[len(mutations):] if other[0][0] < last]
        for where, mutation in inside:
            if where[1] > last:
                raise Wrong(f"{mutation['name']} and {place['name']} overlap, and neither is inside the other")
        if len({mutation["kind"] for mutation in mutations}) > 1:
            raise Wrong(f"{place['name']}: a statement and an expression have the same place")
        result += text[begin:first] + switch(mutations, with_places(text, first, last, inside))
        begin, places = last, places[len(mutations) + len(inside):]
    return result + text[begin:end]


def rewrite(text, mutations):
    """The text of a file with all of these mutations; the environment variable CCDT_MUTATION selects one of them."""
    places = sorted(((place_of(text, mutation), mutation) for mutation in mutations),
                    key=lambda place: (place[0][0], -place[0][1]))
    to_switch = os.path.relpath(SWITCH, Path(mutations[0]["file"]).parent)
    return f"#include \"{to_switch}\"\n#line 1\n" + with_places(text, 0, len(text), places)


def rewrite_all(mutations, read):
    """The new text of every file that has mutations; `read` takes a file's name and returns its text."""
    files = {}
    for mutation in mutations:
        files.setdefault(mutation["file"], []).append(mutation)
    result = {}
    for file, of_file in files.items():
        if Path(file).suffix not in (".cpp", ".h"):
            raise Wrong(f"{of_file[0]['name']}: {file} is not C++")
        try:
            text = read(file)
        except (KeyError, OSError):
            raise Wrong(f"{of_file[0]['name']}: there is no file {file}")
        for mutation in of_file:
            mutation["line"] = text.count("\n", 0, place_of(text, mutation)[0]) + 1
        result[file] = rewrite(text, of_file)
    return result
