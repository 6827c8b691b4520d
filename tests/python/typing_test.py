# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""mypy --strict has nothing to say of the packages, and of code that uses them as their users do."""

from __future__ import annotations

import ast
import importlib
import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import SOURCES

PYTHON = SOURCES / "python"


def mypy(*files: object) -> subprocess.CompletedProcess[str]:
    """mypy on files, with the settings of the project. What it knows of other packages is kept beside the build."""
    cache = Path(os.environ.get("FARLOD_MYPY_CACHE", SOURCES / "build" / "mypy"))
    command = [sys.executable, "-m", "mypy", "--config-file", PYTHON / "pyproject.toml", "--cache-dir", cache, *files]
    return subprocess.run(list(map(str, command)), cwd=PYTHON, capture_output=True, text=True, check=False)


def test_packages_and_examples_are_typed() -> None:
    checked = mypy("src/farlod", "preprocess/src/farlod_preprocess", SOURCES / "tests" / "python" / "typed_use.py")
    assert checked.returncode == 0, checked.stdout + checked.stderr


@pytest.mark.parametrize(
    ("stub", "module"),
    [
        (PYTHON / "src" / "farlod" / "_runtime.pyi", "farlod._runtime"),
        (PYTHON / "preprocess" / "src" / "farlod_preprocess" / "_preprocess.pyi", "farlod_preprocess._preprocess"),
    ],
)
def test_stubs_have_the_names_of_the_compiled_modules(stub: Path, module: str) -> None:
    compiled = importlib.import_module(module)
    body = ast.parse(stub.read_text(encoding="utf-8")).body
    functions = {node.name for node in body if isinstance(node, ast.FunctionDef)}
    values = {node.target.id for node in body if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)}
    classes = {node.name: node for node in body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")}
    assert functions | values | set(classes) == {name for name in dir(compiled) if not name.startswith("__")}
    for name, node in classes.items():
        members = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
        members |= {m.target.id for m in node.body if isinstance(m, ast.AnnAssign) and isinstance(m.target, ast.Name)}
        # pybind11 adds functions of its own
        assert members - {"__init__"} == {m for m in vars(getattr(compiled, name)) if not m.startswith(("__", "_pybind11_"))}, name


def test_wrong_use_is_found(tmp_path: Path) -> None:
    # Each line is wrong in another way
    lines = {
        'city.svf(points, metric="area")': "call-overload",
        "city.svf(points, hieght=2.0)": "call-overload",
        'city.surfaces("doors")': "arg-type",
        "city.horizon(points, engine=3)": "arg-type",
        "low: float = city.svf(points, bounds=True)": "assignment",
        'farlod.pack("town.gml", "town.farlod", far_map="sphere")': "arg-type",
    }
    file = tmp_path / "wrong.py"
    file.write_text("import farlod\ncity = farlod.open('a')\npoints = [[1.0, 2.0]]\n" + "\n".join(lines) + "\n", encoding="utf-8")
    found = mypy(file).stdout
    for number, kind in enumerate(lines.values(), start=4):
        assert any(f":{number}: error" in line and f"[{kind}]" in line for line in found.splitlines()), (number, found)
