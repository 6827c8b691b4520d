# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of the map that a run is about, from the polygons of a caller."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from farlod._modules import runtime as _runtime
from farlod._receivers import is_geo
from farlod.errors import InvalidArgument


def _polygons_of(geometry: Any) -> Iterator[Any]:
    kind = getattr(geometry, "geom_type", None)
    if kind is not None and geometry.is_empty:
        return
    if kind == "Polygon":
        yield geometry
    elif kind in ("MultiPolygon", "GeometryCollection"):
        for part in geometry.geoms:
            yield from _polygons_of(part)
    elif geometry is not None:
        raise InvalidArgument(f"mask has a {kind or type(geometry).__name__}: give polygons")


def region_of(mask: Any, crs_wkt: str) -> Any:
    """``Region`` of the library, from a GeoSeries or GeoDataFrame of any CRS, or a polygon of shapely in the city's. Raises
    InvalidArgument."""
    if mask is None:
        return None
    if is_geo(mask):
        if mask.geometry.crs is None:
            raise InvalidArgument("mask has no CRS: set it with set_crs(), so that it can be brought into the city's")
        geometries = list(mask.geometry.to_crs(crs_wkt))
    else:
        geometries = [mask]
    rings = []
    for geometry in geometries:
        for polygon in _polygons_of(geometry):
            for ring in (polygon.exterior, *polygon.interiors):
                rings.append([(x, y) for x, y, *_ in ring.coords])
    if not rings:
        raise InvalidArgument("mask has no polygon: leave it out to evaluate everything")
    return _runtime.Region(rings)
