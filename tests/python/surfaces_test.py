# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Roofs and walls: the same table as farlod-svf, and polygons with the area of the surfaces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas
import pytest
from conftest import CANYON_HEIGHT, CANYON_LENGTH, CANYON_WIDTH, run_program

import farlod


def area_of(geometry) -> float:  # type: ignore[no-untyped-def]
    """The area of planar polygons in space: half of the length of Newell's vector."""
    total = 0.0
    for polygon in geometry.geoms:
        vector = np.zeros(3)
        for ring in (polygon.exterior, *polygon.interiors):
            p = np.array(ring.coords)
            vector += np.cross(p[:-1] - p[0], p[1:] - p[0]).sum(axis=0)
        total += np.linalg.norm(vector) / 2
    return total


def test_same_table_as_the_program(village: farlod.City, tmp_path: Path) -> None:
    run_program("farlod-svf", village.path, "--surfaces", "walls", "--spacing", 2, "-o", tmp_path / "walls.csv")
    expected = pandas.read_csv(tmp_path / "walls.surfaces.csv").sort_values(["building", "surface"], ignore_index=True)
    walls = village.surfaces("walls", 2.0).sort_values(["building", "surface"], ignore_index=True)
    assert walls.building.tolist() == expected.building.tolist() and walls.surface.tolist() == expected.surface.tolist()
    assert walls.surface_id.tolist() == expected.surface_id.tolist()
    for column in expected.columns.difference(["building", "surface", "surface_id", "kind"]):
        np.testing.assert_allclose(walls[column], expected[column], atol=1e-3, equal_nan=True, err_msg=column)
    assert set(walls.kind) == {"wall"}


@pytest.mark.parametrize("sample", ["village", "bridges"])
def test_polygons_have_the_area_of_the_surfaces(sample: str, request: pytest.FixtureRequest) -> None:
    city = farlod.open(request.getfixturevalue(f"{sample}_path"))
    surfaces = city.surfaces("all", 5.0)
    assert not surfaces.geometry.isna().any() and surfaces.crs == city.crs
    areas = surfaces.geometry.map(area_of)
    # A fitting polygon of a surface that the file bends a little is a little smaller
    np.testing.assert_allclose(areas, surfaces.area_m2 + surfaces.covered_area_m2, rtol=2e-3, atol=0.05)


def test_roofs_are_valid_polygons_on_the_map(village: farlod.City) -> None:
    roofs = village.surfaces("roofs", 5.0)
    assert roofs.geometry.is_valid.all()
    assert (roofs.geometry.area > 0.0).all()


def test_walls_of_a_street(canyon: farlod.City) -> None:
    walls = canyon.surfaces("walls", 5.0, geometry=False)
    long_sides = walls[walls.area_m2 > 0.4 * CANYON_LENGTH * CANYON_HEIGHT].sort_values("svf_mean")
    assert len(long_sides) == 4 and walls.geometry.isna().all()
    # The mean over a wall of an endless street (Johnson & Watson 1984): Hottel's crossed strings between wall and sky
    expected = (CANYON_HEIGHT + CANYON_WIDTH - np.hypot(CANYON_HEIGHT, CANYON_WIDTH)) / (2 * CANYON_HEIGHT)
    assert long_sides.svf_mean[:2].mean() == pytest.approx(expected, abs=0.005)
    assert long_sides.svf_mean[2:].mean() == pytest.approx(0.5, abs=0.002)


def test_receivers_as_rows(village: farlod.City) -> None:
    points = village.surfaces("walls", 3.0, points=True, bounds=True)
    means = village.surfaces("walls", 3.0, geometry=False)
    assert points.geometry.has_z.all() and len(points) == means.receivers.sum()
    known = points.dropna(subset=["svf"])
    assert (known.svf_low <= known.svf + 1e-6).all() and (known.svf <= known.svf_high + 1e-6).all()
    sums = known.assign(weighted=known.svf * known.area_m2).groupby(["building", "surface"])[["weighted", "area_m2"]].sum()
    ours = (sums.weighted / sums.area_m2).sort_index()
    theirs = means.dropna(subset=["svf_mean"]).set_index(["building", "surface"]).svf_mean.sort_index()
    # Values keep within bounds where these are asked for
    np.testing.assert_allclose(ours, theirs, atol=2e-3)


def test_result_in_another_crs(village: farlod.City) -> None:
    here, there = village.surfaces("roofs", 20.0), village.surfaces("roofs", 20.0, crs="EPSG:4326")
    assert there.crs == "EPSG:4326"
    west, south, east, north = there.to_crs(here.crs).total_bounds
    np.testing.assert_allclose((west, south, east, north), here.total_bounds, atol=0.01)


def test_quantities_of_surfaces(village: farlod.City) -> None:
    walls = village.surfaces("walls", 5.0, quantities=["svf_solid"], geometry=False)
    known = walls.dropna(subset=["svf_mean"])
    assert known.svf_solid.between(0.0, 1.0).all() and not known.svf_solid.isna().any()
