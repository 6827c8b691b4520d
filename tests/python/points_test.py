# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Points: closed forms, layouts of arrays, normals, CRS, and the same numbers as farlod-svf."""

from __future__ import annotations

from pathlib import Path

import geopandas
import numpy as np
import pandas
import pytest
from conftest import CANYON_HEIGHT, CANYON_WIDTH, points_of, run_program

import farlod

STREET = [690000.0, 5335000.0]


def test_floor_of_a_street_is_its_closed_form(canyon: farlod.City) -> None:
    # Oke (1987): the view factor of the sky from the middle of the floor is the cosine of the elevation of the walls
    height = 1.5
    expected = np.cos(np.arctan((CANYON_HEIGHT - height) / (CANYON_WIDTH / 2)))
    assert canyon.svf([STREET], height=height)[0] == pytest.approx(expected, abs=0.003)


def test_share_of_solid_angle_is_its_closed_form(canyon: farlod.City) -> None:
    # A lune between two planes through the horizontal axis of the street: its angle over the half turn
    height = 1.5
    expected = 1.0 - 2.0 * np.arctan((CANYON_HEIGHT - height) / (CANYON_WIDTH / 2)) / np.pi
    assert canyon.svf([STREET], height=height, metric="solid")[0] == pytest.approx(expected, abs=0.003)


def test_wall_in_the_open_sees_half_of_the_sky(canyon: farlod.City) -> None:
    above_all = [[*STREET, 200.0]]
    for normals in ([[1.0, 0.0, 0.0]], [[0.0, -3.0, 0.0]], [[37.0, 90.0]]):
        assert canyon.svf(above_all, normals=normals)[0] == pytest.approx(0.5, abs=1e-3)
    assert canyon.svf(above_all, normals=[[0.0, 0.0, -1.0]])[0] == 0.0


def test_vectors_and_angles_are_the_same_normals(canyon: farlod.City) -> None:
    points = np.repeat([[690003.0, 5335100.0, 2.0]], 50, axis=0)
    vectors = np.random.default_rng(2).normal(size=(50, 3))
    # Angles count from true north, vectors from the axes of the CRS
    azimuth = np.degrees(np.arctan2(vectors[:, 0], vectors[:, 1])) + canyon.info["convergence_deg"]
    tilt = np.degrees(np.arccos(vectors[:, 2] / np.linalg.norm(vectors, axis=1)))
    angles = np.column_stack([np.mod(azimuth, 360.0), tilt])
    by_vectors, by_angles = canyon.svf(points, normals=vectors), canyon.svf(points, normals=angles)
    np.testing.assert_allclose(by_vectors, by_angles, atol=2e-6)
    assert np.ptp(by_vectors) > 0.3


def test_same_numbers_as_the_program(village: farlod.City, tmp_path: Path) -> None:
    points = points_of(village, 2000)
    table = pandas.DataFrame(points, columns=["x", "y"])
    table.to_csv(tmp_path / "points.csv", index=False, float_format="%.17g")
    run_program("farlod-svf", village.path, "--points", tmp_path / "points.csv", "-o", tmp_path / "svf.csv", "--bounds")
    expected = pandas.read_csv(tmp_path / "svf.csv")
    svf, low, high = village.svf(points, bounds=True)
    assert np.isnan(svf).any() and not np.isnan(svf).all()
    for name, found in (("svf", svf), ("svf_low", low), ("svf_high", high)):
        # Six digits are what the program writes
        np.testing.assert_allclose(found, expected[name], atol=6e-7, equal_nan=True)


@pytest.mark.parametrize(
    "layout",
    [
        lambda p: p,
        np.asfortranarray,
        lambda p: p.tolist(),
        lambda p: np.repeat(p, 2, axis=0)[::2],
        lambda p: np.hstack([p, p])[:, :2],
        lambda p: np.column_stack([p, np.full(len(p), np.nan)]),
        pandas.DataFrame,
    ],
)
def test_layouts_of_arrays_give_the_same_bits(village: farlod.City, layout) -> None:  # type: ignore[no-untyped-def]
    points = points_of(village, 300)
    np.testing.assert_array_equal(village.svf(layout(points)), village.svf(points))


def test_numbers_of_other_types(village: farlod.City) -> None:
    west, south, _, _ = village.bounds
    whole = np.array([[int(west) + 30, int(south) + 30]])
    np.testing.assert_array_equal(village.svf(whole), village.svf(whole.astype(float)))


def test_no_points_are_no_answers(village: farlod.City) -> None:
    assert village.svf(np.empty((0, 2))).shape == (0,)


def test_geoseries_of_another_crs(village: farlod.City) -> None:
    points = points_of(village, 50)
    here = geopandas.GeoSeries(geopandas.points_from_xy(*points.T), index=[f"p{n}" for n in range(50)], crs=village.crs)
    answers = village.svf(here.to_crs("EPSG:4326"))
    assert isinstance(answers, pandas.Series) and answers.index.equals(here.index)
    np.testing.assert_allclose(answers.to_numpy(), village.svf(points), atol=1e-4, equal_nan=True)


def test_heights_of_geoseries(canyon: farlod.City) -> None:
    points = geopandas.GeoSeries(geopandas.points_from_xy([690000.0] * 2, [5335000.0] * 2, [2.0, 8.0]), crs=canyon.crs)
    np.testing.assert_array_equal(canyon.svf(points).to_numpy(), canyon.svf([[*STREET, 2.0], [*STREET, 8.0]]))


def test_bounds_enclose_the_exact_answer(village: farlod.City) -> None:
    points = points_of(village, 200)
    svf, low, high = village.svf(points, bounds=True)
    exact = village.svf(points, engine="exact", rays=20000)
    known = ~np.isnan(svf)
    assert (low[known] <= svf[known]).all() and (svf[known] <= high[known]).all()
    assert np.abs(exact - svf)[known].max() < 0.01
    np.testing.assert_array_equal(np.isnan(exact), ~known)


def test_further_quantities(village: farlod.City) -> None:
    points = points_of(village, 200)
    answers = village.evaluate(points, quantities=("svf_solid", "directional", "hidden"))
    q = answers.quantities
    np.testing.assert_array_equal(answers.svf, village.svf(points))
    # Outside of the grid both are of rays, and not of the same
    halves = np.abs(answers.svf - (q["svfE"] + q["svfW"]) / 2)
    assert np.nanmedian(halves) < 1e-6 and np.nanmax(halves) < 0.003
    np.testing.assert_allclose(answers.svf + q["hidden_near"] + q["hidden_far"], np.where(np.isnan(answers.svf), np.nan, 1.0), atol=0.003)
    np.testing.assert_allclose(q["svf_solid"], village.svf(points, metric="solid"), atol=6e-3, equal_nan=True)
    assert answers.summary["receivers"] == int((~np.isnan(answers.svf)).sum())


FACES = ("up", "down", "north", "east", "south", "west")
CLASSES = ("sky", "ground", "roof", "wall_n", "wall_ne", "wall_e", "wall_se", "wall_s", "wall_sw", "wall_w", "wall_nw", "crown", "other")


def test_views_around_points_add_up(village: farlod.City) -> None:
    points = points_of(village, 100)
    answers = village.evaluate(points, quantities=("view_cube", "view_sphere", "view_eye"), wall_sectors=8, eye_field=20.0, rays=500)
    known = ~np.isnan(answers.svf)
    assert len(answers.quantities) == 8 * len(CLASSES) and known.any()
    for view in (*FACES, "sphere", "eye"):
        seen = sum(answers.quantities[f"view_{what}_{view}"] for what in CLASSES)
        np.testing.assert_allclose(seen[known], 1.0, atol=1e-5)  # type: ignore[index]
    np.testing.assert_allclose(answers.quantities["view_sky_up"], answers.svf, atol=1e-6, equal_nan=True)
    whole = village.evaluate(points, quantities=["view_eye"], eye_field=90.0, rays=5000).quantities["view_sky_eye"]
    np.testing.assert_allclose(whole, answers.quantities["view_sky_sphere"], atol=0.01, equal_nan=True)


def test_views_by_solid_angle(village: farlod.City) -> None:
    points = points_of(village, 50)
    solid = village.evaluate(points, metric="solid", quantities=["view_factors", "view_sphere"]).quantities
    np.testing.assert_allclose(solid["view_sky"], village.svf(points, metric="solid"), atol=1e-6, equal_nan=True)
    np.testing.assert_allclose(2.0 * solid["view_sky_sphere"], solid["view_sky"], atol=1e-6, equal_nan=True)


def test_a_building_is_seen_where_nothing_hides_it(village: farlod.City) -> None:
    points = points_of(village, 100)
    building = village.surfaces("roofs", 5.0, geometry=False).building[0]
    seen = village.evaluate(points, quantities=["view_building"], sees=building, rays=200).quantities
    known = ~np.isnan(seen["view_building"])
    assert set(seen["sees_building"][known]) == {0.0, 1.0}
    assert (seen["view_building"][known] > 0.0).any() and seen["view_building"][known].max() < 1.0
    assert not (seen["view_building"][known] > 0.0)[seen["sees_building"][known] == 0.0].any()
    with pytest.raises(farlod.InvalidArgument, match='no building "cathedral"'):
        village.evaluate(points, quantities=["view_building"], sees="cathedral")
    with pytest.raises(farlod.InvalidArgument, match="view_building"):
        village.evaluate(points, sees=building)
    with pytest.raises(farlod.InvalidArgument, match="seen_building is empty"):
        village.evaluate(points, quantities=["view_building"])
    with pytest.raises(farlod.InvalidArgument, match="sees is 7"):
        village.evaluate(points, quantities=["view_building"], sees=7)  # type: ignore[arg-type]


def test_views_that_there_are_not(village: farlod.City) -> None:
    with pytest.raises(farlod.InvalidArgument, match="wall_sectors is 6"):
        village.evaluate([[550000.0, 5500000.0]], quantities=["view_factors"], wall_sectors=6)
    with pytest.raises(farlod.InvalidArgument, match="eye_field"):
        village.evaluate([[550000.0, 5500000.0]], quantities=["view_eye"], eye_field=100.0)
    with pytest.raises(farlod.InvalidArgument, match="view_cube"):
        village.surfaces("walls", 5.0, geometry=False, quantities=["view_cube"])


def test_verification_is_in_the_summary(village: farlod.City) -> None:
    answers = village.evaluate(points_of(village, 100), verify=20)
    assert answers.summary["verify"]["count"] == 20 and answers.summary["verify"]["max_abs_error"] < 0.02


def test_verification_belongs_to_what_has_a_summary(village: farlod.City) -> None:
    with pytest.raises(TypeError, match="verify"):
        village.svf([[550000.0, 5500000.0]], verify=5)  # type: ignore[call-overload]
    assert village.surfaces("walls", 5.0, geometry=False, verify=5).attrs["summary"]["verify"]["count"] == 5


def test_heights_above(canyon: farlod.City) -> None:
    roof = [[690030.0, 5335000.0]]
    assert np.isnan(canyon.svf(roof)[0])
    assert canyon.svf(roof, above="surface", height=1.0)[0] == pytest.approx(1.0, abs=1e-3)
    assert canyon.evaluate(roof, above="surface", height=1.0).height[0] == pytest.approx(CANYON_HEIGHT + 1.0, abs=1e-3)
    assert canyon.evaluate(roof, above="sea", height=50.0).height[0] == pytest.approx(50.0, abs=1e-3)


def test_points_far_from_the_city_have_no_answer_and_are_told_once(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    middle, far, near = [(west + east) / 2, (south + north) / 2], [east + 201.0, north], [east + 199.0, north]
    with pytest.warns(UserWarning, match=r"1 of 3 points lie more than 200 m .* first is point 1 ") as told:
        svf = village.svf([[*middle, 300.0], [*far, np.nan], [*near, np.nan]])
    assert len(told) == 1 and told[0].filename == __file__
    np.testing.assert_array_equal(np.isnan(svf), [False, True, False])
    with pytest.raises(farlod.errors.InvalidArgument, match="more than 200 m beyond the grid of the city"):
        village.svf([far, far])
    with pytest.raises(farlod.errors.InvalidArgument, match="more than 200 m beyond the grid of the city"):
        village.look_up(far)


def test_a_geoseries_of_a_wrong_crs_is_refused(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    here = geopandas.GeoSeries.from_xy([(west + east) / 2], [(south + north) / 2], crs=village.crs)
    assert len(village.svf(here)) == 1
    wrong = here.set_crs("EPSG:32633", allow_override=True)
    with pytest.raises(farlod.errors.InvalidArgument, match="100 km from the city.* check the CRS of the GeoSeries"):
        village.svf(wrong)
