"""What meshing promises: right meshes, those of the program, from any input, without copies."""

import gc
import subprocess
import sys
import threading

import numpy as np
import pytest

import ccdt


def volume(mesh):
    return mesh.volumes().sum()


@pytest.mark.parametrize("options", [
    {"edge_length": 0.25},
    {"edge_length": 0.25, "surface": "refine", "grading": 0.3},
    {"edge_length": 0.3, "surface": "remesh", "sharp_angle": 40},
    {"lattice": "none", "steiner": "keep"},
    {"face_protection": False, "edge_length": 0.4, "improve": "swap-smooth", "threads": 1},
])
def test_the_mesh_is_that_of_the_program_byte_for_byte(bracket, program, tmp_path, options):
    def words(name, value):
        return [f"--{name.replace('_', '-')}", {True: "on", False: "off"}.get(value, value) if isinstance(value, bool)
                else value]

    program("mesh", bracket, "-o", tmp_path / "program.mesh", *sum((words(*o) for o in options.items()), []))
    ccdt.write(ccdt.mesh(bracket, **options), tmp_path / "python.mesh")
    assert (tmp_path / "python.mesh").read_bytes() == (tmp_path / "program.mesh").read_bytes()


def test_arrays_are_meshed(cube):
    mesh = ccdt.mesh(*cube, edge_length=0.3)
    assert volume(mesh) == pytest.approx(1)
    assert mesh.vertices.shape[1] == 3 and mesh.tetrahedra.shape[1] == 4
    assert mesh.counts["tetrahedra"] == len(mesh.tetrahedra)
    assert mesh.tetrahedra.max() < len(mesh.vertices)


def test_switches_are_true_or_false(cube):
    checked, unchecked = (ccdt.mesh(*cube, edge_length=0.5, face_protection=on).counts for on in (True, False))
    assert unchecked["front_tetrahedra"] > checked["front_tetrahedra"]


def test_polygons_are_facets(cube):
    squares = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    mesh = ccdt.mesh(cube[0], squares, markers=[1, 2, 3, 4, 5, 6], names={1: "inlet"}, edge_length=0.5)
    assert volume(mesh) == pytest.approx(1)
    assert set(mesh.face_markers) == {1, 2, 3, 4, 5, 6}
    assert mesh.names == {1: "inlet"}
    at_inlet = mesh.vertices[mesh.faces[mesh.face_markers == 1]]
    assert (at_inlet[:, :, 0] == 0).all()


def test_regions_get_their_numbers(cube):
    vertices = np.vstack([cube[0], cube[0] * 0.5 + 0.25])
    faces = np.vstack([cube[1], cube[1] + 8])
    mesh = ccdt.mesh(vertices, faces, regions=[((0.1, 0.1, 0.1), 7), ((0.5, 0.5, 0.5), 9)], edge_length=0.3)
    volumes = mesh.volumes()
    assert volumes[mesh.regions == 7].sum() == pytest.approx(7 / 8)
    assert volumes[mesh.regions == 9].sum() == pytest.approx(1 / 8)
    shell = ccdt.mesh(vertices, faces, holes=[(0.5, 0.5, 0.5)], edge_length=0.3)
    assert volume(shell) == pytest.approx(7 / 8)
    assert volume(ccdt.mesh(vertices, faces, edge_length=0.3)) == pytest.approx(7 / 8)
    assert volume(ccdt.mesh(vertices, faces, inside="seeds", edge_length=0.3)) == pytest.approx(1)


def test_arrays_share_the_memory_of_the_mesh_and_outlive_it(cube):
    mesh = ccdt.mesh(*cube, edge_length=0.3)
    vertices = mesh.vertices
    assert not vertices.flags.owndata
    assert np.shares_memory(vertices, mesh.vertices)
    copy = vertices.copy()
    del mesh
    gc.collect()
    assert (vertices == copy).all()


def test_quality_of_a_regular_tetrahedron_is_the_best():
    mesh = ccdt.Mesh([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], [[0, 2, 1, 3]])
    assert mesh.dihedral_angles() == pytest.approx(70.528779, abs=1e-6)
    assert mesh.shape_measures() == pytest.approx(1) and mesh.aspect_ratios() == pytest.approx(1)
    assert mesh.radius_edge_ratios() == pytest.approx(0.6123724)
    assert abs(mesh.volumes()[0]) == pytest.approx(8 / 3)


def test_a_size_function_makes_short_edges_where_it_says_so(cube):
    def lengths(points):
        assert points.shape[1] == 3
        return 0.05 + 0.4 * points[:, 0]

    mesh = ccdt.mesh(*cube, surface="refine", edge_length=0.5, size_function=lengths)
    centers = mesh.vertices[mesh.tetrahedra].mean(axis=1)
    assert (centers[:, 0] < 0.5).sum() > 3 * (centers[:, 0] > 0.5).sum()


def test_size_fields_and_backgrounds_come_from_memory_too(cube, tmp_path):
    field = {"sizes": [{"edge_length": 0.1, "balls": [{"center": [0, 0, 0], "radius": 0.1}]}]}
    near = ccdt.mesh(*cube, edge_length=0.5, surface="refine", size_field=field)
    plain = ccdt.mesh(*cube, edge_length=0.5, surface="refine")
    assert len(near.tetrahedra) > 2 * len(plain.tetrahedra)
    background = ccdt.mesh(*cube, edge_length=0.5, surface="refine", sizes=([[0, 0, 0], [1, 1, 1]], [0.15, 0.3]))
    assert len(background.tetrahedra) > len(plain.tetrahedra)


def test_threads_and_several_calls_at_once_give_the_same_mesh(bracket):
    expected = ccdt.mesh(bracket, edge_length=0.2, threads=1)
    meshes = [None] * 4

    def run(i):
        meshes[i] = ccdt.mesh(bracket, edge_length=0.2, threads=2, size_function=lambda p: np.full(len(p), np.inf))

    threads = [threading.Thread(target=run, args=(i,)) for i in range(len(meshes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for mesh in meshes:
        assert (mesh.tetrahedra == meshes[0].tetrahedra).all()
    again = ccdt.mesh(bracket, edge_length=0.2, threads=2)
    assert (again.tetrahedra == expected.tetrahedra).all() and (again.vertices == expected.vertices).all()


def test_other_python_threads_run_while_it_meshes(bracket):
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    ccdt.mesh(bracket, edge_length=0.03, threads=1)
    during = len(ticks)
    done.set()
    thread.join()
    assert during > 3


def test_progress_names_stages_and_cancels(bracket):
    stages = []
    ccdt.mesh(bracket, edge_length=0.3, progress=lambda stage, done, total: stages.append(stage))
    assert "facets" in stages and "lattice" in stages

    class Enough(Exception):
        pass

    def stop(stage, done, total):
        if stage == "lattice":
            raise Enough

    with pytest.raises(Enough):
        ccdt.mesh(bracket, edge_length=0.3, progress=stop)


def test_control_c_ends_meshing(bracket):
    script = ("import ccdt, os, signal\n"
              "def interrupt(stage, done, total):\n"
              "    if stage == 'lattice': os.kill(os.getpid(), signal.SIGINT)\n"
              f"try: ccdt.mesh({str(bracket)!r}, edge_length=0.02, progress=interrupt)\n"
              "except KeyboardInterrupt: print('interrupted')")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.stdout == "interrupted\n", done.stderr
