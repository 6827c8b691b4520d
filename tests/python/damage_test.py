# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Packages that are missing, damaged, or changed while they are open: an exception, and never a crash."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import SAMPLES, points_of

import farlod


@pytest.fixture()
def copy(village_path: str, tmp_path: Path) -> Path:
    return Path(shutil.copytree(village_path, tmp_path / "copy.farlod"))


def calls_of(city: farlod.City):  # type: ignore[no-untyped-def]
    """A call of each function that reads the package."""
    points = points_of(city, 20)
    return {
        "svf": lambda: city.svf(points),
        "evaluate": lambda: city.evaluate(points),
        "horizon": lambda: city.horizon(points, 8),
        "sky_patches": lambda: city.sky_patches(points),
        "look_up": lambda: city.look_up(points[0]),
        "fisheye": lambda: city.fisheye(points[0]),
        "svf_grid": lambda: city.svf_grid(5.0),
        "chunks": lambda: city.svf_grid(5.0, chunks=16).svf.compute(scheduler="synchronous"),
        "ground": lambda: city.ground(5.0),
        "surfaces": lambda: city.surfaces("walls"),
        "plot": lambda: city.plot(),
    }


FUNCTIONS = ["svf", "evaluate", "horizon", "sky_patches", "look_up", "fisheye", "svf_grid", "chunks", "ground", "surfaces", "plot"]


def truncate(file: Path) -> None:
    with file.open("r+b") as opened:
        opened.truncate(file.stat().st_size // 2)


def flip_bytes(file: Path) -> None:
    content = bytearray(file.read_bytes())
    content[len(content) // 3 :: 97] = bytes(b ^ 0xFF for b in content[len(content) // 3 :: 97])
    # In place: whoever has the file mapped sees it
    with file.open("r+b") as opened:
        opened.write(content)


def test_no_package(tmp_path: Path) -> None:
    with pytest.raises(farlod.PackageUnusable, match="farlod-pack makes one"):
        farlod.open(tmp_path / "none.farlod")
    (tmp_path / "empty").mkdir()
    with pytest.raises(farlod.PackageUnusable):
        farlod.open(tmp_path / "empty")
    with pytest.raises(farlod.PackageUnusable):
        farlod.open(SAMPLES / "village.gml")


@pytest.mark.parametrize("damage", [truncate, flip_bytes, Path.unlink])
@pytest.mark.parametrize("name", ["tiles.bin", "manifest.json"])
def test_damaged_before_it_is_opened(copy: Path, damage, name: str) -> None:  # type: ignore[no-untyped-def]
    for file in copy.rglob(name):
        damage(file)
    with pytest.raises((farlod.PackageDamaged, farlod.PackageUnusable)):
        city = farlod.open(copy)
        assert city.check().damage
        city.svf(points_of(city, 20))


@pytest.mark.parametrize("damage", [truncate, flip_bytes, Path.unlink])
@pytest.mark.parametrize("function", FUNCTIONS)
def test_damaged_while_it_is_open(copy: Path, damage, function: str) -> None:  # type: ignore[no-untyped-def]
    city = farlod.open(copy)
    calls_of(city)["svf_grid"]()
    for file in (*copy.rglob("tiles.bin"), *copy.rglob("*.exr")):
        damage(file)
    with pytest.raises(farlod.PackageDamaged, match="open the package again|pack the city again"):
        calls_of(city)[function]()
    assert city.check().damage


def test_packed_again_while_it_is_open(copy: Path) -> None:
    city = farlod.open(copy)
    points = points_of(city, 20)
    before = city.svf(points)
    farlod.pack(SAMPLES / "village.gml", copy, cell=30.0, overwrite=True, report=False)
    # Who has it open reads the old one to its end
    assert np.array_equal(city.svf(points), before, equal_nan=True)
    assert city.info["cell_edge_m"] != 30.0
    assert farlod.open(copy).info["cell_edge_m"] == 30.0
