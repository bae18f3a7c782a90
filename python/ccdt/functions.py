"""What the package does: reading, checking, repairing, meshing, improving and writing."""

import os
from dataclasses import dataclass

from . import _engine
from .options import EXTRA, TABLE, engine_options, takes_options
from .surface import Surface, as_surface
from .tet_mesh import Mesh

MESH_OPTIONS = [*TABLE, *EXTRA]
IMPROVE_OPTIONS = ["improve", "objective", "target_dihedral", "target_r", "improve_time", "threads", "progress"]
REMESH_OPTIONS = ["sharp_angle", "deviation", "flatness", "sizes", "size_field", "curvature_angle",
                  "elements_through", "size_function", "progress"]


@takes_options(*MESH_OPTIONS)
def mesh(input, /, faces=None, *, markers=None, segments=None, segment_markers=None, holes=None, regions=None,
         names=None, inside=None, **options):
    """Fills a solid with tetrahedra.

    ``ccdt.mesh("part.stl", edge_length=2)`` meshes a file, ``ccdt.mesh(vertices, faces)`` arrays. For the same input
    and options, the mesh is that of the program ``ccdt mesh``, on any number of threads.

    Args:
        input: a file, a ccdt.Surface, or a surface of trimesh, pyvista or meshio; with ``faces``, an (n, 3) array of
            vertices
        faces, markers, segments, segment_markers, holes, regions, names, inside: as for ccdt.Surface

    Options, all with the names of the command line; None stands for the default:

    OPTIONS

    Returns:
        a ccdt.Mesh, in the units of the input

    Raises:
        InputError: the input is not valid, or an option is out of range; ccdt.check says more, ccdt.repair may help
        LimitError: a limit of time, memory, tetrahedra or subdivision was reached
        MeshError: no valid mesh was found
        TypeError: there is no such option
        KeyboardInterrupt: Ctrl-C was pressed; all memory is released
    """
    chosen = engine_options(options, MESH_OPTIONS)
    parts = {"markers": markers, "segments": segments, "segment_markers": segment_markers, "holes": holes,
             "regions": regions, "names": names, "inside": inside}
    given = as_surface(input, faces, **{name: part for name, part in parts.items() if part is not None})
    return Mesh._of(*_engine.mesh(given._plc, chosen, options.get("progress")))


@takes_options(*IMPROVE_OPTIONS)
def improve(mesh, **options):
    """Improves a tetrahedral mesh from anywhere. Its faces, boundary, regions and listed edges stay.

    Args:
        mesh: a ccdt.Mesh, which does not change

    Options:

    OPTIONS

    Returns:
        a new ccdt.Mesh; its ``counts`` say what was done

    Raises:
        InputError: it is no conforming mesh, or an option is out of range
    """
    chosen = engine_options(options, IMPROVE_OPTIONS)
    return Mesh._of(*_engine.improve(mesh._mesh, chosen, options.get("progress")))


@takes_options(*REMESH_OPTIONS)
def remesh(surface, edge_length, **options):
    """Makes a new surface of nearly equilateral triangles that follows the old one. Sharp edges stay.

    Args:
        surface: anything that ccdt.mesh takes
        edge_length: of the new triangles, in the units of the input

    Options:

    OPTIONS

    Returns:
        a ccdt.Surface

    Raises:
        InputError: the input is not valid, or an option is out of range
        MeshError: no valid surface was found at this edge length
    """
    chosen = engine_options(options, REMESH_OPTIONS)
    if edge_length != 0:  # which the engine refuses itself, as none was given
        chosen.set("edge-length", repr(float(edge_length)))
    return Surface._of(_engine.remesh(as_surface(surface)._plc, chosen, options.get("progress")))


@dataclass(frozen=True)
class Fault:
    """All faults of one kind in an input."""

    kind: str
    """such as "open-edges" """
    what: str
    """what is counted"""
    is_error: bool
    """the input cannot be meshed; otherwise it can, but may be wrong"""
    count: int
    at_least: bool
    """there may be more"""
    detail: str
    places: list
    """of the first ones: each a ccdt.Place"""


@dataclass(frozen=True)
class Diagnosis:
    """What an input is, and what is wrong with it."""

    is_valid: bool
    """it can be meshed"""
    faults: list
    """each a ccdt.Fault; errors first"""
    vertices: int
    facets: int
    segments: int
    regions: int
    """parts that facets divide the domain into, of a valid input"""
    volume: float
    """of the domain, in the units of the input cubed, of a valid input"""


def check(surface, *, flatness=_engine.usual_flatness, progress=None):
    """Lists everything that is wrong with an input.

    Args:
        surface: anything that ccdt.mesh takes
        flatness: tolerance for flat facets, as a fraction of the bounding box
        progress: as for ccdt.mesh

    Returns:
        a ccdt.Diagnosis
    """
    found = _engine.check(as_surface(surface)._plc, flatness, progress)
    return Diagnosis(**{**found, "faults": [Fault(*fault) for fault in found["faults"]]})


@dataclass(frozen=True)
class RepairStep:
    """Something that was done to an input."""

    name: str
    what: str
    """what was counted"""
    count: int
    places: list
    """of the first ones: each a ccdt.Place"""


@dataclass(frozen=True)
class Repaired:
    """A repaired surface, and what was done."""

    surface: Surface
    """it may still have faults: ccdt.check"""
    steps: list
    """each a ccdt.RepairStep"""
    certificate: dict
    """how the surface differs from what was given: displacement, areas, volume, lids, components, genus"""
    refused: list
    """what the limits forbade, and what would allow it; empty if nothing"""
    is_out_of_time: bool


def repair(surface, *, gap=0, limit=0, time=0, flatness=_engine.usual_flatness, progress=None):
    """Repairs an input as far as possible without knowing what was meant.

    Closes gaps and small holes, removes duplicates, flaps and loose sheets, turns facets outward, and cuts facets that
    cross; of solids that overlap, the union is left.

    Args:
        surface: anything that ccdt.mesh takes
        gap: width of the widest gap to close, in the units of the input; 0: a ten-thousandth of the largest extent
        limit: how far lids may reach from the rims of their holes, and how far everything else may move, in the units
            of the input; 0: a thousandth of the largest extent for lids, a millionth for everything else
        time: seconds after which no further step is begun; 0: 20, and 1 for each 1,000 facets
        flatness: tolerance for flat facets, as a fraction of the bounding box
        progress: as for ccdt.mesh

    Returns:
        a ccdt.Repaired

    Raises:
        InputError: no facet has an area, or none encloses anything; or an argument is out of range
    """
    done = _engine.repair(as_surface(surface)._plc, flatness, gap, limit, time, progress)
    return Repaired(**{**done, "surface": Surface._of(done["surface"]),
                       "steps": [RepairStep(*step) for step in done["steps"]]})


def read(file):
    """Reads a surface or a piecewise linear complex. Of tetrahedra, the boundary is taken.

    Args:
        file: .stl .off .obj .ply .poly .smesh .node .mesh .meshb .msh .vtu .vtp, also with .gz

    Returns:
        a ccdt.Surface
    """
    return Surface._of(_engine.read_plc(os.fspath(file)))


def read_mesh(file):
    """Reads a tetrahedral mesh that any mesher wrote.

    Args:
        file: .vtu .msh .mesh .meshb .node

    Returns:
        a ccdt.Mesh
    """
    return Mesh._of(_engine.read_tet_mesh(os.fspath(file)))


def write(thing, file, *, format="", order=1):
    """Writes a mesh or a surface. The file appears completely or not at all.

    Args:
        thing: a ccdt.Mesh or a ccdt.Surface
        file: for a mesh .vtu .msh .msh4 .mesh .meshb .inp .xdmf .polymesh .node;
            for a surface .stl .off .obj .ply .poly .smesh .mesh .meshb
        format: of the mesh, if not that of the extension: "msh4" for Gmsh 4.1 in a file .msh
        order: 2 for elements with a node in the middle of each edge, in .msh .msh4 .vtu .inp .xdmf

    Raises:
        OutputError: it cannot be written, or the format cannot hold it
    """
    if isinstance(thing, Mesh):
        _engine.write_tet_mesh(thing._mesh, os.fspath(file), format, order)
    elif isinstance(thing, Surface):
        _engine.write_plc(thing._plc, os.fspath(file))
    else:
        raise TypeError(f"{type(thing).__name__} is neither a ccdt.Mesh nor a ccdt.Surface")
