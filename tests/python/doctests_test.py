# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The examples of the docstrings run, and say what they say."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
from typing import Any

import matplotlib
import numpy as np
import pytest
import rioxarray  # noqa: F401  the accessor .rio
import xarray
from conftest import SAMPLES

import farlod

matplotlib.use("Agg")

MODULES = ["farlod", *(f"farlod.{module.name}" for module in pkgutil.iter_modules(farlod.__path__) if module.name != "_runtime")]
EXAMPLES = [
    (name, test.name, test)
    for name in MODULES
    for test in doctest.DocTestFinder(exclude_empty=True).find(importlib.import_module(name))
    if test.examples
]


@pytest.fixture(scope="module")
def names(village_path: str) -> dict[str, Any]:
    """What the examples take for granted."""
    city = farlod.open(village_path)
    west, south, east, north = city.bounds
    heights = np.zeros((30, 30), np.float32)
    heights[:, :8] = heights[:, 22:] = 12.0
    coords = {"y": 5.3e6 + 29.5 - np.arange(30.0), "x": 690000.5 + np.arange(30.0)}
    return {
        "farlod": farlod,
        "village": village_path,
        "village_file": str(SAMPLES / "village.gml"),
        "city": city,
        "x": (west + east) / 2,
        "y": (south + north) / 2,
        "surface_model": xarray.DataArray(heights, coords, ("y", "x")).rio.write_crs("EPSG:25832"),
    }


@pytest.mark.parametrize(("module", "name", "test"), EXAMPLES, ids=[name for _, name, _ in EXAMPLES])
def test_example(names: dict[str, Any], module: str, name: str, test: doctest.DocTest, capsys: pytest.CaptureFixture[str]) -> None:
    test.globs = {**vars(importlib.import_module(module)), **names}
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS).run(test)
    assert result.failed == 0, capsys.readouterr().out


def test_each_public_function_has_an_example() -> None:
    with_example = {name for _, name, _ in EXAMPLES}
    ours = [cls for cls in farlod.City.__mro__ if cls.__module__.startswith("farlod.")]
    public = [(f"{cls.__module__}.{cls.__qualname__}.{name}", name) for cls in ours for name in vars(cls) if not name.startswith("_")]
    functions = [full_name for full_name, name in public if callable(getattr(farlod.City, name)) and name != "close"]
    assert len(functions) > 12
    assert not [name for name in functions if name not in with_example]
