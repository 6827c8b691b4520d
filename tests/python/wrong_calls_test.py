# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Wrong arguments: each function says what is wrong and what to do, and nothing crashes."""

from __future__ import annotations

import itertools
import math
import os
from typing import Any, get_args

import geopandas
import numpy as np
import pytest
import shapely.geometry
import xarray
from conftest import SAMPLES
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import farlod
from farlod import _settings, _surfaces
from farlod._modules import runtime

NAN, INF = math.nan, math.inf
HERE = [[550000.0, 5500000.0]]
LONDON = geopandas.GeoSeries([shapely.geometry.Point(-0.1, 51.5)], crs="EPSG:4326")
NOWHERE = geopandas.GeoSeries([shapely.geometry.Point(0.0, 0.0)])
LINE = geopandas.GeoSeries([shapely.geometry.LineString([(0, 0), (1, 1)])], crs="EPSG:4326")

#: Of each function that takes them: an argument that it cannot take, and what the message says.
POINTS = [
    ([1.0, 2.0], "shape"),
    ([[1.0]], "shape"),
    ([[1.0, 2.0, 3.0, 4.0]], "shape"),
    (np.zeros((2, 2, 2)), "shape"),
    ("here", "array of numbers"),
    ([["a", "b"]], "array of numbers"),
    ([[1.0, 2.0], [3.0]], "array of numbers"),
    (None, "array of numbers"),
    ([[1 + 2j, 0]], "array of numbers"),
    ([[NAN, 5500000.0]], "index 0"),
    ([HERE[0], [INF, 0.0]], "index 1"),
    ([[1e12, 0.0]], "nowhere on Earth"),
    ([[*HERE[0], INF]], "nowhere on Earth"),
    (NOWHERE, "CRS"),
    (LINE, "no points"),
]
SHARED = [
    (dict(height="tall"), "height"),
    (dict(height=NAN), "height"),
    (dict(height=-5.0), "height"),
    (dict(above="roof"), '"surface"'),
    (dict(above=3), '"surface"'),
    (dict(max_error=0.0), "max_error"),
    (dict(max_error="small"), "max_error"),
    (dict(engine="fast"), '"exact"'),
    (dict(azimuths=2.5), "azimuths"),
    (dict(azimuths=-1), "azimuths"),
    (dict(azimuths=True), "azimuths"),
    (dict(rays=0), "rays"),
    (dict(rays=10**12), "rays"),
    (dict(directions="all"), "fibonacci"),
    (dict(threads=-1), "threads"),
    (dict(threads=5000), "threads"),
    (dict(memory_limit=0), "memory_limit"),
    (dict(progress=3), "progress"),
]
SUN = farlod.Light(180.0, 30.0, 800.0, 100.0)
CALLS = {
    "svf": (
        [((points,), {}, text) for points, text in POINTS]
        + [((HERE,), keywords, text) for keywords, text in SHARED]
        + [
            ((HERE,), dict(metric="area"), '"cosine"'),
            ((HERE,), dict(bounds="yes"), "bounds"),
            ((HERE,), dict(normals=[0.0, 0.0, 1.0]), "normals"),
            ((HERE,), dict(normals=[[0.0, 0.0, 0.0]]), "zero"),
            ((HERE,), dict(normals=[[0.0, NAN, 1.0]]), "finite"),
            ((HERE,), dict(normals=[[0.0, 200.0]]), "normal"),
            ((HERE,), dict(normals=[[0.0, 0.0, 1.0]] * 2), "normals"),
        ]
    ),
    "evaluate": [
        ((HERE,), dict(quantities=["horizon"]), '"hidden"'),
        ((HERE,), dict(quantities="none"), '"hidden"'),
        ((HERE,), dict(verify=-1), "verify"),
        ((HERE,), dict(quantities=["hidden"], metric="solid"), "cosine"),
        (("points",), {}, "array of numbers"),
    ],
    "horizon": [((HERE, 3), {}, "n_azimuth"), ((HERE, 4.5), {}, "n_azimuth"), ((HERE,), dict(distances=1), "distances")],
    "sky_patches": [((HERE, "perez"), {}, '"reinhart"'), ((HERE,), dict(normals=[1.0]), "normals")],
    "sunlit": [
        ((HERE, [0.0], [1.0, 2.0], [1.0]), {}, "the sun's"),
        ((HERE, ["east"], [1.0], [1.0]), {}, "sun"),
        ((HERE, [NAN], [1.0], [1.0]), {}, "sun"),
        ((HERE, [0.0], [1.0]), {}, "give one of the two"),
        ((HERE, [0.0], [1.0], [1.0]), dict(light=SUN), "give one of the two"),
        ((HERE,), dict(light=1.0), "farlod.Light"),
    ],
    "irradiation": [
        ((HERE, 800.0), {}, "farlod.Light"),
        ((HERE, farlod.Light(0.0, 1.0, -1.0, 1.0)), {}, "direct irradiance"),
        ((HERE, farlod.Light(0.0, NAN, 1.0, 1.0)), {}, "elevation"),
        ((HERE, farlod.Light(0.0, 1.0, 1.0, 1.0, albedo=(0.1, 1.5))), {}, "albedo"),
        ((HERE, SUN), dict(quantities=["wind"]), "quantities"),
    ],
    "light": [
        ((), {}, "period"),
        ((3,), {}, "weather"),
        ((), dict(period="someday"), "someday"),
        ((), dict(period="06-21"), "06-21"),
        ((), dict(period="2026-06-21", step=0), "step"),
        ((), dict(period="2026-06-21", linke_turbidity=99.0), "urbidity"),
        ((), dict(period="2026-06-21", by_month="yes"), "by_month"),
        ((), dict(period="2026-06-21", by_step=1), "by_step"),
        ((), dict(period="2026-06-21", sky_model="blue"), '"isotropic"'),
    ],
    "look_up": [((HERE,), {}, "shape"), (([1.0],), {}, "shape"), (([NAN, 0.0],), {}, "nowhere")] + [
        ((HERE[0],), keywords, text) for keywords, text in SHARED
    ],
    "fisheye": [
        ((HERE[0], 2), {}, "size"),
        ((HERE[0], 99, "mercator"), {}, '"equisolid"'),
    ],
    "svf_grid": [
        ((0.0,), {}, "step"),
        ((NAN,), {}, "step"),
        (("fine",), {}, "step"),
        ((1.0, (0, 0, 1)), {}, "west, south, east, north"),
        ((1.0, (5, 5, 1, 1)), {}, "empty"),
        ((1.0, (0, 0, NAN, 1)), {}, "west, south, east, north"),
        ((0.01, (0, 0, 1e7, 1e7)), {}, "too many pixels"),
        ((), dict(mask="here"), "polygons"),
        ((), dict(mask=LINE), "polygons"),
        ((), dict(mask=NOWHERE), "CRS"),
        ((), dict(mask=shapely.geometry.Polygon()), "polygon"),
        ((), dict(like=xarray.DataArray(np.zeros((3, 3)), dims=("y", "x"))), "CRS"),
        ((), dict(like=3), "DataArray"),
        ((), dict(chunks=(1, 2, 3)), "chunks"),
        ((), dict(chunks=64, verify=5), "verify"),
        ((2.0,), dict(like=xarray.DataArray(np.zeros((3, 3)), dims=("y", "x"))), "like and step"),
        ((), dict(like=3, bbox=(0, 0, 1, 1)), "like and bbox"),
        ((20.0,), dict(quantities=["wind"]), "quantities"),
        ((20.0,), dict(quantities=["shade"]), "light"),
        ((20.0,), dict(light=800.0), "farlod.Light"),
        ((20.0,), dict(light=farlod.Light(180.0, 30.0, 800.0, 100.0), quantities=["illuminance"]), "lx"),
    ],
    "cells": [
        ((), dict(threads="two"), "threads"),
        ((), dict(progress=3), "progress"),
        (("fine",), {}, "svf"),
        ((0.0,), {}, "spacing_m"),
        ((5.0,), dict(engine="fast"), '"auto"'),
        ((), dict(zones=[1]), "GeoDataFrame"),
        ((), dict(zones=NOWHERE), "CRS"),
        ((), dict(zones=LINE), "polygons"),
        ((), dict(zones=geopandas.GeoSeries([shapely.geometry.Polygon()], crs=32632)), "area"),
    ],
    "ground": [((0.0,), {}, "step"), ((5.0,), dict(threads="two"), "threads")],
    "surfaces": [
        (("doors",), {}, '"roofs"'),
        (("walls", 0.0), {}, "spacing"),
        (("walls",), dict(points="yes"), "points"),
        (("walls",), dict(geometry=None), "geometry"),
        (("walls",), dict(points=True, geometry=False), "geometry"),
        (("walls",), dict(verify=1.5), "verify"),
        (("walls",), dict(max_error=7.0), "max_error"),
        (("walls",), dict(irradiation_threshold=800.0), "irradiation"),
        (("walls",), dict(light=SUN, irradiation_threshold=-1.0), "threshold"),
    ],
    "view_factor_matrix": [
        (("doors",), {}, '"roofs"'),
        (("walls", 0.0), {}, "spacing"),
        ((), dict(threshold=2.0), "threshold"),
        ((), dict(threshold="small"), "threshold"),
        ((), dict(mask=LINE), "polygons"),
        ((), dict(rays=0), "rays"),
    ],
    "plot": [((xarray.Dataset(),), {}, "coordinates"), ((xarray.Dataset(),), dict(step=2.0), "grid and step"), ((), dict(step=-1.0), "step")],
    "check": [((), dict(threads=1.5), "threads")],
}


@pytest.mark.parametrize(
    ("function", "arguments", "keywords", "text"),
    [(name, *call) for name, calls in CALLS.items() for call in calls],
    ids=itertools.count(),
)
def test_message_says_what_is_wrong(village: farlod.City, function: str, arguments: Any, keywords: Any, text: str) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        getattr(village, function)(*arguments, **keywords)
    assert text in str(raised.value)


@pytest.mark.parametrize(
    ("arguments", "keywords", "text"),
    [
        (([0.0, 1.0, 2.0], [1.0, 2.0], 1.0, 1.0), {}, "one length"),
        ((0.0, 1.0, "bright", 1.0), {}, "direct_normal"),
        ((0.0, 1.0, 1.0, 1.0), dict(sky_model="blue"), '"isotropic"'),
        ((0.0, 1.0, 1.0, 1.0), dict(albedo=[0.1]), "albedo"),
        ((0.0, 1.0, 1.0, 1.0), dict(month=13), "month"),
    ],
)
def test_light_says_what_is_wrong(arguments: Any, keywords: Any, text: str) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        farlod.Light(*arguments, **keywords)
    assert text in str(raised.value)


def test_unknown_keyword_is_a_type_error(village: farlod.City) -> None:
    with pytest.raises(TypeError, match="hieght"):
        village.svf(HERE, hieght=2.0)  # type: ignore[call-overload]


@pytest.mark.parametrize("function", [name for name in CALLS if name != "check"] + ["check"])
def test_closed_city(village: farlod.City, function: str) -> None:
    village.close()
    good = {"sunlit": (HERE, [0.0], [1.0], [1.0]), "irradiation": (HERE, SUN), "light": (None, "2026"), "look_up": (HERE[0],), "fisheye": (HERE[0],)}
    arguments = good.get(function, (HERE,) if function in ("svf", "evaluate", "horizon", "sky_patches") else ())
    with pytest.raises(farlod.InvalidArgument, match="closed"):
        getattr(village, function)(*arguments)
    with pytest.raises(farlod.InvalidArgument, match="closed"):
        with village:
            pass


def test_points_of_another_country_are_refused(village: farlod.City) -> None:
    with pytest.raises(farlod.InvalidArgument, match="100 km from the city"):
        village.svf(LONDON)


def test_memory_limit(village: farlod.City) -> None:
    with pytest.raises(farlod.LimitReached):
        village.svf_grid(0.05, memory_limit=1)
    assert issubclass(farlod.LimitReached, MemoryError)


FRAME = geopandas.GeoDataFrame({"h": [1.0]}, geometry=[shapely.geometry.box(0, 0, 10, 10)])
PACKINGS = [
    (3, {}, "city is a int"),
    (None, {}, "give a path"),
    ("", {}, "path"),
    (FRAME, {}, "CRS"),
    (FRAME.iloc[:0].set_crs("EPSG:25832"), {}, "no rows"),
    ((np.zeros((3, 2)), np.array([[0, 1, 2]])), {}, "vertices"),
    ((np.full((3, 3), NAN), np.array([[0, 1, 2]])), {}, "vertices"),
    ((np.zeros((3, 3)), np.array([[0, 1, 3]])), {}, "there are 3"),
    ((np.zeros((3, 3)), np.array([[0.0, 1.0, 2.0]])), {}, "faces"),
    (xarray.DataArray(np.zeros((4, 4)), dims=("y", "x")), {}, "CRS"),
    (xarray.DataArray(np.zeros(4), dims=("x",)), {}, "(y, x)"),
    (SAMPLES / "village.gml", dict(cell=0.0), "cell"),
    (SAMPLES / "village.gml", dict(cell="large"), "cell"),
    (SAMPLES / "village.gml", dict(neighborhood=4), "neighborhood"),
    (SAMPLES / "village.gml", dict(neighborhood=2.5), "neighborhood"),
    (SAMPLES / "village.gml", dict(max_error=-1), "max_error"),
    (SAMPLES / "village.gml", dict(align="north"), "align"),
    (SAMPLES / "village.gml", dict(align=NAN), "align"),
    (SAMPLES / "village.gml", dict(area=(1, 2, 3)), "area"),
    (SAMPLES / "village.gml", dict(crs=-5), "crs"),
    (SAMPLES / "village.gml", dict(lod=7), "lod"),
    (SAMPLES / "village.gml", dict(up="x"), "up"),
    (SAMPLES / "village.gml", dict(obj_origin=(1, 2)), "obj_origin"),
    (SAMPLES / "village.gml", dict(ground_names=["lot", ""]), "ground_names"),
    (SAMPLES / "village.gml", dict(ground_names=[5]), "ground_names"),
    (SAMPLES / "village.gml", dict(assign="cut"), "assign"),
    (SAMPLES / "village.gml", dict(far_map="none"), "far_map"),
    (SAMPLES / "village.gml", dict(problems="ignore"), "problems"),
    (SAMPLES / "village.gml", dict(overwrite="yes"), "overwrite"),
    (SAMPLES / "village.gml", dict(heights=farlod.Heights(default=-3.0)), "default"),
    (SAMPLES / "village.gml", dict(trees=farlod.Trees(trunk_ratio=2.0)), "trunk_ratio"),
    (SAMPLES / "village.gml", dict(trees=farlod.Trees(canopy_trunk="trunk.tif")), "canopy"),
    (SAMPLES / "village.gml", dict(trees=5), "city"),
    (SAMPLES / "village.gml", dict(threads=-2), "threads"),
]


@pytest.mark.parametrize(("city", "keywords", "text"), PACKINGS, ids=itertools.count())
def test_wrong_packings(tmp_path: Any, city: Any, keywords: Any, text: str) -> None:
    with pytest.raises(farlod.InvalidArgument) as raised:
        farlod.pack(city, tmp_path / "p.farlod", report=False, **keywords)
    assert text in str(raised.value)
    assert not os.path.exists(tmp_path / "p.farlod")


def test_input_that_is_not_there(tmp_path: Any) -> None:
    with pytest.raises(farlod.InputError, match="does not exist"):
        farlod.pack(tmp_path / "none.gml", tmp_path / "p.farlod")
    with pytest.raises(farlod.InvalidArgument, match="path"):
        farlod.open(3)  # type: ignore[arg-type]


# Anything at all, as single arguments and together

NUMBERS = st.one_of(
    st.floats(allow_nan=True, allow_infinity=True),
    st.integers(-(2**70), 2**70),
    st.sampled_from([0, 1, -1, 0.5, 1.5, 320, 10**6, NAN, INF, True, None]),
)
VALUES = st.one_of(NUMBERS, st.text(max_size=6), st.binary(max_size=4), st.lists(NUMBERS, max_size=4), st.none())
NEAR = st.tuples(st.floats(549900.0, 550100.0), st.floats(5499900.0, 5500100.0))
ARRAYS = st.one_of(
    st.lists(NEAR, max_size=5),
    st.lists(st.lists(NUMBERS, min_size=2, max_size=3), max_size=3),
    VALUES,
)
# What would take minutes is not asked for
SMALL = st.one_of(st.integers(-3, 600), VALUES.filter(lambda v: not isinstance(v, (int, float)) or not 600 < v < math.inf))
KEYWORDS = st.fixed_dictionaries(
    {},
    optional={
        "height": st.one_of(st.floats(0, 50), VALUES),
        "above": st.one_of(st.sampled_from(["ground", "surface", "sea"]), VALUES),
        "max_error": st.one_of(st.floats(0.01, 1.0), st.none(), st.text(max_size=3), st.just(NAN)),
        "engine": st.one_of(st.sampled_from(["auto", "horizon", "rays", "exact", "near"]), VALUES),
        "azimuths": SMALL,
        "rays": SMALL,
        "directions": st.one_of(st.sampled_from(["partition", "fibonacci"]), VALUES),
        "threads": st.one_of(st.integers(0, 3), VALUES),
        "memory_limit": VALUES,
    },
)


def answers_or_refuses(call: Any) -> None:
    """A call ends with an answer, or with an exception of farlod's; an unusual argument may be a TypeError."""
    try:
        call()
    except (farlod.Error, TypeError):
        pass


@settings(max_examples=600, deadline=None, suppress_health_check=list(HealthCheck))
@given(points=ARRAYS, normals=st.one_of(st.none(), ARRAYS), bounds=st.one_of(st.booleans(), VALUES), keywords=KEYWORDS)
def test_random_calls_with_points(village_path: str, points: Any, normals: Any, bounds: Any, keywords: Any) -> None:
    city = farlod.open(village_path)
    answers_or_refuses(lambda: city.svf(points, normals=normals, bounds=bounds, **keywords))


@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(point=st.one_of(NEAR, ARRAYS), count=SMALL, patches=VALUES, keywords=KEYWORDS)
def test_random_calls_of_skies(village_path: str, point: Any, count: Any, patches: Any, keywords: Any) -> None:
    city = farlod.open(village_path)
    answers_or_refuses(lambda: city.horizon([point], count, **keywords))
    answers_or_refuses(lambda: city.look_up(point, **keywords))
    answers_or_refuses(lambda: city.sky_patches([point], patches, **keywords))


@settings(max_examples=200, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    step=st.one_of(st.floats(5.0, 50.0), VALUES.filter(lambda v: not isinstance(v, float) or not 0.0 < v < 5.0)),
    box=st.one_of(st.none(), VALUES, st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS)),
    keywords=KEYWORDS,
)
def test_random_rasters(village_path: str, step: Any, box: Any, keywords: Any) -> None:
    city = farlod.open(village_path)
    if keywords.get("engine") in ("rays", "exact"):
        keywords["rays"] = 20
    answers_or_refuses(lambda: city.svf_grid(step, box, **keywords))


def test_types_name_the_words_of_the_library():
    types = {
        "engine": _settings.Engine,
        "metric": _settings.Metric,
        "directions": _settings.Directions,
        "above": _settings.Above,
        "canopy_rule": _settings.CanopyRule,
        "sky_model": _settings.SkyModel,
        "which": _surfaces.Choice,
    }
    assert {name: get_args(words) for name, words in types.items()} == {name: runtime.words[name] for name in types}
    assert ("none", *get_args(_settings.SkyPatches)) == runtime.words["sky_patches"]
    # Others have a keyword or a method of their own
    others = {"horizon", "horizon_distance", "sky_patches", "sunlit", "sunlit_total", "irradiation"}
    assert others <= set(runtime.words["quantity"])
    assert get_args(_settings.Quantity) == tuple(word for word in runtime.words["quantity"] if word not in others)
