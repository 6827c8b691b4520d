# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Urban form of cells: the same table as farlod-info, and the shape of a street."""

from __future__ import annotations

from pathlib import Path

import geopandas
import numpy as np
import pandas
import pytest
import shapely.geometry
import xarray
from conftest import CANYON_HEIGHT, run_program

import farlod


def test_same_table_as_the_program(village: farlod.City, tmp_path: Path) -> None:
    run_program("farlod-info", village.path, "--cells", tmp_path / "cells.csv")
    expected = pandas.read_csv(tmp_path / "cells.csv")
    cells = village.cells()
    assert cells.columns.drop("geometry").tolist() == expected.columns.tolist()
    for column in expected.columns:
        # Tables have millimetres of a length, and six digits of a share
        np.testing.assert_allclose(cells[column], expected[column].astype(float), rtol=0, atol=6e-4, equal_nan=True, err_msg=column)
    assert cells.buildings.dtype.kind == "i" and cells.crs == village.crs


def test_netcdf_says_what_its_variables_are(village: farlod.City, tmp_path: Path) -> None:
    run_program("farlod-info", village.path, "--cells", tmp_path / "cells.nc")
    with xarray.open_dataset(tmp_path / "cells.nc") as cells:
        unknown = [name for name, variable in cells.variables.items() if name != "crs" and not {"units", "long_name"} <= set(variable.attrs)]
        assert not unknown
        assert cells.area_m2.attrs["long_name"] == "plan area of the cell"
        names = {name: variable.attrs["standard_name"] for name, variable in cells.variables.items() if "standard_name" in variable.attrs}
    roughness = "surface_roughness_length_for_momentum_in_air"
    assert names == {
        "x_m": "projection_x_coordinate",
        "y_m": "projection_y_coordinate",
        "area_m2": "cell_area",
        "vegetation_fraction": "vegetation_area_fraction",
        "z0_macdonald_m": roughness,
        "z0_kanda_m": roughness,
    }


def test_squares_lie_where_the_columns_say(village: farlod.City) -> None:
    cells = village.cells()
    np.testing.assert_allclose(cells.geometry.area, cells.area_m2, rtol=1e-9)
    np.testing.assert_allclose(cells.geometry.centroid.x, cells.x_m, atol=1e-3)
    assert cells.geometry.exterior.map(lambda ring: ring.is_ccw).all()


def test_walls_of_a_street(canyon: farlod.City) -> None:
    cells = canyon.cells(threads=1)
    built = cells[cells.buildings > 0]
    np.testing.assert_allclose(built.height_mean_m, CANYON_HEIGHT, atol=1e-3)
    # A city without trees tells nothing of them
    assert cells.vegetation_fraction.isna().all() and cells.crowns.isna().all()


def test_sky_of_the_cells_is_that_of_rasters_and_surfaces(village: farlod.City) -> None:
    assert village.cells().svf_ground.isna().all()
    cells = village.cells(svf=5.0)
    ground = village.svf_grid(5.0, bbox=village.bounds, height=0.0).svf.to_dataframe().reset_index().dropna(subset="svf")
    pixels = geopandas.points_from_xy(ground.x, ground.y)
    roofs = village.surfaces("roofs", 5.0, points=True).dropna(subset="svf")
    for cell in cells.itertuples():
        np.testing.assert_allclose(cell.svf_ground, ground.svf[pixels.within(cell.geometry)].mean(), atol=1e-6)
        here = roofs[roofs.within(cell.geometry)]
        if len(here):
            np.testing.assert_allclose(cell.svf_roofs, np.average(here.svf, weights=here.area_m2), atol=1e-6)
    assert cells.svf_roofs.notna().sum() > 3 and (cells.svf_walls.dropna() < 0.6).all()


def test_needs_buildings_that_are_cut(tmp_path: Path, village_path: str) -> None:
    closed = farlod.open(village_path)
    closed.close()
    with pytest.raises(farlod.InvalidArgument, match="closed"):
        closed.cells()


def test_zones_that_part_the_city_have_its_sums(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    box = shapely.geometry.box(west, south, east, north)
    part = shapely.geometry.Point((west + east) / 2, (south + north) / 2).buffer(40.0)
    zones = geopandas.GeoDataFrame({"name": ["outside", "inside"]}, geometry=[box.difference(part), part], index=[7, 8], crs=village.crs)
    forms, cells = village.cells(zones=zones), village.cells()
    for column in ("building_plan_area_m2", "roof_area_m2", "wall_area_m2", "building_volume_m3"):
        assert forms[column].min() > 0.0
        np.testing.assert_allclose(forms[column].sum(), cells[column].sum(), rtol=1e-6, err_msg=column)
    np.testing.assert_allclose(forms.area_m2, zones.geometry.area, rtol=1e-9)
    assert forms.index.tolist() == [7, 8] and forms.geometry.geom_equals(zones.geometry).all()
    seen = village.cells(5.0, zones=zones, threads=1)
    assert seen.svf_ground.between(0.1, 1.0).all() and (seen.svf_walls < seen.svf_roofs).all() and forms.svf_ground.isna().all()
    abroad = village.cells(zones=zones.to_crs("EPSG:4326"))
    assert abroad.crs == "EPSG:4326"
    np.testing.assert_allclose(abroad.wall_area_m2, forms.wall_area_m2, rtol=1e-5)
