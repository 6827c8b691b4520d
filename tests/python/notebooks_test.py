# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The notebooks of the tutorials run, and draw. FARLOD_NOTEBOOK_PICTURES is a folder that gets their pictures."""

from __future__ import annotations

import base64
import os
from pathlib import Path
from typing import Any

import nbformat
import pytest
from conftest import SAMPLES, SOURCES
from nbconvert.preprocessors import ExecutePreprocessor

TUTORIALS = SOURCES / "docs" / "tutorials"
NOTEBOOKS = sorted(TUTORIALS.glob("*.ipynb"))
CITIES = SOURCES.parent / "shared" / "data"

each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])


def read(path: Path) -> Any:
    return nbformat.read(path, as_version=4)


def code_cells(notebook: Any) -> list[Any]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def pictures_of(notebook: Any) -> list[bytes]:
    data = [output.data for cell in code_cells(notebook) for output in cell.outputs if "data" in output]
    return [base64.b64decode(item["image/png"]) for item in data if "image/png" in item]


def files_of_sources() -> dict[Path, int]:
    """What a notebook could change by a path that is wrong, and when it was changed last."""
    return {path: path.stat().st_mtime_ns for folder in (TUTORIALS, SAMPLES) for path in folder.rglob("*")}


@pytest.fixture()
def kernel_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a kernel inherits: folders of its own, and cities where there are some."""
    for name in ("IPYTHONDIR", "JUPYTER_RUNTIME_DIR", "TMPDIR"):
        folder = tmp_path / name.lower()
        folder.mkdir()
        monkeypatch.setenv(name, str(folder))
    # The kernel chooses the one that puts pictures into the notebook
    monkeypatch.delenv("MPLBACKEND", raising=False)
    if "FARLOD_CITIES" not in os.environ and CITIES.is_dir():
        monkeypatch.setenv("FARLOD_CITIES", str(CITIES))


def test_there_are_notebooks() -> None:
    assert NOTEBOOKS


@each_notebook
def test_notebook_is_stored_without_outputs(path: Path) -> None:
    notebook = read(path)
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert notebook.metadata.kernelspec.name == "python3"
    stored = [cell.id for cell in code_cells(notebook) if cell.outputs or cell.execution_count is not None]
    assert not stored


@each_notebook
def test_lines_of_notebook_are_short(path: Path) -> None:
    cells = read(path).cells
    long = [(cell.id, line) for cell in cells for line in cell.source.splitlines() if len(line) > 120]
    assert not long


@each_notebook
@pytest.mark.usefixtures("kernel_environment")
def test_notebook_runs_and_draws(path: Path) -> None:
    notebook = read(path)
    before = files_of_sources()
    # Raises the first exception of a cell, with its traceback
    ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(TUTORIALS)}})
    assert files_of_sources() == before
    pictures = pictures_of(notebook)
    assert pictures
    if folder := os.environ.get("FARLOD_NOTEBOOK_PICTURES"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        for number, picture in enumerate(pictures, 1):
            (Path(folder) / f"{path.stem}_{number}.png").write_bytes(picture)
