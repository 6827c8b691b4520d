# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""View factors between surfaces: the same matrix as farlod-svf, as arrays and as SciPy has it, and walls of a street."""

from __future__ import annotations

from pathlib import Path

import geopandas
import numpy as np
import pytest
import scipy.sparse
import shapely.geometry
from conftest import CANYON_HEIGHT, CANYON_LENGTH, CANYON_WIDTH, run_program

import farlod


@pytest.fixture(scope="module")
def views(village_path: str) -> farlod.ViewFactorMatrix:
    return farlod.open(village_path).view_factor_matrix(spacing=5.0, rays=200)


def test_same_matrix_as_the_program(views: farlod.ViewFactorMatrix, village: farlod.City, tmp_path: Path) -> None:
    run_program("farlod-svf", village.path, *"--surfaces all --spacing 5 --rays 200".split(), "-o", tmp_path / "o.csv", "--matrix", tmp_path / "F.npz")
    expected = np.load(tmp_path / "F.npz")
    for name in ("data", "indices", "indptr", "shape", "surface", "area_m2", "ground_centres_m"):
        np.testing.assert_array_equal(getattr(views, name), expected[name], err_msg=name)
    assert views.building.tolist() == [name.decode() for name in expected["building"]]
    assert views.columns_after_surfaces == [name.decode() for name in expected["columns_after_surfaces"]]
    matrix = views.csr()
    assert abs(matrix - scipy.sparse.load_npz(tmp_path / "F.npz")).max() == 0.0
    assert np.shares_memory(matrix.data, views.data)


def test_rows_are_those_of_the_surfaces(views: farlod.ViewFactorMatrix, village: farlod.City) -> None:
    surfaces = village.surfaces("all", 5.0, geometry=False)
    assert views.building.tolist() == surfaces.building.tolist() and views.surface.tolist() == surfaces.surface.tolist()
    np.testing.assert_allclose(views.area_m2, surfaces.area_m2, rtol=1e-6)
    assert views.summary["surfaces"] == len(surfaces) and views.summary["entries"] == views.data.size
    assert views.summary["rays"] == 200 and views.summary["threshold"] == 1e-4


def test_rows_add_up_and_are_reciprocal(village: farlod.City) -> None:
    views = village.view_factor_matrix(spacing=5.0, rays=200, threshold=0.0)
    np.testing.assert_allclose(views.csr().sum(axis=1), 1.0, atol=1e-5)
    assert not views.seen("dropped").any() and views.summary["divided_rows"] == 0
    exchange = views.csr()[:, : len(views.building)].toarray() * views.area_m2[:, None]
    # A surface whose receivers are all covered is seen, and sees nothing itself
    both = (exchange > 0.0) & (exchange.T > 0.0)
    np.testing.assert_allclose(exchange[both], exchange.T[both], rtol=1e-5)
    assert both.sum() > 100


def test_walls_of_a_street_see_each_other(canyon: farlod.City) -> None:
    views = canyon.view_factor_matrix("walls", 5.0)
    long_sides = views.area_m2 > 0.4 * CANYON_LENGTH * CANYON_HEIGHT
    # Crossed strings (Hottel) between the walls of an endless street, and between a wall and the ground before it
    between = (np.hypot(CANYON_HEIGHT, CANYON_WIDTH) - CANYON_WIDTH) / CANYON_HEIGHT
    ground = (CANYON_HEIGHT + CANYON_WIDTH - np.hypot(CANYON_HEIGHT, CANYON_WIDTH)) / (2 * CANYON_HEIGHT)
    facing = np.flatnonzero(long_sides & (views.seen("surfaces") > 0.5 * between))
    assert len(facing) == 2
    np.testing.assert_allclose(views.csr()[[*facing], :][:, [*facing[::-1]]].diagonal(), between, atol=0.005)
    np.testing.assert_allclose(views.seen("ground")[facing], ground, atol=0.01)
    cells = sum(views.seen(name) for name in views.columns_after_surfaces if name.startswith("ground"))
    np.testing.assert_allclose(cells, views.seen("ground"), atol=1e-9)


def test_a_mask_chooses_the_rows(views: farlod.ViewFactorMatrix, village: farlod.City) -> None:
    west, south, east, north = village.bounds
    half = geopandas.GeoSeries([shapely.geometry.box(west, south, (west + east) / 2, north)], crs=village.crs)
    assert 0 < len(village.view_factor_matrix(spacing=5.0, rays=50, mask=half).building) < len(views.building)


def test_what_is_not_there_is_told(views: farlod.ViewFactorMatrix) -> None:
    with pytest.raises(farlod.InvalidArgument, match='did you mean "ground"'):
        views.seen("grounds")
    with pytest.raises(farlod.InvalidArgument, match="columns_after_surfaces"):
        views.seen(3)  # type: ignore[arg-type]
