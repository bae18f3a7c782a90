"""How programs of simulation read the meshes that ccdt writes for them. Used by files_open_test.

Each function takes the folder with the mesh of the part of two_regions.py, and returns how many tetrahedra each region
has, and how many triangles each marker, or None if it is not their format.
"""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

# Pulls the part along x with 2 per area. The supports are sets of nodes, the load is on a surface, and each region has
# its own section, so all of them must be right for the stress to be the same everywhere. Poisson's ratio is 0.25.
CALCULIX_DECK = """*INCLUDE, INPUT=part.inp
*MATERIAL, NAME=STEEL
*ELASTIC
100., 0.25
*SOLID SECTION, ELSET=REGION_1, MATERIAL=STEEL
*SOLID SECTION, ELSET=REGION_20, MATERIAL=STEEL
*STEP
*STATIC
*BOUNDARY
MARKER_5, 1, 1
MARKER_3, 2, 2
MARKER_1, 3, 3
*DSLOAD
MARKER_6, P, -2.
*NODE PRINT, NSET=NALL
U
*EL PRINT, ELSET=REGION_1
S
*EL PRINT, ELSET=REGION_20
S
*SECTION PRINT, SURFACE=MARKER_7, NAME=MIDDLE
SOF
*END STEP
"""

# A case of OpenFOAM that solves nothing.
OPENFOAM_SETTINGS = {
    "controlDict": "application none; startTime 0; endTime 1; deltaT 1; writeInterval 1;",
    "fvSchemes": "divSchemes {} gradSchemes {} laplacianSchemes {}",
    "fvSolution": "",
}

READ_BY_DOLFINX = """
import collections, json
import dolfinx, dolfinx.io
from mpi4py import MPI
counts = {}
text = dolfinx.io.XDMFFile.Encoding.ASCII
with dolfinx.io.XDMFFile(MPI.COMM_WORLD, "part.xdmf", "r", text) as file:
    mesh = file.read_mesh(name="mesh")
    tags = {"tetra": file.read_meshtags(mesh, name="mesh")}
mesh.topology.create_connectivity(2, 3)
with dolfinx.io.XDMFFile(MPI.COMM_WORLD, "part.boundary.xdmf", "r", text) as file:
    tags["triangle"] = file.read_meshtags(mesh, name="mesh")
print(json.dumps({kind: collections.Counter(map(int, tag.values)) for kind, tag in tags.items()}))
"""

READ_BY_VTK = """
import collections, json, vtk
TETRAHEDRA, TRIANGLES = {"tetra": (10, 24)}, {"triangle": (5, 22)}  # linear and quadratic
counts = {}
for file, name, kinds in ("part.vtu", "region", TETRAHEDRA), ("part.boundary.vtu", "marker", TRIANGLES):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    values = grid.GetCellData().GetArray(name)
    for kind, types in kinds.items():
        counts[kind] = collections.Counter(int(values.GetValue(i)) for i in range(grid.GetNumberOfCells())
                                           if grid.GetCellType(i) in types)
print(json.dumps(counts))
"""

# A region of GetFEM holds elements, whose face has this number, and faces of elements, inside from both sides.
READ_BY_GETFEM = """
import collections, json
import getfem
NO_FACE = 65535
getfem.util_warning_level(0)
mesh = getfem.Mesh("import", "gmsh", "part.msh")
counts = {"tetra": {}, "triangle": {}}
for number in map(int, mesh.regions()):
    members = mesh.region(number)
    is_face = members[1] != NO_FACE
    faces = {tuple(sorted(mesh.pid_in_faces(member.reshape(2, 1)))) for member in members.T[is_face]}
    for kind, count in ("tetra", sum(~is_face)), ("triangle", len(faces)):
        if count > 0:
            counts[kind][number] = int(count)
print(json.dumps(counts))
"""


def run(*command, folder, environment=None):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace", cwd=folder,
                          env={**os.environ, **(environment or {})})


def rows_after(title, text):
    """The numbers below a title in CalculiX's results."""
    found = re.search(re.escape(title) + r"[^\n]*\n\s*\n((?:[ \d.E+-]+\n)*)", text)
    return [[float(word) for word in line.split()] for line in found[1].splitlines()] if found else []


def expect_close(found, wanted, what):
    if len(found) != len(wanted) or any(abs(a - b) > 2e-5 for a, b in zip(found, wanted)):
        raise SystemExit(f"CalculiX: {what} is {found}, not {wanted}")


def read_by_calculix(folder):
    """Solves a problem whose exact solution is linear, so that the stress is uniform."""
    if not (folder / "part.inp").exists():
        return None
    (folder / "deck.inp").write_text(CALCULIX_DECK)
    done = run("ccx", "deck", folder=folder)
    if not (folder / "deck.dat").exists():
        raise SystemExit(f"CalculiX ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    results = (folder / "deck.dat").read_text()
    inp = (folder / "part.inp").read_text()
    for node, *move in rows_after("displacements", results):
        x, y, z = map(float, re.search(rf"^{int(node)}, (.*), (.*), (.*)$", inp, re.MULTILINE).groups())
        expect_close(move, [0.02 * x, -0.005 * y, -0.005 * z], f"the displacement of node {int(node)}")
    counts = {"tetra": {}, "triangle": {}}
    for region in "1", "20":
        rows = rows_after(f"for set REGION_{region} ", results)
        for row in rows:
            expect_close(row[2:], [2, 0, 0, 0, 0, 0], f"the stress in element {int(row[0])}")
        counts["tetra"][region] = len({row[0] for row in rows})  # the others are other points of the same elements
    force = rows_after(" total surface force (fx,fy,fz)", results)
    expect_close([abs(x) for x in force[0][:3]] if force else [], [2, 0, 0], "the force between the regions")
    for marker, faces in re.findall(r"SURFACE, NAME=MARKER_(\d+)[^\n]*\n([^*]*)", inp):
        counts["triangle"][marker] = len(faces.splitlines())
    return counts


def read_by_openfoam(folder):
    if not (folder / "part.polymesh").exists():
        return None
    case = folder / "case"
    (case / "constant").mkdir(parents=True)
    (case / "system").mkdir()
    for name, text in OPENFOAM_SETTINGS.items():
        head = f"FoamFile {{ version 2.0; format ascii; class dictionary; object {name}; }}\n"
        (case / "system" / name).write_text(head + text + "\n")
    shutil.copytree(folder / "part.polymesh", case / "constant" / "polyMesh")
    environment = {"WM_PROJECT_DIR": "/usr/share/openfoam"} if Path("/usr/share/openfoam").exists() else {}
    done = run("checkMesh", "-allTopology", folder=case, environment=environment)
    said = done.stdout
    if "\nMesh OK." not in said or "Upper triangular ordering OK." not in said:
        raise SystemExit(f"OpenFOAM does not find the mesh right:\n{said}{done.stderr}")
    labels = [re.search(r"\n\(\n([^)]*)", (folder / "part.polymesh" / name).read_text())[1].split()
              for name in ("owner", "neighbour")]
    pairs = [tuple(map(int, pair)) for pair in zip(*labels)]
    if pairs != sorted(pairs):  # checkMesh only compares the faces of each cell
        raise SystemExit("OpenFOAM: the faces inside are not in order")
    counts = {"tetra": {}, "triangle": {}}
    for name, number, count in re.findall(r"^\s*(REGION|MARKER)_(\d+)\s+(\d+)", said, re.MULTILINE):
        counts["tetra" if name == "REGION" else "triangle"].setdefault(number, int(count))
    return counts


def read_by_dolfinx(folder):
    if not (folder / "part.xdmf").exists():
        return None
    done = run("/usr/bin/python3", "-c", READ_BY_DOLFINX, folder=folder)
    if done.returncode != 0:
        raise SystemExit(f"dolfinx does not read the mesh:\n{done.stderr}")
    return json.loads(done.stdout)


def read_by_vtk(folder):
    if not (folder / "part.vtu").exists():
        return None
    done = run("/usr/bin/python3", "-c", READ_BY_VTK, folder=folder)
    if done.returncode != 0:
        raise SystemExit(f"VTK does not read the mesh:\n{done.stderr}")
    return json.loads(done.stdout)


def read_by_getfem(folder):
    """GetFEM reads Gmsh's format 2, and says what it does not know with an error."""
    if not (folder / "part.msh").exists():
        return None
    done = run("/usr/bin/python3", "-c", READ_BY_GETFEM, folder=folder)
    return json.loads(done.stdout.splitlines()[-1]) if done.returncode == 0 else None
