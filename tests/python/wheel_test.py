# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Wheels: built by pip, installed into a fresh environment, and used where neither the sources nor the build are found."""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import SAMPLES, SOURCES

import farlod
from farlod import _modules

PYTHON = SOURCES / "python"
BUILD = Path(os.environ.get("FARLOD_CMAKE_BUILD", SOURCES / "build"))
OS_RELEASE = platform.freedesktop_os_release()
DEBIAN = OS_RELEASE.get("VERSION_ID") if OS_RELEASE["ID"] == "debian" else None

USE = """
import sys, farlod, farlod_preprocess
assert farlod.__file__.startswith(sys.prefix), farlod.__file__
city = farlod.pack(sys.argv[1], sys.argv[2], report=False)
west, south, east, north = city.bounds
print(farlod.__version__, city.svf([[(west + east) / 2, (south + north) / 2, 500.0]])[0], city.svf_grid(10.0).svf.dims)
"""


def run(*command: object, **keywords: object) -> str:
    # What the caller has on its path must not be what is found
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["FARLOD_CMAKE_BUILD"] = str(BUILD)
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, env=environment, check=False, **keywords)  # type: ignore[call-overload]
    assert done.returncode == 0, done.stdout + done.stderr
    return str(done.stdout)


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    copy = tmp_path_factory.mktemp("sources")
    shutil.copytree(PYTHON, copy / "python", ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__", ".mypy_cache"))
    shutil.copy(SOURCES / "CMakeLists.txt", copy)
    target = tmp_path_factory.mktemp("wheels")
    before = sorted(copy.rglob("*"))
    for folder in ("python", "python/preprocess"):
        run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "-w", target, copy / folder)
    left = [path for path in copy.rglob("*") if path not in before and "__pycache__" not in path.parts]
    assert left == [], "the sources are to stay as they are"
    return sorted(target.glob("*.whl"))


def test_a_python_without_wheel_is_told_what_to_do() -> None:
    probe = "import build_with_cmake as b, importlib.util as u; u.find_spec = lambda name: None; b.require_wheel()"
    done = subprocess.run([sys.executable, "-c", probe], cwd=PYTHON, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "/usr/bin/python3 -m venv --system-site-packages" in done.stderr and "Traceback" not in done.stderr


def test_wheels_have_what_they_need_and_their_own_licence(wheels: list[Path]) -> None:
    licences = {}
    for wheel in wheels:
        with zipfile.ZipFile(wheel) as content:
            names = content.namelist()
            metadata = next(content.read(name).decode() for name in names if name.endswith("/METADATA"))
        licences[re.search(r"^Name: (.*)$", metadata, re.MULTILINE)[1]] = re.search(r"^License: (.*)$", metadata, re.MULTILINE)[1]  # type: ignore[index]
        assert any(name.endswith("py.typed") for name in names)
        assert sum(name.endswith(".so") for name in names) == 1
        assert not [name for name in names if name.endswith((".cpp", ".hpp"))]
        assert f"Version: {farlod.__version__}" in metadata
    assert licences == {"farlod": "Apache-2.0", "farlod-preprocess": "GPL-3.0-or-later"}


def test_wheels_work_in_a_fresh_environment(wheels: list[Path], tmp_path: Path) -> None:
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "env")
    python = tmp_path / "env" / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", *wheels)
    shutil.copy(SAMPLES / "village.gml", tmp_path)
    printed = run(python, "-c", USE, tmp_path / "village.gml", tmp_path / "village.farlod", cwd=tmp_path)
    assert printed == f"{farlod.__version__} 1.0 ('y', 'x')\n"
    # Nothing is taken from where it was built
    for module in (tmp_path / "env").rglob("_*.so"):
        dynamic = run("readelf", "--dynamic", module)
        assert "RPATH" not in dynamic and "RUNPATH" not in dynamic
    # Without the package that packs, the other one says where to get it
    run(python, "-m", "pip", "uninstall", "--yes", "farlod-preprocess")
    failing = "import farlod\ntry:\n  farlod.pack('a', 'b')\nexcept ImportError as error:\n  print(error)"
    assert "GPL-3.0-or-later" in run(python, "-c", failing, cwd=tmp_path)


def needed_by(module: Path) -> list[str]:
    found = re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "--dynamic", module))
    return [name for name in found if not re.match(r"lib(c|m|stdc\+\+|gcc_s)\.so|ld-linux", name)]


@pytest.mark.skipif(DEBIAN not in ("12", "13"), reason="the names are those of Debian 12 and 13")
def test_names_of_debian_packages(wheels: list[Path]) -> None:
    modules = [*Path(farlod.__file__).parent.glob("_runtime*.so"), *Path(farlod.__file__).parents[1].glob("farlod_preprocess/_*.so")]
    assert len(modules) == 2
    for module in modules:
        for library in needed_by(module):
            package, releases = _modules.DEBIAN_PACKAGES[library]
            owner = subprocess.run(["dpkg", "--search", library], capture_output=True, text=True, check=True).stdout
            # Debian 13 has some packages under another name besides, since time has 64 bits on all its machines
            assert any(line.split(":")[0] in (package, package + "t64") for line in owner.splitlines()), (library, package, owner)
            assert DEBIAN in releases.split(" and "), (library, releases)
            assert package in (PYTHON / "README.md").read_text(encoding="utf-8"), package


def test_advice_where_a_library_is_missing() -> None:
    message = "libembree3.so.3: cannot open shared object file: No such file or directory"
    assert _modules.advice_for(message) == "The library libembree3.so.3 is missing: on Debian 12, run apt-get install libembree3-3."
    assert "libfoo.so.1" in _modules.advice_for("libfoo.so.1: cannot open shared object file")
    assert _modules.advice_for("undefined symbol") == ""
