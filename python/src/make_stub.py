"""Writes the stub of the package: make_stub.py TEMPLATE OUTPUT

In the template, @NAME@ stands for the keywords of the list functions.NAME.
"""

import re
import sys

from ccdt import functions
from ccdt.options import TABLE

OTHER_TYPES = {
    "sizes": "str | os.PathLike[str] | tuple[ArrayLike, ...] | None",
    "size_field": "str | os.PathLike[str] | dict[str, Any] | None",
    "size_function": "Callable[[NDArray[np.float64]], ArrayLike] | None",
    "progress": "Callable[[str, int, int], object] | None",
}


def type_of(name):
    if name in OTHER_TYPES:
        return OTHER_TYPES[name]
    option = TABLE[name]
    if set(option["choices"]) == {"on", "off"}:
        return "bool | None"
    if option["choices"]:
        return "Literal[" + ", ".join(f'"{choice}"' for choice in option["choices"]) + "] | None"
    return "int | None" if name == "threads" else "float | None"


def keywords(found):
    return "\n".join(f"    {name}: {type_of(name)} = ...," for name in getattr(functions, found[1]))


template, output = sys.argv[1:]
with open(template, encoding="utf-8") as file:
    text = re.sub(r"    @(\w+)@", keywords, file.read())
with open(output, "w", encoding="utf-8") as file:
    file.write(text)
