# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What wrong calls are told: one short line with the nearest word, in words of Python, and never an answer of nothing."""

from __future__ import annotations

import inspect
import itertools
from pathlib import Path
from typing import Any

import geopandas
import numpy as np
import pytest
import shapely.geometry
from conftest import SAMPLES

import farlod
from farlod._program_words import _HEIGHTS, _OTHER_NAMES, _SAME_NAMES, _TREES, words_of_python

HERE = [[550000.0, 5500000.0]]
LARGE = np.zeros((10_000, 3))
LONGEST = 260  #: the words of --quantity, and a sentence

#: Of each function: arguments that are arrays, or long lists, where a number or a word is wanted.
LARGE_ARGUMENTS = [
    ("svf", (HERE,), dict(height=LARGE)),
    ("svf", (HERE,), dict(above=LARGE)),
    ("svf", (HERE,), dict(engine=LARGE)),
    ("svf", (HERE,), dict(rays=LARGE)),
    ("svf", (HERE,), dict(bounds=LARGE)),
    ("svf", (HERE,), dict(max_error=LARGE)),
    ("svf", (HERE,), dict(progress=LARGE)),
    ("svf", (HERE,), dict(height=list(range(10_000)))),
    ("svf", (HERE,), dict(above="a" * 10_000)),
    ("horizon", (HERE, LARGE), {}),
    ("sky_patches", (HERE, LARGE), {}),
    ("light", (), dict(period=LARGE)),
    ("light", (LARGE,), {}),
    ("fisheye", (HERE[0], 99, LARGE), {}),
    ("svf_grid", (LARGE,), {}),
    ("svf_grid", (20.0, LARGE), {}),
    ("svf_grid", (20.0,), dict(chunks=LARGE)),
    ("surfaces", (LARGE,), {}),
    ("plot", (LARGE,), {}),
    ("check", (), dict(threads=LARGE)),
]


@pytest.mark.parametrize(("function", "arguments", "keywords"), LARGE_ARGUMENTS, ids=itertools.count())
def test_arguments_are_shown_in_short(village: farlod.City, function: str, arguments: Any, keywords: Any) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        getattr(village, function)(*arguments, **keywords)
    message = str(raised.value)
    assert "\n" not in message
    assert len(message) <= LONGEST


#: What is misspelt, and the word that is meant.
MISSPELT = [
    ("surfaces", ("roof",), {}, 'did you mean "roofs"?'),
    ("svf", (HERE,), dict(above="grond"), 'did you mean "ground"?'),
    ("svf", (HERE,), dict(engine="horizn"), 'did you mean "horizon"?'),
    ("svf", (HERE,), dict(metric="Cosine"), 'did you mean "cosine"?'),
    ("sky_patches", (HERE, "tregenz"), {}, 'did you mean "tregenza"?'),
    ("evaluate", (HERE,), dict(quantities=["hiden"]), 'did you mean "hidden"?'),
]


@pytest.mark.parametrize(("function", "arguments", "keywords", "text"), MISSPELT, ids=itertools.count())
def test_nearest_word(village: farlod.City, function: str, arguments: Any, keywords: Any, text: str) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        getattr(village, function)(*arguments, **keywords)
    assert str(raised.value).endswith(text)


#: Where nothing of the city is, or nothing is asked.
OF_NOTHING = [
    ("svf", ([[9.69, 49.65]],), {}, ("100 km from the city", 'degrees as a GeoSeries with crs="EPSG:4326"')),
    ("svf", ([[49.65, 9.69]],), {}, ("100 km from the city",)),
    ("svf", ([[5500000.0, 550000.0]],), {}, ("(5500000, 550000)", "easting and northing")),
    ("look_up", ([9.69, 49.65],), {}, ("100 km from the city",)),
    ("svf_grid", (20.0, (9.0, 49.0, 10.0, 50.0)), {}, ("nothing of the city lies", "WGS 84 / UTM zone 32N. If bbox is in degrees")),
    ("svf_grid", (20.0, (650000.0, 5500000.0, 650100.0, 5500100.0)), {}, ("nothing of the city lies",)),
    ("ground", (20.0, (9.0, 49.0, 10.0, 50.0)), {}, ("nothing of the city lies",)),
    ("sunlit", (HERE, [], [], []), {}, ("at least one position",)),
    ("irradiation", (HERE, None), {}, ("farlod.Light",)),
]


@pytest.mark.parametrize(("function", "arguments", "keywords", "said"), OF_NOTHING, ids=itertools.count())
def test_no_answer_of_nothing(village: farlod.City, function: str, arguments: Any, keywords: Any, said: Any) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        getattr(village, function)(*arguments, **keywords)
    for text in said:
        assert text in str(raised.value)


def test_points_with_a_crs_are_those_of_the_city(village: farlod.City) -> None:
    london = geopandas.GeoSeries([shapely.geometry.Point(-0.1, 51.5)], crs="EPSG:4326")
    with pytest.raises(farlod.InvalidArgument, match="100 km from the city.*: check the CRS of the GeoSeries"):
        village.svf(london)


def test_degrees_that_are_exchanged_are_shown_as_given(village: farlod.City) -> None:
    west, south, east, north = village.bounds
    here = geopandas.GeoSeries([shapely.geometry.Point((west + east) / 2, (south + north) / 2)], crs=village.crs_wkt)
    degrees = here.to_crs("EPSG:4326").iloc[0]
    exchanged = geopandas.GeoSeries([shapely.geometry.Point(degrees.y, degrees.x)], crs="EPSG:4326")
    with pytest.raises(farlod.InvalidArgument) as raised:
        village.svf(exchanged)
    assert f"({degrees.y:.10g}, {degrees.x:.10g}) in WGS 84" in str(raised.value)
    assert "give the longitude before the latitude" in str(raised.value)
    london = geopandas.GeoSeries([shapely.geometry.Point(-0.1, 51.5)], crs="EPSG:4326")
    with pytest.raises(farlod.InvalidArgument, match=r"points begin with \(-0\.1, 51\.5\), and all"):
        village.svf(london)


@pytest.mark.parametrize(
    ("shape", "found"),
    [(None, "no geometry"), (shapely.geometry.Point(), "an empty one"), (shapely.geometry.box(0, 0, 1, 1), "a Polygon")],
)
def test_first_geometry_that_is_no_point_is_named(village: farlod.City, shape: Any, found: str) -> None:
    point = shapely.geometry.Point(HERE[0])
    points = geopandas.GeoSeries([point, shape, point, None], index=["a", "b", "c", "d"], crs=village.crs_wkt)
    with pytest.raises(farlod.InvalidArgument, match=f"the first of 2 is {found} at index 'b'"):
        village.svf(points)


def test_footprints_without_heights_are_called_the_frame(tmp_path: Path) -> None:
    blocks = geopandas.GeoDataFrame({"name": ["a"]}, geometry=[shapely.geometry.box(0, 0, 9, 9)], crs="EPSG:32632")
    with pytest.raises(farlod.Error) as raised:
        farlod.pack(blocks, tmp_path / "p.farlod", report=False)
    assert "the GeoDataFrame" in str(raised.value)
    assert "gpkg" not in str(raised.value)
    assert "farlod-" not in str(raised.value)


def test_second_run_names_the_argument(tmp_path: Path) -> None:
    farlod.pack(SAMPLES / "village.gml", tmp_path / "v.farlod", cell=50.0, report=False).close()
    with pytest.raises(farlod.OutputError) as raised:
        farlod.pack(SAMPLES / "village.gml", tmp_path / "v.farlod", cell=50.0, report=False)
    assert "overwrite=True" in str(raised.value)
    assert "--" not in str(raised.value)


PACKINGS = [
    ("village.obj", {}, 'give crs="EPSG:n"'),
    ("village.gml", dict(out_crs="EPSG:4326"), 'out_crs="EPSG:4326" (WGS 84)'),
    ("village.geojson", dict(heights="hight"), "as heights=farlod.Heights(height=...)"),
    ("village.geojson", dict(heights=dict(default=3.0)), "give a farlod.Heights"),
    ("village.geojson", dict(layer="roads"), "as layer"),
]


@pytest.mark.parametrize(("city", "keywords", "text"), PACKINGS, ids=itertools.count())
def test_packing_is_told_in_words_of_python(tmp_path: Path, city: str, keywords: Any, text: str) -> None:
    with pytest.raises(farlod.Error) as raised:
        farlod.pack(SAMPLES / city, tmp_path / "p.farlod", report=False, **keywords)
    assert text in str(raised.value)
    assert "--" not in str(raised.value)


def test_what_another_packing_gives_is_told_in_words_of_python(tmp_path: Path) -> None:
    whole = farlod.pack(SAMPLES / "village.gml", tmp_path / "w.farlod", cell=50.0, assign="whole", report=False)
    box = farlod.pack(SAMPLES / "village.gml", tmp_path / "b.farlod", cell=50.0, far_map="box", report=False)
    west, south, east, north = box.bounds
    middle = [[(west + east) / 2, (south + north) / 2]]
    [[x, y]] = middle
    area = (x - 1.0, y - 1.0, x + 1.0, y + 1.0)
    part = farlod.pack(SAMPLES / "village.gml", tmp_path / "a.farlod", cell=50.0, area=area, report=False)
    calls: list[tuple[Any, str]] = [
        (lambda: whole.cells(), 'assign="clip"'),
        (lambda: box.svf(middle, bounds=True), '(farlod.pack with far_map="horizon")'),
        (lambda: part.svf_grid(20.0, engine="horizon"), "(farlod.pack with area)"),
    ]
    for call, text in calls:
        with pytest.raises(farlod.Error) as raised:
            call()
        assert text in str(raised.value)
        assert "--" not in str(raised.value)


def test_notes_of_a_report_name_arguments(tmp_path: Path) -> None:
    frame = geopandas.GeoDataFrame({"h": [9.5]}, geometry=[shapely.geometry.box(550000, 5500000, 550010, 5500012)], crs="EPSG:32632")
    city = farlod.pack(frame, tmp_path / "p.farlod", heights="h", surface="tin")
    assert any("surface is for a raster" in note for note in city.report.facts["notes"])
    assert not any("--" in note for note in city.report.facts["notes"])


#: What is no package, and what the message says of it.
def test_what_is_no_package(tmp_path: Path) -> None:
    (tmp_path / "cities").mkdir()
    (tmp_path / "cities" / "town.gml").write_text("<CityModel/>")
    (tmp_path / "empty").mkdir()
    farlod.pack(SAMPLES / "village.gml", tmp_path / "v.farlod", cell=50.0, report=False).close()
    for name, text in (
        ("cities", "town.gml. farlod-pack makes a package of a city"),
        ("empty", "is an empty folder"),
        ("cities/town.gml", "is a file, and a package is a folder"),
        ("v", "did you mean"),
        ("v.farlod/blocks", "is a part of the package"),
    ):
        with pytest.raises(farlod.PackageUnusable) as raised:
            farlod.open(tmp_path / name)
        assert text in str(raised.value)


def test_doubts_of_a_report_name_arguments(tmp_path: Path) -> None:
    houses = [shapely.geometry.box(550000 + 30 * n, 5500000, 550010 + 30 * n, 5500012) for n in range(12)]
    frame = geopandas.GeoDataFrame({"Etagen": [2 + n // 4 for n in range(12)]}, geometry=houses, crs="EPSG:32632")
    with pytest.warns(farlod.ProblemsWarning, match="the whole file: Etagen holds whole numbers.* Give heights=farlod"):
        city = farlod.pack(frame, tmp_path / "p.farlod", heights="Etagen")
    [doubt] = [problem for problem in city.report.problems if problem.code == 208]
    assert 'Give heights=farlod.Heights(storeys="Etagen") in place of heights=farlod.Heights(height=...)' in doubt.detail
    assert "--" not in doubt.detail


@pytest.mark.parametrize("option", [*_HEIGHTS, *_TREES, *_OTHER_NAMES, *_SAME_NAMES])
def test_what_is_advised_can_be_typed(option: str) -> None:
    text = words_of_python("--" + option)
    arguments = eval(f"dict({text})" if "=" in text else f"dict({text}=...)", {"farlod": farlod})  # noqa: S307
    assert set(arguments) <= set(inspect.signature(farlod.pack).parameters)


def test_values_that_are_advised_can_be_typed() -> None:
    for message, text in (
        ("Give --height-field height (ft) in place of --storeys-field", 'Give heights=farlod.Heights(height="height (ft)") in place'),
        ("--terrain-offset -2.9 instead of 5 would", "terrain_offset=-2.9 instead of 5 would"),
        ("give --up y: it", 'give up="y": it'),
        ("are they elevations (--canopy-absolute)?", "are they elevations (trees=farlod.Trees(absolute=True))?"),
        ("--shard 1/2", "--shard 1/2"),
    ):
        assert text in words_of_python(message)
