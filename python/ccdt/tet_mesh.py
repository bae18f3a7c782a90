"""Tetrahedral meshes: what meshing makes."""

import numpy as np

from . import _engine, arrays
from .verification import verify


class Mesh:
    """A tetrahedral mesh.

    Args:
        vertices: (n, 3) array of coordinates
        tetrahedra: (m, 4) array of the vertices of tetrahedra, counted from 0
        regions: m whole numbers, one for each tetrahedron
        faces: (f, 3) array of faces to keep, such as the boundary
        face_markers: f whole numbers
        edges: (e, 2) array of edges to keep
        edge_markers: e whole numbers
        names: dict from face markers to names

    Arrays of a mesh share its memory: nothing is copied, and each array keeps what it needs alive.

    Attributes:
        counts: dict of what was counted; empty for a mesh from elsewhere
        seconds: dict of what each stage took; empty for a mesh from elsewhere
    """

    def __init__(self, vertices, tetrahedra, *, regions=None, faces=None, face_markers=None, edges=None,
                 edge_markers=None, names=None):
        mesh = _engine.TetMesh()
        mesh.vertices = arrays.points(vertices, "vertices")
        mesh.tetrahedra = arrays.indices(tetrahedra, 4, "tetrahedra")
        mesh.regions = arrays.markers(regions if regions is not None else [0] * len(mesh.tetrahedra), "regions")
        mesh.faces = arrays.indices([] if faces is None else faces, 3, "faces")
        mesh.face_markers = arrays.markers(face_markers, "markers of faces")
        mesh.edges = arrays.indices([] if edges is None else edges, 2, "edges")
        mesh.edge_markers = arrays.markers(
            edge_markers if edge_markers is not None else [0] * len(mesh.edges), "markers of edges")
        mesh.names = {} if names is None else dict(names)
        self._mesh, self.counts, self.seconds = mesh, {}, {}

    @classmethod
    def _of(cls, mesh, counts=None, seconds=None):
        result = cls.__new__(cls)
        result._mesh, result.counts, result.seconds = mesh, counts or {}, seconds or {}
        return result

    @property
    def vertices(self):
        """(n, 3) array of coordinates, in the units of the input."""
        return self._mesh.vertices

    @property
    def tetrahedra(self):
        """(m, 4) array of the vertices of tetrahedra; positive: ((b - a) x (c - a)) . (d - a) > 0."""
        return self._mesh.tetrahedra

    @property
    def regions(self):
        """(m,) array: the number of each tetrahedron's region."""
        return self._mesh.regions

    @property
    def faces(self):
        """(f, 3) array of the faces on facets: the boundary, and interior facets."""
        return self._mesh.faces

    @property
    def face_markers(self):
        """(f,) array: the marker of each face; empty: unknown."""
        return self._mesh.face_markers

    @property
    def edges(self):
        """(e, 2) array of the edges on segments."""
        return self._mesh.edges

    @property
    def edge_markers(self):
        """(e,) array: the marker of each edge."""
        return self._mesh.edge_markers

    @property
    def names(self):
        """Names of face markers."""
        return self._mesh.names

    def dihedral_angles(self):
        """(m, 6) array of angles in degrees, at the edges 01, 02, 03, 12, 13, 23 of each tetrahedron."""
        return _engine.dihedral_angles(self._mesh)

    def shape_measures(self):
        """(m,) array of the measure r: 1 for the regular tetrahedron, larger for all others, infinite for a flat one."""
        return _engine.shape_measures(self._mesh)

    def aspect_ratios(self):
        """(m,) array: the longest edge over 2 sqrt(6) inradii; 1 for the regular tetrahedron."""
        return _engine.aspect_ratios(self._mesh)

    def radius_edge_ratios(self):
        """(m,) array: the circumradius over the shortest edge; 0.612 for the regular tetrahedron."""
        return _engine.radius_edge_ratios(self._mesh)

    def volumes(self):
        """(m,) array, in the units of the input cubed; negative where a tetrahedron is inverted."""
        return _engine.volumes(self._mesh)

    def verify(self, input, /, **options):
        """Checks exactly that the mesh is right for its input: ``ccdt.verify(self, input, **options)``."""
        return verify(self, input, **options)

    def to_meshio(self):
        """A ``meshio.Mesh`` of tetrahedra, then triangles, with their numbers and markers as ``ccdt``."""
        import meshio

        cells = [("tetra", self.tetrahedra.astype(np.int64))]  # its writers take no others
        data = [self.regions]
        if len(self.faces):
            cells.append(("triangle", self.faces.astype(np.int64)))
            data.append(self.face_markers if len(self.face_markers) else np.zeros(len(self.faces), np.int32))
        return meshio.Mesh(self.vertices, cells, cell_data={"ccdt": data})

    def to_pyvista(self):
        """A ``pyvista.UnstructuredGrid`` of the tetrahedra, with the cell data ``region``."""
        import pyvista

        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: self.tetrahedra}, self.vertices)
        grid.cell_data["region"] = self.regions
        return grid

    def __repr__(self):
        return f"<ccdt.Mesh {len(self.vertices)} vertices, {len(self.tetrahedra)} tetrahedra>"
