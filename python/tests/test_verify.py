"""The exact check of meshes, against the program's verdicts."""

import subprocess

import numpy as np
import pytest

import ccdt

pytest.importorskip("ccdt._verify", reason="this build has no verifier")


@pytest.fixture
def solid(cube):
    return ccdt.Surface(*cube, markers=np.arange(12) // 2 + 1)


@pytest.fixture
def mesh(solid):
    return ccdt.mesh(solid, surface="refine", edge_length=0.4)


def changed(mesh, **parts):
    """A copy of a mesh with other parts."""
    same = {name: getattr(mesh, name) for name in
            ["vertices", "tetrahedra", "regions", "faces", "face_markers", "edges", "edge_markers"]}
    return ccdt.Mesh(**{**same, **parts})


def moved(mesh, which):
    vertices = mesh.vertices.copy()
    vertices[which] += 1e-3
    return vertices


# Kinds of wrong meshes.
WRONG = {
    "a tetrahedron is missing": lambda m: changed(m, tetrahedra=m.tetrahedra[1:], regions=m.regions[1:]),
    "a tetrahedron is there twice": lambda m: changed(m, tetrahedra=np.vstack([m.tetrahedra, m.tetrahedra[:1]]),
                                                      regions=np.append(m.regions, m.regions[0])),
    "a tetrahedron is inverted": lambda m: changed(m, tetrahedra=np.vstack([m.tetrahedra[:1, [1, 0, 2, 3]],
                                                                           m.tetrahedra[1:]])),
    "a vertex of the input is elsewhere": lambda m: changed(m, vertices=moved(m, (m.vertices == 1).all(axis=1))),
    "a face is not listed": lambda m: changed(m, faces=m.faces[1:], face_markers=m.face_markers[1:]),
    "a face has another marker": lambda m: changed(m, face_markers=np.append(m.face_markers[:-1], [99])),
    "the mesh is scaled": lambda m: changed(m, vertices=2 * m.vertices),
}


def test_a_right_mesh_has_no_problems(mesh, solid):
    found = ccdt.verify(mesh, solid)
    assert found.ok and not found.problems
    assert found.mesh_volume == pytest.approx(1) and found.input_volume == pytest.approx(1)
    assert {"positive orientation", "volume"} <= {check.name for check in found.checks}
    assert mesh.verify(solid) == found


@pytest.mark.parametrize("kind", WRONG)
def test_a_wrong_mesh_has_problems_with_places_and_the_programs_verdict(kind, mesh, solid, tmp_path, program):
    wrong = WRONG[kind](mesh)
    found = ccdt.verify(wrong, solid)
    assert not found.ok
    assert all(problem.failed and problem.examples for problem in found.problems)
    ccdt.write(solid, tmp_path / "solid.poly")
    ccdt.write(wrong, tmp_path / "wrong.mesh")
    with pytest.raises(subprocess.CalledProcessError) as raised:
        program("verify", tmp_path / "solid.poly", tmp_path / "wrong.mesh")
    assert raised.value.returncode == 1


def test_files_are_verified_as_well(mesh, solid, tmp_path):
    ccdt.write(solid, tmp_path / "solid.poly")
    ccdt.write(mesh, tmp_path / "right.mesh")
    assert ccdt.verify(tmp_path / "right.mesh", tmp_path / "solid.poly").ok
    assert not ccdt.verify(str(tmp_path / "right.mesh"), ccdt.Surface(2 * solid.vertices, solid.triangles)).ok
    with pytest.raises(ccdt.InputError):
        ccdt.verify(tmp_path / "missing.mesh", solid)


def test_options_are_those_of_the_program(mesh, solid):
    bare = ccdt.Mesh(mesh.vertices, mesh.tetrahedra)
    assert not ccdt.verify(bare, solid).ok
    assert ccdt.verify(bare, solid, lists="tetrahedra").ok
    coarse = ccdt.Mesh(solid.vertices, ccdt.mesh(solid, lattice="none").tetrahedra)
    moved_input = ccdt.Surface(1.01 * solid.vertices, solid.triangles)
    assert not ccdt.verify(coarse, moved_input, lists="tetrahedra").ok
    near = ccdt.verify(coarse, moved_input, within=0.1, lists="tetrahedra")
    assert near.ok and 0.01 < near.to_input < 0.02
    assert not ccdt.verify(coarse, moved_input, within=0.001, lists="tetrahedra").ok
    assert ccdt.verify(coarse, moved_input, surface="own", lists="tetrahedra").ok
    fine = ccdt.mesh(solid, surface="refine", edge_length=0.2)  # improvement changes Delaunay faces
    assert ccdt.verify(fine, solid).ok and not ccdt.verify(fine, solid, constrained_delaunay="yes").ok
    assert ccdt.verify(mesh, solid, threads=1) == ccdt.verify(mesh, solid, threads=3)


def test_opposite_sides_of_a_periodic_mesh_are_equal(solid):
    box = ccdt.Surface(solid.vertices, solid.triangles)
    free = ccdt.mesh(box, surface="refine", edge_length=0.2)
    assert ccdt.verify(free, box).ok and not ccdt.verify(free, box, periodic="xyz").ok
    assert ccdt.verify(ccdt.mesh(box, surface="refine", edge_length=0.2, periodic="xyz"), box, periodic="xyz").ok


@pytest.mark.parametrize("options", [{"boundary": "move"}, {"surface": "other"}, {"lists": ""}, {"within": 0},
                                     {"constrained_delaunay": "maybe"}, {"flatness": -1}, {"threads": 0}])
def test_values_that_an_option_cannot_have_are_errors_of_the_input(mesh, solid, options):
    with pytest.raises(ccdt.InputError):
        ccdt.verify(mesh, solid, **options)


def test_what_a_progress_function_raises_ends_the_work(mesh, solid):
    def stop(stage, done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ccdt.verify(mesh, solid, progress=stop)
