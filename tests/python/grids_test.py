# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Rasters: the same pixels as farlod-svf, what xarray and rioxarray make of them, and blocks of dask."""

from __future__ import annotations

import json
from pathlib import Path

import dask
import geopandas
import numpy as np
import pytest
import rasterio
import rioxarray  # noqa: F401  the accessor .rio
import shapely.geometry
import xarray
from conftest import run_program
from dask.distributed import Client, LocalCluster

import farlod


def test_same_pixels_as_the_program(village: farlod.City, tmp_path: Path) -> None:
    run_program("farlod-svf", village.path, "--grid", 2, "--bounds", "--quantity", "directional", "-o", tmp_path / "svf.tif",
                "--summary", tmp_path / "s.json")
    grid = village.svf_grid(2.0, bounds=True, quantities=["directional"])
    with rasterio.open(tmp_path / "svf.tif") as file:
        assert grid.rio.crs == file.crs
        assert grid.rio.transform() == file.transform
        for number, band in enumerate(grid.data_vars, start=1):
            np.testing.assert_array_equal(grid[band].values, file.read(number))
    assert list(grid.data_vars) == ["svf", "svf_low", "svf_high", "svfN", "svfE", "svfS", "svfW"]
    ours, theirs = json.loads(grid.attrs["summary"]), json.loads((tmp_path / "s.json").read_text())
    assert ours["svf"] == theirs["svf"] and 0.0 < ours["svf"]["mean_near_buildings"] < 1.0
    assert ours["receivers_near_buildings"] == theirs["receivers_near_buildings"] > 0


def test_part_has_the_pixels_of_the_whole(village: farlod.City) -> None:
    west, south, east, north = village.city_bounds
    box = (west + 20.5, south + 20.5, east - 20.5, north - 20.5)
    part, whole = village.svf_grid(1.0, box), village.svf_grid(1.0)
    there = whole.svf.sel(x=part.x, y=part.y)
    np.testing.assert_allclose(part.svf, there, atol=0.01, equal_nan=True)
    assert part.sizes["x"] < whole.sizes["x"] and float(part.x[0]) > west + 20.0


def test_mask_leaves_the_rest_without_data(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    half = shapely.geometry.box(west, south, (west + east) / 2, north)
    grid, whole = village.svf_grid(2.0, mask=half), village.svf_grid(2.0)
    inside = (west < grid.x) & (grid.x < (west + east) / 2) & (south < grid.y) & (grid.y < north)
    assert grid.svf.where(~inside).isnull().all()
    np.testing.assert_allclose(grid.svf.where(inside), whole.svf.where(inside), atol=0.01, equal_nan=True)
    frame = geopandas.GeoDataFrame(geometry=[half], crs=village.crs).to_crs("EPSG:3857")
    other = village.svf_grid(2.0, mask=frame)
    # The border may move by a rounding
    assert (other.svf.isnull() != grid.svf.isnull()).sum() <= grid.sizes["y"]


def test_like_another_raster(village: farlod.City) -> None:
    whole = village.svf_grid(2.0)
    upside_down = whole.svf.isel(y=slice(None, None, -1))
    again = village.svf_grid(like=upside_down)
    xarray.testing.assert_equal(again.svf, upside_down)
    other = upside_down.rio.write_crs("EPSG:32633")
    with pytest.raises(farlod.InvalidArgument, match="another CRS"):
        village.svf_grid(like=other)


def test_netcdf_round_trip(village: farlod.City, tmp_path: Path) -> None:
    grid = village.svf_grid(2.0)
    grid.to_netcdf(tmp_path / "svf.nc")
    with xarray.open_dataset(tmp_path / "svf.nc", decode_coords="all") as back:
        np.testing.assert_array_equal(back.svf, grid.svf)
        assert back.rio.crs == grid.rio.crs
        assert json.loads(back.attrs["summary"])["receivers"] == int(grid.svf.notnull().sum())


def test_geotiff_says_what_is_no_data(village: farlod.City, tmp_path: Path) -> None:
    village.svf_grid(2.0).svf.rio.to_raster(tmp_path / "svf.tif")
    with rasterio.open(tmp_path / "svf.tif") as file:
        assert file.nodata is not None and np.isnan(file.nodata)


@pytest.mark.parametrize("chunks", [7, 32, (50, 20), "auto", -1])
def test_blocks_have_the_pixels_of_the_whole_to_the_bit(bridges_path: str, chunks: object) -> None:
    city = farlod.open(bridges_path)
    # A step that is no sum of powers of two
    whole = city.svf_grid(1.3, bounds=True, quantities=["hidden"])
    blocks = city.svf_grid(1.3, bounds=True, quantities=["hidden"], chunks=chunks)
    assert all(dask.is_dask_collection(variable) for variable in blocks.data_vars.values())
    (computed,) = dask.compute(blocks, scheduler="threads")
    for name in whole.data_vars:
        np.testing.assert_array_equal(computed[name].values, whole[name].values)


def test_mask_with_a_hole(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    centre = shapely.geometry.Point((west + east) / 2, (south + north) / 2)
    whole = village.svf_grid(2.0, mask=centre.buffer(50.0)).svf.notnull()
    ring = village.svf_grid(2.0, mask=centre.buffer(50.0).difference(centre.buffer(20.0))).svf.notnull()
    inner = village.svf_grid(2.0, mask=centre.buffer(20.0)).svf.notnull()
    assert int(inner.sum()) > 50 and int(whole.sum()) == int(ring.sum()) + int(inner.sum())


def test_blocks_with_a_mask(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    disc = shapely.geometry.Point((west + east) / 2, (south + north) / 2).buffer(60.0)
    np.testing.assert_array_equal(
        village.svf_grid(2.0, mask=disc, chunks=40).svf.values, village.svf_grid(2.0, mask=disc).svf.values
    )


def test_cluster_of_processes_gives_the_same_bits(bridges_path: str) -> None:
    city = farlod.open(bridges_path)
    whole = city.svf_grid(1.0)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, memory_limit="1GiB") as cluster:
        with Client(cluster) as client:
            lazy = city.svf_grid(1.0, chunks=64, memory_limit=900)
            np.testing.assert_array_equal(lazy.svf.compute().values, whole.svf.values)
            with pytest.raises(farlod.LimitReached):
                city.svf_grid(1.0, chunks=64, memory_limit=1).svf.compute()


def test_blocks_refuse_what_does_not_fit_at_once(village: farlod.City) -> None:
    with pytest.raises(farlod.InvalidArgument, match="chunks"):
        village.svf_grid(1.0, chunks="many")
    with pytest.raises(farlod.InvalidArgument, match="engine"):
        village.svf_grid(1.0, chunks=64, engine="fast")  # type: ignore[arg-type]


def test_ground(bridges_path: str) -> None:
    ground = farlod.open(bridges_path).ground(5.0)
    assert ground.dims == ("y", "x") and np.isfinite(ground.values).any()
    assert ground.attrs["units"] == "m"


def test_a_raster_that_has_no_room_names_its_step(village: farlod.City, monkeypatch: pytest.MonkeyPatch) -> None:
    from farlod import _grids

    def no_memory(*_: object) -> None:
        raise MemoryError("std::bad_alloc")

    said = r"step is 2: a raster of [0-9,]+ pixels \([0-9]+ x [0-9]+\) takes .* larger step"
    with monkeypatch.context() as patch:
        patch.setattr(_grids, "_memory_of_machine", lambda: 100)
        with pytest.raises(farlod.errors.LimitReached, match=said):
            village.svf_grid(2.0)
    monkeypatch.setattr(_grids._runtime, "evaluate_raster", no_memory)
    with pytest.raises(farlod.errors.LimitReached, match=said):
        village.svf_grid(2.0)


def test_a_step_out_of_range_is_named_as_the_argument_is(village: farlod.City) -> None:
    for step in (0.0, -1.0, 0.001, 20_000.0):
        for call in (village.svf_grid, village.ground):
            with pytest.raises(farlod.errors.InvalidArgument, match=f"^step is {step}: give 0.01 to 10,000 metres"):
                call(step)
