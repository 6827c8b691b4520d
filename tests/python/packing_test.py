# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Packing: files and models in memory give the same city, problems are told, and what goes wrong leaves nothing behind."""

from __future__ import annotations

import os
import pickle
import signal
import threading
import warnings
from pathlib import Path
from types import SimpleNamespace

import geopandas
import numpy as np
import pandas
import pytest
import rioxarray  # noqa: F401  the accessor .rio
import shapely.geometry
import xarray
from conftest import SAMPLES, SOURCES, box_mesh, points_of, run_program

import farlod


def test_same_package_as_the_program(tmp_path: Path) -> None:
    city = farlod.pack(SAMPLES / "village.gml", tmp_path / "python.farlod", report=False)
    run_program("farlod-pack", SAMPLES / "village.gml", "-o", tmp_path / "program.farlod")
    ours = sorted(p.relative_to(city.path) for p in Path(city.path).rglob("*") if p.is_file())
    theirs = tmp_path / "program.farlod"
    assert ours == sorted(p.relative_to(theirs) for p in theirs.rglob("*") if p.is_file())
    for file in ours:
        assert (Path(city.path) / file).read_bytes() == (theirs / file).read_bytes(), file


def test_footprints_in_memory_are_those_of_the_file(tmp_path: Path) -> None:
    frame = geopandas.read_file(SAMPLES / "village.geojson")
    from_file = farlod.pack(SAMPLES / "village.geojson", tmp_path / "file.farlod", report=False)
    from_memory = farlod.pack(frame, tmp_path / "memory.farlod", report=False)
    points = points_of(from_file, 300)
    np.testing.assert_allclose(from_memory.svf(points), from_file.svf(points), atol=1e-3, equal_nan=True)
    assert from_memory.info["buildings"] == from_file.info["buildings"]


def test_heights_of_footprints(tmp_path: Path) -> None:
    squares = [shapely.geometry.box(x, 5.3e6, x + 10, 5.3e6 + 10) for x in (690000.0, 690050.0, 690100.0)]
    data = {"floors": [2, 5, 3], "usage": ["a", None, "b"], "tags": [[1], [2], None]}
    frame = geopandas.GeoDataFrame(data, geometry=squares, crs="EPSG:25832")
    # As the option of farlod-pack is called, and as earlier versions called it
    for word in ("floor_height", "storey_height"):
        heights = farlod.Heights(storeys="floors", **{word: 4.0})
        city = farlod.pack(frame, tmp_path / f"{word}.farlod", heights=heights)
        roofs = city.surfaces("roofs", 2.0, points=True)
        assert sorted({round(z) for z in roofs.geometry.z}) == [8, 12, 20]
        assert city.crs.to_epsg() == 25832


def test_mesh_in_memory(tmp_path: Path) -> None:
    vertices, faces = box_mesh(690000.0, 5.3e6, 690020.0, 5.3e6 + 20.0, 0.0, 15.0)
    pair = farlod.pack((vertices, faces), tmp_path / "pair.farlod", crs="EPSG:25832")
    mesh = SimpleNamespace(vertices=vertices - (690000.0, 5.3e6, 0.0), faces=faces)
    moved = farlod.pack(mesh, tmp_path / "mesh.farlod", crs="EPSG:25832", obj_origin=(690000.0, 5.3e6, 0.0))
    points = points_of(pair, 100)
    np.testing.assert_allclose(pair.svf(points), moved.svf(points), atol=1e-4, equal_nan=True)
    assert pair.info["buildings"] == 1
    surfaces = pair.surfaces("all", 5.0, geometry=False)
    areas = surfaces.groupby("kind").area_m2.sum()
    assert areas["roof"] == pytest.approx(400.0, rel=1e-4) and areas["wall"] == pytest.approx(1200.0, rel=1e-4)


def surface_model(crs: str = "EPSG:25832") -> xarray.DataArray:
    """A block 10 m high in the middle of a square of 60 m."""
    heights = np.zeros((60, 60), np.float32)
    heights[20:40, 20:40] = 10.0
    coords = {"y": 5.3e6 + 59.5 - np.arange(60.0), "x": 690000.5 + np.arange(60.0)}
    return xarray.DataArray(heights, coords, ("y", "x")).rio.write_crs(crs)


def test_surface_model_in_memory(tmp_path: Path) -> None:
    dsm = surface_model()
    svf = dsm.farlod.svf()
    assert svf.dims == ("y", "x") and svf.shape == dsm.shape
    xarray.testing.assert_equal(svf.x, dsm.x)
    assert float(svf.sel(x=690030.5, y=5.3e6 + 30.5)) == pytest.approx(1.0, abs=1e-3)  # on the block
    foot, far = float(svf.sel(x=690030.5, y=5.3e6 + 18.5)), float(svf.sel(x=690001.5, y=5.3e6 + 1.5))
    # At the foot of a long wall half of the sky is hidden
    assert 0.4 < foot < 0.7 < 0.9 < far < 1.0
    city = dsm.farlod.pack(tmp_path / "dsm.farlod", report=False)
    np.testing.assert_array_equal(city.svf_grid(like=dsm, height=0.0, above="surface").svf, svf)
    xarray.testing.assert_equal(city.svf_grid(height=0.0, above="surface").svf.x, dsm.x)
    part = city.svf_grid(bbox=(690010.0, 5.3e6 + 20.0, 690030.0, 5.3e6 + 25.0), height=0.0, above="surface").svf
    np.testing.assert_array_equal(part, svf.sel(x=slice(690010.0, 690030.0), y=slice(5.3e6 + 25.0, 5.3e6 + 20.0)))
    upside_down = dsm.isel(y=slice(None, None, -1))
    np.testing.assert_array_equal(upside_down.farlod.svf().values, svf.values[::-1])
    assert set(dsm.farlod.svf(bounds=True).data_vars) == {"svf", "svf_low", "svf_high"}
    with pytest.raises(farlod.InputError, match="give one of them"):
        dsm.farlod.svf(terrain=dsm)


def test_surface_model_in_degrees() -> None:
    dsm = surface_model()
    degrees = dsm.rio.reproject("EPSG:4326", nodata=np.nan)
    degrees = degrees.fillna(0.0).rio.write_crs("EPSG:4326")
    svf = degrees.farlod.svf()
    assert svf.shape == degrees.shape and svf.dims == ("y", "x")
    back = svf.rio.write_crs("EPSG:4326").rio.reproject_match(dsm)
    there = dsm.farlod.svf()
    middle = dict(x=slice(5, 55), y=slice(5, 55))
    # Both rasters are steps of a metre
    assert float(np.abs(back - there).isel(middle).mean()) < 0.05
    without = dsm.drop_vars("spatial_ref")
    np.testing.assert_array_equal(without.farlod.svf(crs="EPSG:25832"), there)
    both = degrees.farlod.svf(quantities=["directional"], bounds=True)
    assert set(both.data_vars) == {"svf", "svf_low", "svf_high", "svfN", "svfE", "svfS", "svfW"}


def test_results_have_the_crs_of_the_footprints(tmp_path: Path) -> None:
    squares = [shapely.geometry.box(11.5, 48.1, 11.5003, 48.1002)]
    frame = geopandas.GeoDataFrame({"h": [9.0]}, geometry=squares, crs="EPSG:4326")
    city = farlod.pack(frame, tmp_path / "degrees.farlod", heights="h", report=False)
    assert city.crs.is_projected
    roofs = city.surfaces("roofs", 5.0)
    assert roofs.crs == frame.crs
    np.testing.assert_allclose(roofs.total_bounds, frame.total_bounds, atol=1e-6)
    assert pickle.loads(pickle.dumps(city)).surfaces("roofs", 5.0).crs == frame.crs
    assert farlod.open(city.path).surfaces("roofs", 5.0).crs == city.crs


def test_terrain_in_memory(tmp_path: Path) -> None:
    squares = [shapely.geometry.box(690020.0, 5.3e6 + 20, 690030.0, 5.3e6 + 30)]
    frame = geopandas.GeoDataFrame({"h": [6.0]}, geometry=squares, crs="EPSG:25832")
    ground = surface_model() * 0.0 + 100.0
    ground = ground.rio.write_crs("EPSG:25832")
    city = farlod.pack(frame, tmp_path / "hill.farlod", heights="h", terrain=ground, report=False)
    assert city.evaluate([[690005.0, 5.3e6 + 5.0]]).height[0] == pytest.approx(101.5, abs=0.01)
    tiles = [ground, ground + 20.0]
    city = farlod.pack(frame, tmp_path / "tiles.farlod", heights="h", terrain=tiles, report=False)
    assert city.evaluate([[690005.0, 5.3e6 + 5.0]]).height[0] == pytest.approx(121.5, abs=0.01)


def test_far_terrain_in_memory(tmp_path: Path) -> None:
    squares = [shapely.geometry.box(690020.0, 5.3e6 + 20, 690030.0, 5.3e6 + 30)]
    frame = geopandas.GeoDataFrame({"h": [6.0]}, geometry=squares, crs="EPSG:25832")
    steps = np.arange(-2000.0, 2001.0, 100.0)
    x, y = np.meshgrid(690025.0 + steps, 5.3e6 + 25 - steps)
    heights = np.where(np.hypot(x - 690025.0, y - 5.3e6 - 25) < 1000.0, 0.0, 500.0)
    ring = xarray.DataArray(heights, dims=("y", "x"), coords={"y": y[:, 0], "x": x[0]}).rio.write_crs("EPSG:25832")
    plain = farlod.pack(frame, tmp_path / "plain.farlod", heights="h", report=False)
    valley = farlod.pack(frame, tmp_path / "valley.farlod", heights="h", far_terrain=[ring], report=False)
    values = [city.evaluate([[690005.0, 5.3e6 + 5.0]]).svf[0] for city in (plain, valley)]
    assert values[1] == pytest.approx(values[0] * 0.8, abs=0.03)


def test_trees_in_memory(tmp_path: Path) -> None:
    squares = [shapely.geometry.box(690000.0 + x, 5.3e6 + 20, 690010.0 + x, 5.3e6 + 30) for x in (0.0, 60.0)]
    frame = geopandas.GeoDataFrame({"h": [6.0, 6.0]}, geometry=squares, crs="EPSG:25832")
    places = [shapely.geometry.Point(690020.0 + x, 5.3e6 + 25) for x in (0.0, 10.0, 20.0)]
    trees = geopandas.GeoDataFrame({"top": [8.0, 9.0, 10.0], "wide": [4.0, 5.0, 6.0]}, geometry=places, crs="EPSG:25832")
    described = farlod.Trees(trees, height="top", crown="wide", trunk_ratio=0.5)
    city = farlod.pack(frame, tmp_path / "trees.farlod", heights="h", trees=described)
    assert city.report.facts["crowns_of_trees"] == 3 and not city.report.problems
    under, almost_zenith = [[690020.5, 5.3e6 + 25.5]], ([180.0], [89.0], [2.0])
    assert city.sunlit(under, *almost_zenith) == 2.0
    assert city.sunlit(under, *almost_zenith, trees=True, transmissivity=0.25) == pytest.approx(0.5)
    with pytest.warns(farlod.ProblemsWarning, match="120 tree_size_missing"):
        other = farlod.pack(frame, tmp_path / "others.farlod", heights="h", trees=trees.drop(columns=["top", "wide"]))
    assert other.report.facts["crowns_of_trees"] == 3


def test_problems_are_told(tmp_path: Path) -> None:
    broken = SOURCES / "datasets" / "broken" / "104_ring_not_closed.gml"
    with pytest.warns(farlod.ProblemsWarning, match="104 ring_not_closed"):
        city = farlod.pack(broken, tmp_path / "broken.farlod")
    assert [problem.code for problem in city.report.problems] == [104]
    frame = city.report.to_frame()
    assert isinstance(frame, pandas.DataFrame) and frame.problem.tolist() == ["ring_not_closed"]
    assert city.report.facts["package_bytes"] > 0
    with pytest.raises(farlod.ProblemsRefused):
        with pytest.warns(farlod.ProblemsWarning):
            farlod.pack(broken, tmp_path / "refused.farlod", problems="refuse")
    assert not (tmp_path / "refused.farlod").exists()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert farlod.pack(broken, tmp_path / "silent.farlod", report=False).report is None


def test_package_that_is_there(tmp_path: Path) -> None:
    farlod.pack(SAMPLES / "village.gml", tmp_path / "twice.farlod", report=False)
    with pytest.raises(farlod.OutputError):
        farlod.pack(SAMPLES / "village.gml", tmp_path / "twice.farlod", report=False)
    farlod.pack(SAMPLES / "village.gml", tmp_path / "twice.farlod", report=False, overwrite=True)


def test_area(tmp_path: Path) -> None:
    whole = farlod.pack(SAMPLES / "village.gml", tmp_path / "whole.farlod", cell=50.0, report=False)
    west, south, _, _ = whole.bounds
    box = (west + 60.0, south + 60.0, west + 61.0, south + 61.0)
    part = farlod.pack(SAMPLES / "village.gml", tmp_path / "part.farlod", cell=50.0, area=box, report=False)
    assert 0 < part.info["cells_with_far_map"] < whole.info["cells_with_far_map"]
    frame = geopandas.GeoDataFrame(geometry=[shapely.geometry.box(*box)], crs=whole.crs).to_crs("EPSG:4326")
    same = farlod.pack(SAMPLES / "village.gml", tmp_path / "same.farlod", cell=50.0, area=frame, report=False)
    assert same.info["cells_with_far_map"] == part.info["cells_with_far_map"]


def test_grid_settings(tmp_path: Path) -> None:
    city = farlod.pack(SAMPLES / "village.gml", tmp_path / "g.farlod", cell=40.0, neighborhood=5, align=10.0, report=False)
    assert city.info["cell_edge_m"] == 40.0 and city.info["neighborhood"] == 5
    assert city.info["grid_bearing_deg"] == pytest.approx(10.0)


def test_progress_is_told_by_the_calling_thread(tmp_path: Path) -> None:
    seen: list[tuple[str, int, int, int]] = []

    def listen(stage: str, done: int, total: int) -> None:
        seen.append((stage, done, total, threading.get_ident()))

    city = farlod.pack(SAMPLES / "village.gml", tmp_path / "p.farlod", cell=10.0, report=False, progress=listen)
    assert seen and {thread for *_, thread in seen} == {threading.get_ident()}
    assert all(0 <= done <= total for _, done, total, _ in seen)
    seen.clear()
    city.svf_grid(0.2, progress=listen)
    assert seen


class Enough(Exception):
    """What a listener raises."""


def test_what_a_listener_raises_ends_the_run(tmp_path: Path) -> None:
    def stop(stage: str, done: int, total: int) -> None:
        raise Enough

    with pytest.raises(Enough):
        farlod.pack(SAMPLES / "village.gml", tmp_path / "p.farlod", cell=2.0, report=False, progress=stop)
    with pytest.raises(farlod.PackageUnusable):
        farlod.open(tmp_path / "p.farlod")


def test_interrupt_ends_a_packing(tmp_path: Path) -> None:
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            farlod.pack(SAMPLES / "village.gml", tmp_path / "p.farlod", cell=0.5, neighborhood=21, report=False)
    finally:
        timer.cancel()
    assert not (tmp_path / "p.farlod" / "manifest.json").exists()
