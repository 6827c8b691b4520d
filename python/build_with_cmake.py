# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Compiles the modules of the Python packages with CMake, for the setup.py of both.

FARLOD_CMAKE_BUILD names the build folder of CMake (default: build/python-wheel of the sources). One that is there already, as
scripts/test leaves it, saves the time. What setuptools makes on its way lies there, too: the sources stay as they are.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent

_OF_BOTH = (
    "cmake g++ ninja-build pkg-config pybind11-dev python3-dev libembree-dev libtbb-dev libopenexr-dev libboost-dev libxxhash-dev "
    "liberfa-dev libfmt-dev nlohmann-json3-dev"
).split()
#: Debian packages that it takes to compile each of the modules.
DEBIAN_PACKAGES = {
    "runtime": _OF_BOTH,
    "preprocess": _OF_BOTH
    + "libcgal-dev libgmp-dev libmpfr-dev libgeographiclib-dev libproj-dev libgdal-dev libexpat1-dev".split(),
}


def cmake_build() -> Path:
    """The build folder of CMake."""
    return Path(os.environ.get("FARLOD_CMAKE_BUILD", ROOT / "build" / "python-wheel"))


def options_of_setup(module: str) -> dict[str, dict[str, str]]:
    """Where setuptools puts what it makes on its way: by default, into the folder of the package."""
    require_wheel()
    folder = cmake_build().resolve() / "setuptools" / module
    metadata = folder / "metadata"
    metadata.mkdir(parents=True, exist_ok=True)
    return {"build": {"build_base": str(folder)}, "egg_info": {"egg_base": str(metadata)}}


def require_wheel() -> None:
    """Without `wheel`, setuptools before 70.1 says "invalid command 'bdist_wheel'", which does not tell what to do."""
    makers = ("wheel", "setuptools._vendor.wheel", "setuptools.command.bdist_wheel")
    has_command = any(importlib.util.find_spec(name) for name in makers)
    if not has_command:
        raise SystemExit(
            f"{sys.executable} has no package wheel. Is it another Python than Debian's? Make the environment by "
            "/usr/bin/python3 -m venv --system-site-packages, or install wheel in this one."
        )


def version() -> str:
    """The version of the project, which CMakeLists.txt says."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"project\(farlod VERSION ([0-9.]+)", text)
    if found is None:
        raise SystemExit(f"{ROOT}/CMakeLists.txt does not say the version: build from a complete copy of the sources")
    return found[1]


def missing_packages(module: str) -> list[str]:
    """The Debian packages of the list that are not installed; none where this is no Debian."""
    if shutil.which("dpkg-query") is None:
        return []
    query = ["dpkg-query", "--show", "--showformat=${Package} ${db:Status-Status}\n", *DEBIAN_PACKAGES[module]]
    lines = subprocess.run(query, capture_output=True, text=True, check=False).stdout.splitlines()
    installed = {line.split()[0] for line in lines if line.endswith(" installed")}
    return [package for package in DEBIAN_PACKAGES[module] if package not in installed]


class BuildWithCMake(build_ext):
    """Puts the compiled module where setuptools takes it from."""

    def build_extension(self, extension: Extension) -> None:
        module = extension.name.rpartition("._")[2]
        missing = missing_packages(module)
        if missing:
            raise SystemExit(f"{extension.name} needs Debian packages that are not installed: apt-get install {' '.join(missing)}")
        build = cmake_build()
        if not (build / "CMakeCache.txt").exists():
            self._run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *self._options())
        self._run("cmake", "--build", build, "--target", f"farlod_python_{module}")
        folder = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        self._run("cmake", "--install", build, "--component", f"python_{module}", "--prefix", folder)

    def _options(self) -> list[str]:
        off = ("PROGRAMS", "TESTS", "INSTALL", "GDAL")
        return ["-DFARLOD_WITH_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}", *(f"-DFARLOD_WITH_{name}=OFF" for name in off)]

    def _run(self, *command: object) -> None:
        words = [str(word) for word in command]
        if subprocess.run(words, check=False).returncode != 0:
            raise SystemExit(f"this command failed, and says above why: {' '.join(words)}")
