# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Rasters as xarray has them, whole or block by block, and tables of horizons and patches."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from farlod import _arguments
from farlod._crs import crs_of_array
from farlod._modules import runtime as _runtime
from farlod._settings import Evaluation
from farlod._sky_patches import middle_of_patches
from farlod.errors import InvalidArgument, LimitReached

if TYPE_CHECKING:
    import pandas
    import xarray

#: Of the sky view factor itself, which is no further quantity.
LONG_NAMES = {
    "svf": "sky view factor",
    "svf_low": "certain lower bound of the sky view factor",
    "svf_high": "certain upper bound of the sky view factor",
    "svf_solid_low": "certain lower bound of the share of solid angle",
    "svf_solid_high": "certain upper bound of the share of solid angle",
    "svf_solid": "share of the solid angle of the sky",
}


def _require_crs_of_city(like: Any, crs: Any) -> None:
    if not hasattr(like, "coords") or not hasattr(like, "sizes"):
        raise InvalidArgument(f"like is a {type(like).__name__}: give a DataArray or Dataset on (y, x)")
    theirs = crs_of_array(like)
    if theirs is None:
        raise InvalidArgument("like has no CRS: import rioxarray, and set it with like.rio.write_crs()")
    if not theirs.equals(crs, ignore_axis_order=True):
        raise InvalidArgument(f"like has another CRS than the city ({crs.name}): reproject it first")


def _axis(like: Any, name: str) -> npt.NDArray[np.float64]:
    if name not in like.coords or like.coords[name].ndim != 1 or like.sizes[name] < 2:
        raise InvalidArgument(f"like has no coordinate {name} of two values or more: give a raster on (y, x)")
    return _arguments.floats(f"like.{name}", like.coords[name].values)


def _plan_like(like: Any, crs: Any) -> Any:
    _require_crs_of_city(like, crs)
    x, y = _axis(like, "x"), np.sort(_axis(like, "y"))[::-1]
    steps = np.concatenate([np.diff(x), -np.diff(y)])
    step = float(steps.mean())
    if step <= 0.0 or np.abs(steps - step).max() > 1e-3 * step:
        raise InvalidArgument("like has pixels that are not square, or no even coordinates: resample it first")
    return _runtime.RasterPlan((float(x[0]) - step / 2, float(y[0]) + step / 2), step, x.size, y.size)


def _require_of_city(box: _arguments.Bbox, city: Mapping[str, Any]) -> None:
    """Refuses a raster beside the city, all of which would be without data. Pixels near the grid have some."""
    near_m = 1000.0
    west, south, east, north = city["bounds_m"]
    if box[0] > east + near_m or box[1] > north + near_m or box[2] < west - near_m or box[3] < south - near_m:
        may_be_degrees = max(abs(box[0]), abs(box[2])) <= 360.0 and max(abs(box[1]), abs(box[3])) <= 90.0
        raise InvalidArgument(
            f"bbox is {_arguments.shown(box)}, where nothing of the city lies: it reaches from {west:.0f}, {south:.0f} to "
            f"{east:.0f}, {north:.0f} in {city['crs_name']}"
            + (". If bbox is in degrees, bring it to that CRS (city.crs)" if may_be_degrees else "")
        )


def plan(package: Any, step: Any, bbox: Any, like: Any, crs: Any) -> Any:
    """``RasterPlan`` of the library. Raises InvalidArgument."""
    if like is not None:
        if bbox is not None:
            raise InvalidArgument("like and bbox both say which pixels: give one of them")
        if step is not None:
            raise InvalidArgument("like and step both say which pixels: give one of them")
        return _plan_like(like, crs)
    box = None if bbox is None else _arguments.bbox("bbox", bbox)
    if box is not None:
        _require_of_city(box, package.description())
    own = _runtime.plan_of_surface_model(package, box) if step is None else None
    return own or _runtime.plan_raster(package, 1.0 if step is None else _step(step), box)


def _step(step: Any) -> float:
    finest_m, coarsest_m = 0.01, 10_000.0
    edge_m = _arguments.number("step", step)
    if not finest_m <= edge_m <= coarsest_m:
        raise InvalidArgument(f"step is {_arguments.shown(step)}: give {finest_m:g} to {coarsest_m:,.0f} metres")
    return edge_m


def _memory_of_machine() -> int:
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _no_room(pixels: Any, bytes_needed: int) -> LimitReached:
    return LimitReached(
        f"step is {pixels.step_m:g}: a raster of {pixels.columns * pixels.rows:,} pixels ({pixels.columns:,} x {pixels.rows:,}) takes "
        f"{bytes_needed / 2**30:,.1f} GiB of memory and more, which this machine does not have: give a larger step, a part (bbox), or "
        "chunks"
    )


def _names(evaluation: Evaluation) -> list[str]:
    quantity = "svf" if evaluation.metric == "cosine" else "svf_solid"
    bounds = [f"{quantity}_low", f"{quantity}_high"] if evaluation.bounds else []
    return [quantity, *bounds, *evaluation.further().columns()]


def _attributes(evaluation: Evaluation) -> dict[str, dict[str, str]]:
    further = {name: {"long_name": text, "units": unit} for name, unit, text in evaluation.further().descriptions()}
    return {name: {"long_name": text, "units": "1"} for name, text in LONG_NAMES.items()} | further


def _bands(raster: Mapping[str, Any]) -> list[Any]:
    bounds = [] if raster["low"] is None else [raster["low"], raster["high"]]
    return [raster["svf"], *bounds, *raster["further"]]


def _coordinates(pixels: Any, crs: Any) -> dict[str, Any]:
    import xarray

    variable: Any = xarray.Variable  # it has no types
    west, north = pixels.north_west_m
    step = pixels.step_m
    x = west + (np.arange(pixels.columns) + 0.5) * step
    y = north - (np.arange(pixels.rows) + 0.5) * step
    transform = f"{west!r} {step!r} 0.0 {north!r} 0.0 {-step!r}"
    return {
        "y": ("y", y, {"axis": "Y", "standard_name": "projection_y_coordinate", "units": "m"}),
        "x": ("x", x, {"axis": "X", "standard_name": "projection_x_coordinate", "units": "m"}),
        # Under both names, for readers of CF and of GDAL
        "spatial_ref": variable(
            (), 0, {**crs.to_cf(), "spatial_ref": crs.to_wkt(), "GeoTransform": transform}
        ),
    }


def _together(
    dataset: xarray.Dataset, pattern: str, name: str, dimension: str, coordinates: Any, long_names: tuple[str, str], last: bool
) -> xarray.Dataset:
    """The variables whose names are of a pattern as one with a dimension more, which comes first, or last."""
    import xarray

    names = [str(each) for each in dataset.data_vars if re.fullmatch(pattern, str(each))]
    if not names:
        return dataset
    variable: Any = xarray.Variable  # it has no types
    joined = variable.concat([dataset[each].variable for each in names], dimension)
    joined.attrs = {"long_name": long_names[0], "units": dataset[names[0]].attrs["units"]}
    values, units = coordinates([each.rsplit("_", 1)[1] for each in names])
    coordinate = (dimension, values, {"long_name": long_names[1], **units})
    ordered = joined.transpose(..., dimension) if last else joined
    return dataset.drop_vars(names).assign({name: ordered}).assign_coords({dimension: coordinate})


def _with_parts_of_periods(dataset: xarray.Dataset, *, last: bool = False) -> xarray.Dataset:
    """``irradiation_01`` … on a dimension ``month``, and ``shade_20260621T1000`` … on a dimension ``time``."""

    def months(words: list[str]) -> Any:
        return [int(word) for word in words], {"units": "1"}

    def times(words: list[str]) -> Any:
        return np.array([f"{w[:4]}-{w[4:6]}-{w[6:11]}:{w[11:]}" for w in words], "datetime64[ns]"), {}

    of_months = ("irradiation of a month", "month of the year")
    of_steps = ("shade of an interval", "beginning of the interval, on the clock of the period")
    by_month = _together(dataset, r"irradiation_\d\d", "irradiation_by_month", "month", months, of_months, last)
    return _together(by_month, r"shade_\d{8}T\d{4}", "shade_by_step", "time", times, of_steps, last)


def columns_of_points(table: npt.NDArray[np.float32], evaluation: Evaluation, index: Any) -> xarray.Dataset:
    """``table`` has a column for each further quantity."""
    import xarray

    attributes = _attributes(evaluation)
    names = evaluation.further().columns()
    variables = {name: ("point", table[:, n], attributes[name]) for n, name in enumerate(names)}
    return _with_parts_of_periods(xarray.Dataset(variables, {"point": _points(index, len(table))}), last=True)


def _dataset(
    bands: Mapping[str, Any],
    pixels: Any,
    of_bands: Mapping[str, Mapping[str, str]],
    crs: Any,
    like: Any,
    attributes: Mapping[str, Any],
) -> xarray.Dataset:
    import xarray

    variables = {name: (("y", "x"), band, dict(of_bands.get(name, {}))) for name, band in bands.items()}
    dataset = _with_parts_of_periods(xarray.Dataset(variables, _coordinates(pixels, crs), dict(attributes)))
    for name in dataset.data_vars:
        dataset[name].encoding.update(grid_mapping="spatial_ref", _FillValue=np.float32(np.nan))
    if like is None:
        return dataset
    if float(like.coords["y"][0]) < float(like.coords["y"][-1]):
        dataset = dataset.isel(y=slice(None, None, -1))
    # To the bit, so that xarray aligns the two
    return dataset.assign_coords(x=("x", like.coords["x"].values), y=("y", like.coords["y"].values))


def eager(package: Any, pixels: Any, evaluation: Evaluation, crs: Any, like: Any) -> xarray.Dataset:
    """The raster, computed now. The figures of the run are its attribute ``summary``, as JSON: files keep words and numbers."""
    bytes_needed = 4 * len(_names(evaluation)) * pixels.columns * pixels.rows
    if bytes_needed > _memory_of_machine():
        raise _no_room(pixels, bytes_needed)
    try:
        raster = _runtime.evaluate_raster(
            package, pixels, evaluation.placing(), evaluation.settings(), evaluation.caller()
        )
    except LimitReached:
        raise
    except MemoryError:
        raise _no_room(pixels, bytes_needed) from None
    bands = dict(zip(_names(evaluation), _bands(raster)))
    return _dataset(bands, pixels, _attributes(evaluation), crs, like, {"summary": json.dumps(raster["summary"])})


def _block(
    city: Any, frame: tuple[tuple[float, float], float, int, int], evaluation: Evaluation, mask: Any, block_info: Any = None
) -> npt.NDArray[np.float32]:
    """The bands of one block of a raster, (band, row, column)."""
    from dataclasses import replace

    from farlod._regions import region_of

    _, (row, row_end), (column, column_end) = block_info[None]["array-location"]
    here = replace(evaluation, region=region_of(mask, city.crs_wkt))
    raster = _runtime.evaluate_window(
        city._open_package(),
        _runtime.RasterPlan(*frame),
        (column, row, column_end - column, row_end - row),
        here.placing(),
        here.settings(),
        here.caller(),
    )
    return np.stack(_bands(raster))


def lazy(city: Any, pixels: Any, evaluation: Evaluation, mask: Any, chunks: Any, like: Any) -> xarray.Dataset:
    """The raster as arrays of dask, whose blocks are computed when they are asked for."""
    import dask.array

    array: Any = dask.array  # it has no types
    names = _names(evaluation)
    if evaluation.verify:
        raise InvalidArgument("blocks are not verified: leave verify out, or chunks")
    # What a block would refuse is refused now
    evaluation.placing(), evaluation.settings(), evaluation.caller()
    shape = (pixels.rows, pixels.columns)
    edge = 2048 if isinstance(chunks, str) and chunks == "auto" else chunks
    try:
        sizes = array.core.normalize_chunks(edge, shape, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise InvalidArgument(f"chunks is {_arguments.shown(chunks)}: give the edge of a block in pixels, as dask takes it") from error
    frame = (pixels.north_west_m, pixels.step_m, pixels.columns, pixels.rows)
    stack = array.map_blocks(
        _block,
        chunks=((len(names),), *sizes),
        dtype=np.float32,
        meta=np.empty((0, 0, 0), np.float32),
        city=city,
        frame=frame,
        evaluation=evaluation,
        mask=mask,
    )
    return _dataset({name: stack[n] for n, name in enumerate(names)}, pixels, _attributes(evaluation), city.crs, like, {})


def ground(package: Any, pixels: Any, caller: Any, crs: Any) -> xarray.DataArray:
    """Heights of the ground."""
    heights = _runtime.ground_heights(package, pixels, caller)
    array = _dataset({"ground": heights}, pixels, {}, crs, None, {})["ground"]
    array.attrs = {"long_name": "height of the ground above sea level", "units": "m"}
    return array


def _points(index: pandas.Index | None, count: int) -> Any:
    return np.arange(count) if index is None else index.to_numpy()


def horizons(table: npt.NDArray[np.float32], count: int, index: Any) -> xarray.DataArray | xarray.Dataset:
    """``table`` has a column for each azimuth, and then, where distances were asked for, another."""
    import xarray

    azimuth = ("azimuth", np.arange(count) * (360.0 / count), {"units": "degree", "long_name": "clockwise from true north"})
    coords = {"point": _points(index, len(table)), "azimuth": azimuth}
    dims = ("point", "azimuth")
    elevation = xarray.DataArray(table[:, :count], coords, dims, "horizon", {"units": "degree", "long_name": "elevation"})
    if table.shape[1] == count:
        return elevation
    distance = xarray.DataArray(table[:, count:], coords, dims, "distance", {"units": "m", "long_name": "level distance"})
    return xarray.Dataset({"horizon": elevation, "distance": distance})


def patches(table: npt.NDArray[np.float32], index: Any) -> xarray.DataArray:
    """``table`` has a column for each patch."""
    import xarray

    azimuth, elevation, weight = middle_of_patches(table.shape[1])
    coords = {
        "point": _points(index, len(table)),
        "patch": np.arange(1, table.shape[1] + 1),
        "azimuth": ("patch", azimuth, {"units": "degree", "long_name": "clockwise from true north"}),
        "elevation": ("patch", elevation, {"units": "degree"}),
        "view_factor": ("patch", weight, {"units": "1", "long_name": "view factor of the patch from a level surface"}),
    }
    return xarray.DataArray(table, coords, ("point", "patch"), "sky_patches", {"units": "1", "long_name": "share seen"})
