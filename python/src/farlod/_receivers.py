# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Points and normals of callers, coordinate by coordinate, in the CRS of a city."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod.errors import InvalidArgument

if TYPE_CHECKING:
    import pandas

Floats = npt.NDArray[np.float64]

#: Nobody asks a city for places that are farther away.
_FARTHEST_M = 100_000.0


@dataclass(frozen=True)
class Receivers:
    """Where receivers stand and look: arrays of one length, in one piece."""

    x: Floats
    y: Floats
    z: Floats | None
    azimuth: Floats | None
    tilt: Floats | None
    index: pandas.Index | None = None  #: of the GeoSeries that the points came from
    first_given: tuple[float, float] | None = None  #: of the GeoSeries, in its own CRS

    def __len__(self) -> int:
        return int(self.x.size)


def is_geo(points: Any) -> bool:
    """Whether something is a GeoSeries or a GeoDataFrame, without importing geopandas for it."""
    return hasattr(points, "to_crs") and hasattr(points, "geometry")


def _are_near(x: Any, y: Any, bounds: _arguments.Bbox) -> Any:
    west, south, east, north = bounds
    return np.hypot(x - (west + east) / 2.0, y - (south + north) / 2.0) <= _FARTHEST_M


def _require_points(geometries: Any) -> None:
    is_wrong = (geometries.isna() | geometries.is_empty | (geometries.geom_type != "Point")).to_numpy()
    if not is_wrong.any():
        return
    first = int(is_wrong.argmax())
    shape = geometries.iloc[first]
    found = "no geometry" if shape is None else "an empty one" if shape.is_empty else f"a {shape.geom_type}"
    raise InvalidArgument(
        f"points has geometries that are no points, or empty: the first of {is_wrong.sum()} is {found} at index "
        f"{geometries.index[first]!r}. Leave them out, or take their centroid; City.surfaces() answers for buildings"
    )


def _refuse_exchanged(given: Any, x: Floats, y: Floats, crs_wkt: str, bounds: _arguments.Bbox) -> None:
    """Refuses degrees of which none lies near the city, where the first does with latitude and longitude exchanged."""
    if len(given) == 0 or not given.crs.is_geographic or _are_near(x, y, bounds).any():
        return
    import pyproj

    first = given.iloc[0]
    exchanged = pyproj.Transformer.from_crs(given.crs, crs_wkt, always_xy=True).transform(first.y, first.x)
    if _are_near(*exchanged, bounds):
        raise InvalidArgument(
            f"points begin with ({first.x:.10g}, {first.y:.10g}) in {given.crs.name}, more than 100 km from the city: give the "
            "longitude before the latitude"
        )


def _columns_of_geometries(points: Any, crs_wkt: str, bounds: _arguments.Bbox) -> tuple[Floats, Floats, Floats | None]:
    geometries = points.geometry
    if geometries.crs is None:
        raise InvalidArgument("points have no CRS: set it with set_crs(), so that they can be brought into the city's")
    _require_points(geometries)
    here = geometries.to_crs(crs_wkt)
    x, y = here.x.to_numpy(np.float64), here.y.to_numpy(np.float64)
    _refuse_exchanged(geometries, x, y, crs_wkt, bounds)
    if not (np.isfinite(x) & np.isfinite(y)).all():
        raise InvalidArgument("points lie where the CRS of the city does not reach: check their CRS")
    has_z = here.has_z.to_numpy()
    if not has_z.any():
        return x, y, None
    z = np.full(len(here), np.nan)
    z[has_z] = here[has_z].z.to_numpy(np.float64)
    return x, y, z


def _columns_of_array(points: Any) -> tuple[Floats, Floats, Floats | None]:
    array = _arguments.floats("points", points)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise InvalidArgument(
            f"points has the shape {array.shape}: give (n, 2), easting and northing, or (n, 3), with the height above sea level;"
            " one point is [[x, y]]"
        )
    columns = [np.ascontiguousarray(array[:, axis]) for axis in range(array.shape[1])]
    return columns[0], columns[1], columns[2] if len(columns) == 3 else None


def _facing(normals: Any, count: int, convergence_deg: float) -> tuple[Floats, Floats]:
    array = _arguments.floats("normals", normals)
    if array.ndim != 2 or array.shape[0] != count or array.shape[1] not in (2, 3):
        raise InvalidArgument(
            f"normals has the shape {array.shape}: give ({count}, 3), vectors along the axes of the city's CRS, or ({count}, 2), "
            "azimuths clockwise from true north and tilts, in degrees"
        )
    if array.shape[1] == 2:
        return np.ascontiguousarray(array[:, 0]), np.ascontiguousarray(array[:, 1])
    east, north, up = array[:, 0], array[:, 1], array[:, 2]
    level = np.hypot(east, north)
    if not (np.isfinite(array).all() and (np.hypot(level, up) > 0.0).all()):
        raise InvalidArgument("normals has vectors that are zero or not finite: give a direction for each point")
    azimuth = np.mod(np.degrees(np.arctan2(east, north)) + convergence_deg, 360.0)
    return azimuth, np.degrees(np.arctan2(level, up))


def _advice(x: Floats, y: Floats, has_crs: bool) -> str:
    if has_crs:
        return "check the CRS of the GeoSeries"
    are_degrees = bool((np.abs(x) <= 360.0).all() and (np.abs(y) <= 180.0).all())
    return (
        'give degrees as a GeoSeries with crs="EPSG:4326"'
        if are_degrees
        else "give easting and northing in this CRS, or a GeoSeries with its CRS"
    )


def require_near(x: Floats, y: Floats, bounds: _arguments.Bbox, crs: str, *, given: tuple[float, float] | None = None) -> None:
    """Refuses points that all lie beyond the city, where none has an answer, and warns of some that do."""
    farthest_on_maps_m, reach_m = 1e8, _runtime.answered_beyond_grid_m
    west, south, east, north = bounds
    # What lies nowhere on Earth is told by the library, with its index
    if x.size == 0 or not (np.abs(x) + np.abs(y) < farthest_on_maps_m).all():
        return
    first_x, first_y = given or (x[0], y[0])
    begin = f"points begin with ({first_x:.10g}, {first_y:.10g}), and all lie more than "
    if not _are_near(x, y, bounds).any():
        raise InvalidArgument(
            f"{begin}100 km from the city, which is at ({(west + east) / 2.0:.0f}, {(south + north) / 2.0:.0f}) in {crs}: "
            + _advice(x, y, given is not None)
        )
    beyond = (x < west - reach_m) | (x > east + reach_m) | (y < south - reach_m) | (y > north + reach_m)
    if beyond.all():
        raise InvalidArgument(
            f"{begin}{reach_m:g} m beyond the grid of the city, where no point has an answer; it lies from {west:.0f}, {south:.0f} "
            f"to {east:.0f}, {north:.0f} in {crs}: check the coordinates"
        )
    if beyond.any():
        first = int(beyond.argmax())
        warnings.warn(
            f"{beyond.sum()} of {x.size} points lie more than {reach_m:g} m beyond the grid of the city and have no answer: NaN. The "
            f"first is point {first} (counted from 0) at ({x[first]:.10g}, {y[first]:.10g})",
            stacklevel=4,
        )


def receivers_of(points: Any, normals: Any, crs_wkt: str, convergence_deg: float, bounds: _arguments.Bbox) -> Receivers:
    """``points`` and ``normals`` as City.svf() describes them. Raises InvalidArgument."""
    geo = is_geo(points)
    x, y, z = _columns_of_geometries(points, crs_wkt, bounds) if geo else _columns_of_array(points)
    azimuth, tilt = (None, None) if normals is None else _facing(normals, int(x.size), convergence_deg)
    first = (points.geometry.iloc[0].x, points.geometry.iloc[0].y) if geo and len(points) > 0 else None
    return Receivers(x, y, z, azimuth, tilt, points.index if geo else None, first)
