"""Makes the wheel: pip wheel --no-build-isolation ."""

import pathlib
import re

from skbuild import setup

source = pathlib.Path(__file__).resolve().parent.parent

setup(
    name="ccdt",
    version=re.search(r"project\(ccdt VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text())[1],
    description="Tetrahedral meshes of solids",
    license="MIT; the module _verify has parts of CGAL under LGPL-3.0-or-later",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["ccdt"],
    cmake_source_dir="..",
    cmake_install_target="ccdt_wheel",
    cmake_args=["-DCCDT_BUILD_PROGRAM=OFF", "-DCCDT_BUILD_PYTHON=ON", "-DCCDT_INSTALL=OFF"],
)
