"""Tetrahedral meshes of solids.

    import ccdt

    mesh = ccdt.mesh("part.stl", edge_length=2, surface="refine")
    mesh.vertices, mesh.tetrahedra      # numpy arrays
    ccdt.write(mesh, "part.vtu")

``ccdt.check`` and ``ccdt.repair`` are for surfaces that cannot be meshed, ``ccdt.remesh`` makes new triangles, and
``ccdt.improve`` improves tetrahedra. ``ccdt.verify`` checks a mesh exactly. ``help(ccdt.mesh)`` lists all options.
"""

from ._engine import version as __version__
from .errors import Error, InputError, LimitError, MeshError, OutOfMemoryError, OutputError, Place
from .functions import (Diagnosis, Fault, Repaired, RepairStep, check, improve, mesh, read, read_mesh, remesh, repair,
                        write)
from .surface import Surface, from_meshio, from_pyvista, from_trimesh
from .tet_mesh import Mesh
from .verification import Check, Verification, verify

__all__ = [
    "Check", "Diagnosis", "Error", "Fault", "InputError", "LimitError", "Mesh", "MeshError", "OutOfMemoryError", "OutputError",
    "Place", "RepairStep", "Repaired", "Surface", "Verification", "check", "from_meshio", "from_pyvista", "from_trimesh", "improve",
    "mesh", "read", "read_mesh", "remesh", "repair", "verify", "write",
]
