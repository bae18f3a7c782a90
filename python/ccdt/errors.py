"""The exceptions of the package."""

from typing import NamedTuple


class Place(NamedTuple):
    """Where in the user's data an error is. Every part may be missing."""

    file: str = ""
    """path as it was given"""
    line: int = 0
    """line of a text file, from 1; 0: unknown"""
    byte: int = -1
    """offset in a binary file; -1: unknown"""
    points: list = []
    """coordinates, in the units of the input"""
    facets: list = []
    """numbers of input facets, from 0"""


class Error(Exception):
    """The base of all errors of the package.

    Attributes:
        place: a Place
        remedy: what to do next; one sentence
    """

    def __init__(self, what, place=Place(), remedy=""):
        super().__init__(what, place, remedy)
        self.what = what
        self.place = place
        self.remedy = remedy

    def __str__(self):
        where = self.place.file + (f":{self.place.line}" if self.place.line > 0 else "")
        parts = ([f"{where}: {self.what}"] if where else [self.what]) + [f"at {p}" for p in self.place.points[:3]]
        return "; ".join(parts) + (f" ({self.remedy})" if self.remedy else "")


class InputError(Error, ValueError):
    """The input cannot be read, is not valid, or an option is out of range."""


class OutputError(Error):
    """The result cannot be written."""


class LimitError(Error):
    """A limit of time, memory or subdivision was reached."""


class OutOfMemoryError(LimitError, MemoryError):
    """There is not enough memory."""


class MeshError(Error):
    """No valid mesh or surface was found."""
