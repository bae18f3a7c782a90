"""Turns what users give into arrays that the engine takes, without a copy where the types are right already."""

import numpy as np

from .errors import InputError


def points(values, what):
    """Points as an (n, 3) array of doubles."""
    array = _array(values, what, "three coordinates for each")
    if array.size == 0:
        return np.empty((0, 3))
    if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"the {what} are not an array of shape (n, 3)", remedy="give three numbers for each")
    return np.ascontiguousarray(array, np.float64)


def numbers(values, what):
    """Numbers as an (n,) array of doubles."""
    array = _array(values, what, "a list of numbers")
    if array.dtype.kind not in "fiu" or array.ndim != 1:
        raise InputError(f"the {what} are not a list of numbers", remedy="give one number for each")
    return np.ascontiguousarray(array, np.float64)


def indices(values, columns, what):
    """Rows of indices from 0 as an (n, columns) array of 32 bits; columns 0: a list."""
    array = _array(values, what, "whole numbers")
    if array.size == 0:
        array = np.empty((0, columns) if columns else 0, np.uint32)
    if array.dtype.kind not in "iu" or array.shape[1:] != ((columns,) if columns else ()):
        shape = f"(n, {columns})" if columns else "(n,)"
        raise InputError(f"the {what} are not whole numbers of shape {shape}", remedy="count the vertices from 0")
    return _within(array, np.uint32, what)


def markers(values, what):
    """Markers as an (n,) array of 32 bits; None: none."""
    array = _array([] if values is None else values, what, "whole numbers")
    if array.size == 0:
        return np.empty(0, np.int32)
    if array.dtype.kind not in "iub" or array.ndim != 1:
        raise InputError(f"the {what} are not a list of whole numbers", remedy="give one for each, or none")
    return _within(array, np.int32, what)


def _array(values, what, wanted):
    try:
        array = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise InputError(f"the {what} are not an array: {error}", remedy=f"give {wanted}") from None
    return array


def _within(array, kind, what):
    bounds = np.iinfo(kind)
    if array.size and not (bounds.min <= array.min() and array.max() <= bounds.max):
        raise InputError(f"one of the {what} is out of range",
                         remedy=f"give numbers from {bounds.min} to {bounds.max}")
    return np.ascontiguousarray(array, kind)
