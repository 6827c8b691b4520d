# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""mypy --strict has nothing to say of the packages, and of code that uses them as their users do."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

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
