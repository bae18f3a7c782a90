"""The exact check of a mesh against its input."""

import math
import os
from dataclasses import dataclass

from . import _engine
from .errors import InputError, Place
from .surface import as_surface


@dataclass(frozen=True)
class Check:
    """One property of a mesh that was checked."""

    name: str
    """such as "positive orientation" """
    checked: int
    failed: int
    is_required: bool
    """the mesh is wrong if this fails"""
    examples: list
    """the first failures in words, with coordinates"""
    not_compared: str
    """why there was nothing to check, although the input asks for it; usually empty"""


@dataclass(frozen=True)
class Verification:
    """Whether a mesh is right for its input."""

    checks: list
    """each a ccdt.Check"""
    mesh_volume: float
    input_volume: float
    to_input: float
    """no point of the mesh's surface is farther from the input's, with ``within``; otherwise None"""
    from_input: float
    """no point of the input's surface is farther from the mesh's, with ``within``; otherwise None"""

    @property
    def ok(self):
        """The mesh is right."""
        return not self.problems

    @property
    def problems(self):
        """The checks that make the mesh wrong."""
        return [check for check in self.checks if check.is_required and check.failed]


def verify(mesh, input, /, *, flatness=_engine.usual_flatness, constrained_delaunay="claimed", surface="same", within=None,
           boundary="keep", periodic="none", lists="all", threads=None, progress=None):
    """Checks exactly that a mesh, made by any mesher, is right for its input.

    It decides by CGAL's exact kernel and shares no predicate with the engine. The verdict is that of the program
    ``ccdt verify``.

    Args:
        mesh: a ccdt.Mesh, or a file with one
        input: what was meshed: anything that ccdt.mesh takes
        flatness: tolerance for flat facets and equal positions, as a fraction of the bounding box
        constrained_delaunay: whether the mesh must be constrained Delaunay: "claimed" (if it claims it), "yes", "no"
        surface: which surface the mesh must have: "same" as the input, or its "own", which encloses it once
        within: the mesh has its own surface, which is nowhere farther than this from that of the input
        boundary: where the input's vertices must be: "keep" (where they were), or "slide" (those inside flat facets
            and straight segments may have moved along them)
        periodic: axes along which opposite sides of the mesh must have the same faces, such as "x" or "xyz"
        lists: what the mesh must list: "all" (faces on facets, edges with markers), or "tetrahedra" alone
        threads: largest number of threads; default: all cores
        progress: as for ccdt.mesh

    Returns:
        a ccdt.Verification; a mesh that is wrong is no error

    Raises:
        InputError: a file cannot be read, the input cannot be compared, or an option is out of range
        NotImplementedError: this build of the package has no verifier
    """
    try:
        from . import _verify
    except ImportError as error:
        raise NotImplementedError("this build of ccdt has no verifier: use the program `ccdt verify`, or build the "
                                  "package where CGAL is installed") from error
    if not math.isfinite(flatness) or flatness < 0:
        raise InputError("flatness is not a number of at least 0", Place(), "leave it out")
    if within is not None and not (math.isfinite(within) and within > 0):
        raise InputError("within is not a number greater than 0", Place(), "leave it out")
    if threads is not None and threads < 1:
        raise InputError("threads is less than 1", Place(), "leave it out")
    if isinstance(mesh, (str, os.PathLike)):
        given = _engine.read_tet_mesh(os.fspath(mesh))
    else:
        given = mesh._mesh
    found = _verify.verify(as_surface(input)._plc, given, flatness, constrained_delaunay, surface, within, boundary,
                           periodic, lists, threads or 0, progress)
    return Verification(**{**found, "checks": [Check(*check) for check in found["checks"]]})
