# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of the map that a run is about, from the polygons of a caller."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from farlod._modules import runtime as _runtime
from farlod._receivers import is_geo
from farlod.errors import InvalidArgument


def _polygons_of(geometry: Any, name: str) -> Iterator[Any]:
    kind = getattr(geometry, "geom_type", None)
    if kind is not None and geometry.is_empty:
        return
    if kind == "Polygon":
        yield geometry
    elif kind in ("MultiPolygon", "GeometryCollection"):
        for part in geometry.geoms:
            yield from _polygons_of(part, name)
    elif geometry is not None:
        raise InvalidArgument(f"{name} has a {kind or type(geometry).__name__}: give polygons")


def _rings_of(geometry: Any, name: str) -> list[list[tuple[float, float]]]:
    polygons = _polygons_of(geometry, name)
    return [[(x, y) for x, y, *_ in ring.coords] for polygon in polygons for ring in (polygon.exterior, *polygon.interiors)]


def _in_city_crs(shapes: Any, crs_wkt: str, name: str) -> list[Any]:
    if shapes.geometry.crs is None:
        raise InvalidArgument(f"{name} has no CRS: set it with set_crs(), so that it can be brought into the city's")
    return list(shapes.geometry.to_crs(crs_wkt))


def region_of(mask: Any, crs_wkt: str) -> Any:
    """``Region`` of the library, from a GeoSeries or GeoDataFrame of any CRS, or a polygon of shapely in the city's. Raises
    InvalidArgument."""
    if mask is None:
        return None
    geometries = _in_city_crs(mask, crs_wkt, "mask") if is_geo(mask) else [mask]
    rings = [ring for geometry in geometries for ring in _rings_of(geometry, "mask")]
    if not rings:
        raise InvalidArgument("mask has no polygon: leave it out to evaluate everything")
    return _runtime.Region(rings)


def zones_of(zones: Any, crs_wkt: str) -> list[list[list[tuple[float, float]]]]:
    """The rings of each row of a GeoSeries or GeoDataFrame, in the city's CRS. Raises InvalidArgument."""
    if not is_geo(zones):
        raise InvalidArgument(f"zones is a {type(zones).__name__}: give a GeoDataFrame or GeoSeries of polygons")
    return [_rings_of(geometry, "zones") for geometry in _in_city_crs(zones, crs_wkt, "zones")]
