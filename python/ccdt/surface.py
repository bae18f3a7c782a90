"""Surfaces and piecewise linear complexes: what is meshed."""

import os

import numpy as np

from . import _engine, arrays
from .errors import InputError


class Surface:
    """Facets that bound a solid, or divide it: a piecewise linear complex.

    Args:
        vertices: (n, 3) array of coordinates, in any units
        faces: (m, 3) array of the vertices of triangles, counted from 0; or a list of m polygons, each a list of
            vertices in order
        markers: m whole numbers, one for each face; the faces of the mesh get them
        segments: (s, 2) array of edges that the mesh must have
        segment_markers: s whole numbers
        holes: (h, 3) array of points; what is around each of them stays empty
        regions: list of (point, number) or (point, number, largest volume); the tetrahedra around that point get the
            number
        names: dict from markers to names
        inside: "shells": what an odd number of shells separates from infinity is inside; "seeds": everything is that
            cannot be reached from infinity or a hole. Default: "seeds" if there are holes or regions

    Arrays of a surface share its memory. Do not change them while a function uses the surface.
    """

    def __init__(self, vertices, faces, *, markers=None, segments=None, segment_markers=None, holes=None, regions=None,
                 names=None, inside=None):
        plc = _engine.Surface()
        plc.vertices = arrays.points(vertices, "vertices")
        _set_faces(plc, faces, arrays.markers(markers, "markers"))
        plc.segments = arrays.indices([] if segments is None else segments, 2, "segments")
        plc.segment_markers = arrays.markers(segment_markers, "markers of segments")
        plc.holes = arrays.points([] if holes is None else holes, "holes")
        for region in [] if regions is None else regions:
            plc.add_region(_region(*region))
        plc.names = {} if names is None else dict(names)
        if inside not in (None, "shells", "seeds"):
            raise InputError(f"inside cannot be {inside!r}", remedy="give 'shells' or 'seeds'")
        has_seeds = len(plc.holes) > 0 or len(plc.regions) > 0
        plc.is_by_seeds = inside == "seeds" or (inside is None and has_seeds)
        self._plc = plc

    @classmethod
    def _of(cls, plc):
        surface = cls.__new__(cls)
        surface._plc = plc
        return surface

    @property
    def vertices(self):
        """(n, 3) array of coordinates."""
        return self._plc.vertices

    @property
    def triangles(self):
        """(m, 3) array of the vertices of triangles."""
        return self._plc.triangles

    @property
    def markers(self):
        """Markers of the triangles; empty: none."""
        return self._plc.triangle_markers

    @property
    def polygons(self):
        """Other facets: each is a list of loops of vertices."""
        return self._plc.polygons

    @property
    def polygon_markers(self):
        """Markers of the other facets."""
        return self._plc.polygon_markers

    @property
    def segments(self):
        """(s, 2) array of the vertices of segments."""
        return self._plc.segments

    @property
    def segment_markers(self):
        """Markers of the segments; empty: none."""
        return self._plc.segment_markers

    @property
    def holes(self):
        """(h, 3) array of points in holes."""
        return self._plc.holes

    @property
    def regions(self):
        """List of (point, number, largest volume); 0: any volume."""
        return self._plc.regions

    @property
    def names(self):
        """Names of markers, where the file has some."""
        return self._plc.names

    @property
    def notes(self):
        """What was unusual in the file but was understood; a sentence each."""
        return self._plc.notes

    def __repr__(self):
        name = f"{self._plc.name}: " if self._plc.name else ""
        return f"<ccdt.Surface {name}{len(self.vertices)} vertices, {len(self.triangles) + len(self.polygons)} facets>"


def from_trimesh(mesh):
    """The surface of a ``trimesh.Trimesh``, or of anything with ``vertices`` and triangles in ``faces``."""
    return Surface(mesh.vertices, np.asarray(mesh.faces))


def from_pyvista(mesh):
    """The surface of a ``pyvista.PolyData``, or the boundary of another data set of pyvista."""
    if not hasattr(mesh, "faces") or not hasattr(mesh, "verts"):
        mesh = mesh.extract_surface()
    flat = np.asarray(mesh.faces)  # of each polygon the number of its vertices, then these
    if len(flat) % 4 == 0 and (flat[::4] == 3).all():
        return Surface(mesh.points, flat.reshape(-1, 4)[:, 1:])
    faces, i = [], 0
    while i < len(flat):
        faces.append(flat[i + 1:i + 1 + flat[i]])
        i += 1 + flat[i]
    return Surface(mesh.points, faces)


def from_meshio(mesh):
    """The polygons of a ``meshio.Mesh``."""
    blocks = [block for block in mesh.cells if block.type in ("triangle", "quad", "polygon")]
    if len({block.type for block in blocks}) == 1 and blocks[0].type != "polygon":
        return Surface(mesh.points, np.vstack([block.data for block in blocks]))
    return Surface(mesh.points, [face for block in blocks for face in block.data])


def as_surface(thing, faces=None, **parts):
    """
    :param thing: vertices, if there are faces; else a file, a Surface, or an object of trimesh, pyvista or meshio
    :raises TypeError: it is nothing of that kind
    """
    if faces is not None:
        return Surface(thing, faces, **parts)
    if parts:
        raise TypeError(f"{next(iter(parts))!r} can be given only with vertices and faces")
    if isinstance(thing, Surface):
        return thing
    if isinstance(thing, (str, os.PathLike)):
        return Surface._of(_engine.read_plc(os.fspath(thing)))
    if hasattr(thing, "points") and hasattr(thing, "cells_dict") and hasattr(thing, "point_data") \
            and not hasattr(thing, "n_points"):
        return from_meshio(thing)
    if hasattr(thing, "points") and hasattr(thing, "n_points"):
        return from_pyvista(thing)
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        return from_trimesh(thing)
    raise TypeError(f"{type(thing).__name__} is no surface: give vertices and faces, a file, or a ccdt.Surface")


def _region(seed, number, largest_volume=0.0):
    return tuple(seed), number, largest_volume


def _set_faces(plc, faces, markers):
    is_array = isinstance(faces, np.ndarray) and faces.ndim == 2
    if not is_array and not all(hasattr(face, "__len__") for face in faces):
        raise InputError("the faces are not lists of vertices", remedy="give the vertices of each face")
    if faces.shape[1] == 3 if is_array else all(len(face) == 3 for face in faces):
        plc.triangles = arrays.indices(faces, 3, "faces")
        plc.triangle_markers = markers
        return
    if len(markers) not in (0, len(faces)):
        raise InputError("some faces have no marker", remedy="give none, or one for each")
    corners = [arrays.indices(face, 0, "faces") for face in faces]
    plc.add_polygons(np.concatenate(corners), np.cumsum([len(c) for c in corners], dtype=np.uint64), markers)
