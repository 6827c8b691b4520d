# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Roofs and walls as a GeoDataFrame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from farlod._modules import runtime as _runtime
from farlod._settings import Evaluation, caller_settings

if TYPE_CHECKING:
    import geopandas

Choice = Literal["roofs", "walls", "all"]

#: By the number that the package format gives each kind.
KINDS = np.array(_runtime.words["kind"], dtype=object)


def _columns(table: Mapping[str, Any], names: Mapping[str, str], further: list[str]) -> dict[str, Any]:
    columns: dict[str, Any] = {"building": np.array(table["building"], dtype=object), "surface": table["surface"]}
    columns["kind"] = KINDS[table["kind"]]
    columns.update({ours: table[theirs] for ours, theirs in names.items()})
    columns.update({name: table["further"][:, n] for n, name in enumerate(further)})
    if any(table.get("surface_id", ())):
        columns["surface_id"] = np.array([text or None for text in table["surface_id"]], dtype=object)
    return columns


def _of_points(table: Mapping[str, Any], evaluation: Evaluation, crs: Any) -> geopandas.GeoDataFrame:
    import geopandas

    names = {name: name for name in ("azimuth_deg", "tilt_deg", "area_m2", "svf")}
    if evaluation.bounds:
        names.update(svf_low="low", svf_high="high")
    columns = _columns(table, names, evaluation.further().columns())
    geometry = geopandas.points_from_xy(table["x_m"], table["y_m"], table["z_m"], crs=crs)
    return geopandas.GeoDataFrame(columns, geometry=geometry, crs=crs)


def _polygons(package: Any, table: Mapping[str, Any], crs: Any) -> geopandas.GeoSeries:
    """The polygons of the surfaces of a table, in its order. All pieces that cells have of a surface are one geometry."""
    import geopandas

    found = {(building, surface): wkb for building, surface, wkb in _runtime.surface_polygons(package, caller_settings(_runtime))}
    rows = zip(table["building"], table["surface"].tolist())
    return geopandas.GeoSeries.from_wkb([found.get(key) for key in rows], crs=crs)


def frame(
    package: Any,
    which: str,
    spacing: float,
    irradiation_threshold: float | None,
    points: bool,
    geometry: bool,
    evaluation: Evaluation,
    crs: Any,
) -> geopandas.GeoDataFrame:
    """What City.surfaces() returns, in the CRS of the city."""
    import geopandas

    found = _runtime.evaluate_surfaces(package, which, spacing, irradiation_threshold, points, evaluation.settings(), evaluation.caller())
    if points:
        result = _of_points(found["points"], evaluation, crs)
    else:
        means = found["means"]
        names = {name: name for name in means if name not in ("building", "surface", "surface_id", "kind", "further")}
        if evaluation.light is None:
            del names["irradiation_kwh"]
        if irradiation_threshold is None:
            del names["area_above_m2"]
        columns = _columns(means, names, evaluation.further().columns())
        shapes = _polygons(package, means, crs) if geometry else [None] * len(means["building"])
        result = geopandas.GeoDataFrame(columns, geometry=shapes, crs=crs)
    result.attrs["summary"] = found["summary"]
    return result
