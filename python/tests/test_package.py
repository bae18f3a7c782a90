"""Errors, options, files, repair, improvement, and other people's objects."""

import inspect
import pathlib
import pickle
import random
import re
import subprocess
import sys
import types

import numpy as np
import pytest

import ccdt
from ccdt.options import TABLE


def test_errors_have_a_place_and_a_remedy(cube, tmp_path):
    vertices, faces = cube
    with pytest.raises(ccdt.InputError) as raised:
        ccdt.mesh(vertices, faces[:-1])
    assert raised.value.place.points and raised.value.remedy
    (tmp_path / "bad.off").write_text("OFF\n1 1 0\n0 0 zero\n3 0 0 0\n")
    with pytest.raises(ccdt.InputError) as raised:
        ccdt.read(tmp_path / "bad.off")
    assert raised.value.place.file.endswith("bad.off") and raised.value.place.line == 3
    with pytest.raises(ccdt.OutputError):
        ccdt.write(ccdt.mesh(vertices, faces), tmp_path / "mesh.unknown")
    with pytest.raises(ccdt.LimitError):
        ccdt.mesh(vertices, faces, edge_length=0.1, most_tetrahedra=10)
    assert issubclass(ccdt.InputError, ccdt.Error) and issubclass(ccdt.OutOfMemoryError, ccdt.LimitError)


def test_errors_can_be_pickled(cube):
    with pytest.raises(ccdt.InputError) as raised:
        ccdt.mesh(cube[0], cube[1][:-1])
    again = pickle.loads(pickle.dumps(raised.value))
    assert str(again) == str(raised.value) and again.place == raised.value.place


def test_an_unknown_option_names_the_nearest(cube):
    with pytest.raises(TypeError, match="edge_length"):
        ccdt.mesh(*cube, edge_lenght=0.3)
    with pytest.raises(TypeError):
        ccdt.improve(ccdt.mesh(*cube), surface="refine")


@pytest.mark.parametrize("options", [
    {"edge_length": -1}, {"edge_length": float("nan")}, {"edge_length": "long"}, {"surface": "shiny"},
    {"threads": 1.5}, {"threads": 0}, {"improve": True}, {"grading": -0.1}, {"sharp_angle": 180},
    {"sizes": ([[0, 0, 0]], [-1])}, {"sizes": ([[0, 0, 0]], [])},
    {"size_function": lambda points: np.zeros(len(points))},
])
def test_values_out_of_range_are_errors_of_the_input(cube, options):
    with pytest.raises(ccdt.InputError):
        ccdt.mesh(*cube, **options)


@pytest.mark.parametrize("vertices, faces, more", [
    ([[0, 0]], [[0, 0, 0]], {}),
    ([[0, 0, 0]], [[0, 0, 1]], {}),
    ([[0, 0, 0]], [[0, 0, -1]], {}),
    ([[0, 0, 0]], [[0.5, 0, 0]], {}),
    ([["a", "b", "c"]], [[0, 0, 0]], {}),
    ([[0, 0, np.nan]] * 4, [[0, 1, 2], [1, 2, 3]], {}),
    ([[0, 0, 0]] * 4, [[0, 1, 2]], {"markers": [1, 2]}),
    ([[0, 0, 0]] * 4, [[0, 1, 2]], {"markers": [2**40]}),
    ([[0, 0, 0]] * 4, [[0, 1, 2, 3], [0, 1]], {"markers": [1]}),
    ([], [], {}),
    ([[0, 0, 0]], [0, 0, 0], {}),
])
def test_arrays_that_are_no_surface_are_errors_of_the_input(vertices, faces, more):
    with pytest.raises(ccdt.InputError):
        ccdt.mesh(vertices, faces, **more)


def test_a_size_function_may_fail(cube):
    def fail(points):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        ccdt.mesh(*cube, surface="refine", edge_length=0.5, size_function=fail)
    with pytest.raises(ValueError):
        ccdt.mesh(*cube, surface="refine", edge_length=0.5, size_function=lambda points: [0.5])


def test_hostile_arguments_never_crash(cube):
    numbers = random.Random(1)
    values = [0, -1, 1, 0.5, 1e-9, 1e300, float("nan"), float("inf"), "", "on", "none", None, True, [], {}, np.int8(3)]

    def progress(stage, done, total):
        if progress.calls > 200:
            raise TimeoutError
        progress.calls += 1

    for _ in range(150):
        options = {numbers.choice(list(TABLE)): numbers.choice(values) for _ in range(2)}
        progress.calls = 0
        try:
            mesh = ccdt.mesh(*cube, progress=progress, **{"most_tetrahedra": 1e4, **options})
            assert mesh.volumes().sum() == pytest.approx(1)
        except (ccdt.Error, TypeError, ValueError, OSError, TimeoutError, AttributeError):
            pass


def test_help_lists_all_options_with_their_meanings():
    text = ccdt.mesh.__doc__
    names = list(inspect.signature(ccdt.mesh).parameters)
    for name, option in TABLE.items():
        assert f"\n{name}" in text and name in names
        for choice in option["choices"]:
            assert repr(choice) in text
    assert "size_function" in names and "OPTIONS" not in text and "--" not in text


def test_the_stub_lists_all_options():
    stub = (pathlib.Path(ccdt.__file__).parent / "__init__.pyi").read_text()
    for name in TABLE:
        assert f"    {name}: " in stub
    compile(stub, "__init__.pyi", "exec")


def test_files_of_surfaces_and_meshes_are_read_back(cube, tmp_path):
    surface = ccdt.Surface(*cube, markers=range(12))
    ccdt.write(surface, tmp_path / "cube.poly")
    again = ccdt.read(str(tmp_path / "cube.poly"))
    assert (again.vertices == surface.vertices).all()
    mesh = ccdt.mesh(again, edge_length=0.3)
    assert set(mesh.face_markers) == set(range(12))
    ccdt.write(mesh, tmp_path / "cube.vtu")
    read = ccdt.read_mesh(tmp_path / "cube.vtu")
    assert (read.vertices == mesh.vertices).all() and (read.tetrahedra == mesh.tetrahedra).all()
    assert (read.face_markers == mesh.face_markers).all()


def test_check_and_repair(cube):
    vertices, faces = cube
    assert ccdt.check(ccdt.Surface(vertices, faces)).volume == pytest.approx(1)
    is_open = ccdt.check(ccdt.Surface(vertices, faces[:-1]))
    assert not is_open.is_valid and "open-edges" in [fault.kind for fault in is_open.faults]
    assert is_open.faults[0].places[0].points
    repaired = ccdt.repair(ccdt.Surface(vertices, faces[:-1]), limit=1)
    assert repaired.certificate["area_of_lids"] == pytest.approx(0.5)
    assert [step.name for step in repaired.steps] and not repaired.refused
    assert ccdt.check(repaired.surface).is_valid
    assert ccdt.repair(ccdt.Surface(vertices, faces[:-1])).refused


def test_remesh_and_improve(cube):
    surface = ccdt.remesh(ccdt.Surface(*cube), 0.25)
    assert len(surface.triangles) > 100 and ccdt.check(surface).volume == pytest.approx(1)
    raw = ccdt.mesh(surface, improve="none")
    before = raw.tetrahedra.copy()
    better = ccdt.improve(raw, target_dihedral=25)
    assert better.dihedral_angles().min() > raw.dihedral_angles().min()
    assert (raw.tetrahedra == before).all()
    with pytest.raises(ccdt.InputError):
        ccdt.remesh(ccdt.Surface(*cube), 0)


def test_meshio_gets_the_mesh(cube, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = ccdt.mesh(*cube, edge_length=0.5)
    foreign = mesh.to_meshio()
    assert isinstance(foreign, meshio.Mesh)
    for ending in ("vtu", "msh", "xdmf"):
        foreign.write(tmp_path / f"foreign.{ending}")
        assert len(meshio.read(tmp_path / f"foreign.{ending}").cells_dict["tetra"]) == len(mesh.tetrahedra)
    outline = meshio.Mesh(cube[0], [("triangle", cube[1])])
    assert ccdt.mesh(outline).volumes().sum() == pytest.approx(1)


def test_surfaces_of_trimesh_and_pyvista_are_meshed(cube):
    vertices, faces = cube
    like_trimesh = types.SimpleNamespace(vertices=vertices, faces=faces)
    flat = np.hstack([np.full((len(faces), 1), 3), faces]).ravel()
    like_pyvista = types.SimpleNamespace(points=vertices, faces=flat, verts=np.empty(0), n_points=len(vertices))
    for surface in (like_trimesh, like_pyvista, ccdt.from_trimesh(like_trimesh), ccdt.from_pyvista(like_pyvista)):
        assert ccdt.mesh(surface).volumes().sum() == pytest.approx(1)
    with pytest.raises(TypeError):
        ccdt.mesh(3)


def test_pyvista_gets_the_mesh(cube):
    pytest.importorskip("pyvista")
    mesh = ccdt.mesh(*cube, edge_length=0.5)
    assert mesh.to_pyvista().volume == pytest.approx(1)


def test_the_example_ends_in_a_mesh_for_fenicsx(cube, tmp_path):
    meshio = pytest.importorskip("meshio")
    examples = pathlib.Path(__file__).parents[2] / "examples"
    ccdt.write(ccdt.Surface(cube[0], cube[1][:-1]), tmp_path / "open.stl")
    subprocess.run([sys.executable, examples / "mesh_part.py", tmp_path / "open.stl", tmp_path / "part.xdmf"],
                   check=True, timeout=100)
    cells = meshio.read(tmp_path / "part.xdmf").cells_dict["tetra"]
    points = meshio.read(tmp_path / "part.xdmf").points
    assert ccdt.Mesh(points, cells).volumes().sum() == pytest.approx(1)


@pytest.mark.parametrize("page", ["README.md", "docs/index.md", "docs/library.md"])
def test_the_code_of_pages_runs(page, cube, tmp_path, monkeypatch):
    text = (pathlib.Path(__file__).parents[2] / page).read_text()
    monkeypatch.chdir(tmp_path)
    ccdt.write(ccdt.Surface(*cube), "part.stl")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    exec(compile("\n".join(blocks), page, "exec"), {})
