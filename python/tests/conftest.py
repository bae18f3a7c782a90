"""Small solids, and the program that must make the same meshes."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

SOURCE = pathlib.Path(__file__).parents[2]


@pytest.fixture
def cube():
    """Vertices and triangles of the unit cube."""
    vertices = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    faces = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                      [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])
    return vertices, faces


@pytest.fixture
def bracket():
    return SOURCE / "examples" / "bracket.off"


@pytest.fixture
def program():
    """Runs the program; skips without it."""
    path = os.environ.get("CCDT_PROGRAM", "")
    if not os.path.exists(path):
        pytest.skip("there is no program to compare with")
    return lambda *words: subprocess.run([path, *map(str, words)], check=True, capture_output=True)
