# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Horizons, patches, the sun, and pictures: closed forms of a street."""

from __future__ import annotations

import json
from pathlib import Path

import matplotlib
import numpy as np
import pytest
import xarray
from conftest import CANYON_HEIGHT, CANYON_WIDTH, points_of, run_program

import farlod

matplotlib.use("Agg")

STREET = (690000.0, 5335000.0)
HEIGHT = 1.5


def expected_horizon(canyon: farlod.City, azimuth: np.ndarray) -> np.ndarray:
    """Of the middle of the street, which runs to grid north, in degrees."""
    across = np.abs(np.sin(np.radians(azimuth - canyon.info["convergence_deg"])))
    return np.degrees(np.arctan((CANYON_HEIGHT - HEIGHT) / (CANYON_WIDTH / 2) * across))


def test_horizon_of_a_street(canyon: farlod.City) -> None:
    found = canyon.horizon([STREET], 72, distances=True, height=HEIGHT)
    assert isinstance(found, xarray.Dataset)
    azimuth = found.azimuth.values
    aside = np.abs(np.sin(np.radians(azimuth - canyon.info["convergence_deg"]))) > 0.05
    np.testing.assert_allclose(found.horizon.values[0, aside], expected_horizon(canyon, azimuth)[aside], atol=0.1)
    across = np.abs(np.sin(np.radians(azimuth - canyon.info["convergence_deg"])))
    np.testing.assert_allclose(found.distance.values[0, aside], CANYON_WIDTH / 2 / across[aside], rtol=0.02)


def test_view_factor_from_horizons(village: farlod.City) -> None:
    points = points_of(village, 100)
    # The integral of cos² of the horizon's elevation over the azimuths (Johnson & Watson 1984)
    horizon = village.horizon(points, 360)
    svf = (np.cos(np.radians(horizon)) ** 2).mean("azimuth")
    np.testing.assert_allclose(svf, village.svf(points), atol=0.01, equal_nan=True)


@pytest.mark.parametrize(("patches", "count"), [("tregenza", 145), ("reinhart", 577)])
def test_patches(village: farlod.City, patches: str, count: int) -> None:
    points = points_of(village, 50)
    shares = village.sky_patches(points, patches)  # type: ignore[arg-type]
    assert shares.shape == (50, count)
    assert float(shares.view_factor.sum()) == pytest.approx(1.0, abs=1e-12)
    svf = (shares * shares.view_factor).sum("patch", skipna=False)
    np.testing.assert_allclose(svf, village.svf(points), atol=0.01, equal_nan=True)
    assert shares.elevation[-1] == 90.0 and shares.azimuth[0] == 0.0
    # A band is 12° high (Tregenza 1987), or half as high, more or less
    assert float(shares.elevation[0]) == pytest.approx({145: 6.0, 577: 90.0 / 29.0}[count])


def test_patches_behind_a_wall_are_dark(canyon: farlod.City) -> None:
    # Seen from the middle of the street, patches below the walls are hidden; those along the street are not
    shares = canyon.sky_patches([STREET], height=HEIGHT)[0]
    low_band = shares[shares.elevation < 7.0]
    across = np.abs(np.sin(np.radians(low_band.azimuth.values)))
    assert float(low_band[across > 0.9].max()) < 0.01


def test_sun_over_a_street(canyon: farlod.City) -> None:
    across, limit = 90.0 + canyon.info["convergence_deg"], float(expected_horizon(canyon, np.array([90.0]))[0])
    elevation = np.array([limit - 3.0, limit + 3.0, -5.0])
    hours = canyon.sunlit([STREET], [across] * 3, elevation, [1.0, 2.0, 4.0], height=HEIGHT)
    assert hours[0] == pytest.approx(2.0)


def test_sun_of_a_day(canyon: farlod.City) -> None:
    day = canyon.light(period="2026-06-21")
    azimuth, elevation, hours = day.sun
    of_light = canyon.sunlit([STREET], light=day, height=HEIGHT)
    assert of_light[0] == canyon.sunlit([STREET], azimuth, elevation, hours, height=HEIGHT)[0]
    assert 0.0 < of_light[0] < hours[elevation > 0.0].sum()


def test_light_in_a_street(canyon: farlod.City) -> None:
    light = farlod.Light([0.0, 0.0], [50.0, -5.0], 0.0, [1000.0, 0.0], sky_model="isotropic", month=[6, 12])
    found = canyon.irradiation([STREET], light, height=HEIGHT, quantities=["shade"])
    svf = float(canyon.svf([STREET], height=HEIGHT)[0])
    assert float(found.irradiation_diffuse[0]) == pytest.approx(svf, abs=1e-4)
    months = found.irradiation_by_month
    assert months.dims == ("point", "month") and months.month.values.tolist() == [6, 12]
    assert months.attrs["units"] == found.irradiation.attrs["units"] == "kW h m-2"
    assert float(months.sel(month=6)[0]) == pytest.approx(float(found.irradiation[0]))
    assert float(months.sel(month=12)[0]) == 0.0 and float(found.irradiation_reflected[0]) > 0.0
    assert float(found.shade[0]) == 0.0  # along the street


def test_illuminance_in_a_street(canyon: farlod.City) -> None:
    # Of two hours one knows its lx
    light = farlod.Light(
        [0.0, 0.0], [50.0, 50.0], 0.0, [100.0, 300.0], direct_normal_lux=0.0, diffuse_lux=[np.nan, 30000.0], sky_model="isotropic", albedo=(0, 0)
    )
    found = canyon.irradiation([STREET], light, height=HEIGHT, quantities=["illuminance"])
    svf = float(canyon.svf([STREET], height=HEIGHT)[0])
    assert float(found.illuminance[0]) == pytest.approx(30000.0 * svf, rel=1e-3)


EPW_ROW = "2026,3,20,{hour},0,?9?9?9,10,5,70,101000,0,0,300,{diffuse},0,{diffuse},0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0"


def write_epw(path: Path, latitude: float, longitude: float) -> Path:
    """A day without sun, and from 10 to 14 h with 100 W/m² of the sky."""
    rows = [EPW_ROW.format(hour=hour, diffuse=100 if 10 < hour <= 14 else 0) for hour in range(1, 25)]
    head = [f"LOCATION,Village,-,-,made up,0,{latitude},{longitude},1.0,100.0", "DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0"]
    head += ["GROUND TEMPERATURES,0", "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,", "COMMENTS 2,"]
    path.write_text("\n".join([*head, "DATA PERIODS,1,1,Data,Friday,3/20,3/20", *rows]) + "\n", encoding="utf-8")
    return path


def test_light_of_a_weather_file(canyon: farlod.City, tmp_path: Path) -> None:
    longitude, latitude = canyon._place()
    light = canyon.light(write_epw(tmp_path / "day.epw", latitude, longitude), by_month=True, albedo=(0.0, 0.0), sky_model="isotropic")
    assert light.hours == 24.0 and light.global_horizontal == pytest.approx(0.4)
    assert "day.epw" in light.source and light.remarks == []
    found = canyon.irradiation([STREET], light, height=HEIGHT)
    svf = float(canyon.svf([STREET], height=HEIGHT)[0])
    assert float(found.irradiation[0]) == pytest.approx(0.4 * svf, abs=1e-4)
    assert found.month.values.tolist() == [3]
    part = canyon.light(tmp_path / "day.epw", "03-20T12:00/13:00")
    assert part.hours == 1.0 and part.global_horizontal == pytest.approx(0.1)
    elsewhere = canyon.light(write_epw(tmp_path / "far.epw", -latitude, longitude))
    assert any("km" in remark for remark in elsewhere.remarks)


def test_light_of_a_clear_sky_is_that_of_the_program(canyon: farlod.City, tmp_path: Path) -> None:
    place = f"{STREET[0]},{STREET[1]}"
    run_program(
        "farlod-svf", canyon.path, "--at", place, "--height", HEIGHT, "--quantity", "irradiation", "--period", "2026-05/06", "--by", "month",
        "--step", 30, "--linke", 4, "-o", tmp_path / "o.csv", "--summary", tmp_path / "s.json",
    )
    expected = np.genfromtxt(tmp_path / "o.csv", delimiter=",", names=True)
    light = canyon.light(period="2026-05/06", step=30, linke_turbidity=4.0, by_month=True)
    told = json.loads((tmp_path / "s.json").read_text())["light"]
    assert light.hours == told["hours"] == 61 * 24
    assert light.global_horizontal == pytest.approx(told["global_horizontal_kwh_m2"], rel=1e-9)
    found = canyon.irradiation([STREET], light, height=HEIGHT)
    assert float(found.irradiation[0]) == pytest.approx(float(expected["irradiation"]), rel=1e-5)
    assert float(found.irradiation_by_month.sel(month=5)[0]) == pytest.approx(float(expected["irradiation_05"]), rel=1e-5)
    assert float(found.irradiation_by_month.sum()) == pytest.approx(float(found.irradiation[0]), rel=1e-5)


def test_light_over_a_raster(village: farlod.City) -> None:
    light = village.light(period="2026-06-30T12:00/2026-07-01T12:00", step=60, by_month=True)
    grid = village.svf_grid(5.0, light=light, quantities=["shade"])
    months = grid.irradiation_by_month
    assert months.dims == ("month", "y", "x") and months.month.values.tolist() == [6, 7]
    assert "irradiation_06" not in grid and {"irradiation_direct", "shade"} <= set(grid.data_vars)
    np.testing.assert_allclose(months.sum("month", skipna=False), grid.irradiation, rtol=1e-4)
    blocks = village.svf_grid(5.0, light=light, quantities=["shade"], chunks=16).compute()
    xarray.testing.assert_equal(blocks, grid)


def test_shade_of_each_step(village: farlod.City) -> None:
    light = village.light(period="2026-06-21T10:00/12:00", step=60, by_step=True)
    grid = village.svf_grid(5.0, light=light, quantities=["shade"])
    steps = grid.shade_by_step
    assert steps.dims == ("time", "y", "x") and "shade_20260621T1000" not in grid
    for hour in (10, 11):
        alone = village.light(period=f"2026-06-21T{hour}:00/{hour + 1}:00", step=60)
        expected = village.svf_grid(5.0, light=alone, quantities=["shade"]).shade
        np.testing.assert_allclose(steps.sel(time=f"2026-06-21T{hour}:00"), expected, atol=1e-6)
    assert float(abs(steps.diff("time")).max()) > 0.5, "shadows move"
    blocks = village.svf_grid(5.0, light=light, quantities=["shade"], chunks=16).compute()
    xarray.testing.assert_equal(blocks, grid)


def test_shade_of_each_step_of_arrays(canyon: farlod.City) -> None:
    begin = np.array(["2026-06-21T12", "2026-06-21T22", "2026-06-22T06"], "datetime64[h]")
    light = farlod.Light([180.0, 0.0, 90.0], [89.0, -20.0, 1.0], 800.0, 100.0, begin=begin)
    found = canyon.irradiation([STREET], light, height=HEIGHT, quantities=["shade"])
    assert found.shade_by_step.dims == ("point", "time")
    assert found.time.values.astype("datetime64[h]").tolist() == begin[[0, 2]].tolist(), "at night there is no shade"
    assert float(found.shade_by_step[0, 0]) == 0.0
    for wrong in ("soon", [np.datetime64("NaT")]):
        with pytest.raises(farlod.InvalidArgument, match="begin"):
            farlod.Light(180.0, 30.0, 800.0, 100.0, begin=wrong)


def test_light_on_surfaces(village: farlod.City) -> None:
    light = village.light(period="2026-06-21", step=60)
    roofs = village.surfaces("roofs", 4.0, light=light, irradiation_threshold=5.0, geometry=False)
    np.testing.assert_allclose(roofs.irradiation_kwh, roofs.irradiation * roofs.area_m2, rtol=1e-5)
    receivers = village.surfaces("roofs", 4.0, light=light, points=True)
    above = receivers[receivers.irradiation >= 5.0].area_m2.sum()
    assert 0.0 < above < roofs.area_m2.sum()
    assert roofs.area_above_m2.sum() == pytest.approx(above)
    assert "area_above_m2" not in village.surfaces("roofs", 4.0, light=light, geometry=False)
    assert "irradiation_kwh" not in village.surfaces("roofs", 4.0, geometry=False)


def test_looking_up(canyon: farlod.City) -> None:
    sky = canyon.look_up(STREET, height=HEIGHT)
    assert sky is not None
    assert sky.height == pytest.approx(HEIGHT) and sky.svf == pytest.approx(float(canyon.svf([STREET], height=HEIGHT)[0]))
    azimuth = (np.arange(1440) + 0.5) / 4.0
    # The part of each azimuth that is sky begins at the horizon
    first_sky = (sky.parts == 0).argmax(axis=1) / 4.0
    aside = np.abs(np.sin(np.radians(azimuth - canyon.info["convergence_deg"]))) > 0.05
    np.testing.assert_allclose(first_sky[aside], expected_horizon(canyon, azimuth)[aside], atol=0.5)
    assert canyon.look_up((690030.0, 5335000.0)) is None


@pytest.mark.parametrize("projection", ["equidistant", "equisolid", "orthographic", "stereographic"])
def test_picture_has_the_walls_where_they_are(canyon: farlod.City, projection: str) -> None:
    # Close to the eastern wall: it fills the left of the picture
    east_side = (STREET[0] + CANYON_WIDTH / 2 - 1.0, STREET[1])
    image = canyon.fisheye(east_side, 101, projection)  # type: ignore[arg-type]
    blue = image[50, :, 2] > 200
    assert not blue[5:30].any() and blue[55:70].all()
    assert image[0, 0, 3] == 0 and image[50, 50, 3] == 255


def test_share_of_sky_in_an_equisolid_picture(canyon: farlod.City) -> None:
    # Equal areas of this picture are equal solid angles
    image = canyon.fisheye(STREET, 801, "equisolid", height=HEIGHT)
    inside = image[..., 3] > 0
    share = (image[inside][:, 2] > 200).mean()
    assert share == pytest.approx(float(canyon.svf([STREET], height=HEIGHT, metric="solid")[0]), abs=0.01)


def test_map(village: farlod.City) -> None:
    axes = village.plot(step=4.0)
    west, east = axes.get_xlim()
    assert west < east and axes.get_ylabel() == "northing (m)"
    assert len(axes.collections) == 1 and len(axes.images) == 1
    grid = village.svf_grid(4.0, quantities=["directional"])
    _, given = matplotlib.pyplot.subplots()
    assert village.plot(grid, ax=given, variable="svfN", outlines=False, cmap="magma") is given
    assert given.images[0].get_cmap().name == "magma" and not given.collections
