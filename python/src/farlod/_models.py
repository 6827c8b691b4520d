# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""City models that Python holds, as files that the library reads."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from farlod import _arguments
from farlod._crs import crs_of_array
from farlod._receivers import is_geo
from farlod.errors import InvalidArgument


@dataclass(frozen=True)
class SavedModel:
    """A model that is a file now."""

    path: str


def is_path(model: Any) -> bool:
    """Whether something is a path."""
    return isinstance(model, (str, bytes, os.PathLike))


def _save_features(frame: Any, path: str, crs: str) -> None:
    import geopandas

    geometry = frame.geometry
    if len(geometry) == 0:
        raise InvalidArgument("the GeoDataFrame has no rows: give footprints")
    if geometry.crs is None and not crs:
        raise InvalidArgument("the GeoDataFrame has no CRS: set it with set_crs(), or give crs=")
    # What a file of features can hold: numbers and words
    columns = {} if frame is geometry else {
        name: column if column.dtype.kind in "biuf" else column.where(column.isna(), column.astype(str))
        for name, column in frame.drop(columns=geometry.name).items()
    }
    geopandas.GeoDataFrame(columns, geometry=geometry.values, index=frame.index, crs=geometry.crs).to_file(path, driver="GPKG")


def _save_mesh(vertices: Any, faces: Any, path: str) -> None:
    points = _arguments.floats("vertices", vertices)
    corners = np.asarray(faces)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise InvalidArgument(f"vertices has the shape {points.shape}: give (n, 3) finite numbers in metres")
    if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu" or corners.size == 0:
        raise InvalidArgument(f"faces has the shape {corners.shape} and type {corners.dtype}: give (m, 3) numbers of vertices")
    if corners.min() < 0 or corners.max() >= len(points):
        raise InvalidArgument(f"faces names vertices from {corners.min()} to {corners.max()}, and there are {len(points)}")
    with open(path, "wb") as file:
        # 17 digits are a 64-bit float to the bit
        np.savetxt(file, points, fmt="v %.17g %.17g %.17g")
        file.write(b"o mesh\n")
        np.savetxt(file, corners + 1, fmt="f %d %d %d")


def _save_raster(array: Any, path: str, crs: str) -> None:
    import rasterio
    from rasterio.transform import from_origin

    if set(array.dims) != {"y", "x"} or min(array.sizes.values()) < 2:
        raise InvalidArgument(f"the DataArray has the dimensions {array.dims}: give heights on (y, x)")
    its_crs = crs_of_array(array)
    if its_crs is None and not crs:
        raise InvalidArgument("the DataArray has no CRS: import rioxarray, and set it with .rio.write_crs(), or give crs=")
    raster = array.transpose("y", "x").sortby("y", ascending=False).sortby("x")
    x, y = raster.x.values.astype(np.float64), raster.y.values.astype(np.float64)
    step_x, step_y = float(np.diff(x).mean()), float(-np.diff(y).mean())
    if np.abs(np.diff(x) - step_x).max() > 1e-3 * step_x or np.abs(np.diff(y) + step_y).max() > 1e-3 * step_y:
        raise InvalidArgument("the coordinates of the DataArray are not even: resample it first")
    profile = {
        "driver": "GTiff",
        "dtype": "float32",
        "count": 1,
        "width": x.size,
        "height": y.size,
        "crs": crs if its_crs is None else its_crs.to_wkt(),
        "transform": from_origin(x[0] - step_x / 2, y[0] + step_y / 2, step_x, step_y),
        "nodata": np.nan,
        "tiled": True,
    }
    with rasterio.open(path, "w", **profile) as file:
        file.write(_arguments.floats("the DataArray", raster.values).astype(np.float32), 1)


def saved_model(model: Any, folder: str, name: str, crs: str = "") -> SavedModel:
    """The file that a model is, or a new one of this name in ``folder``. Raises InvalidArgument."""
    if is_path(model):
        return SavedModel(_arguments.path("city", model))
    if is_geo(model):
        path = os.path.join(folder, f"{name}.gpkg")
        _save_features(model, path, crs)
    elif hasattr(model, "dims") and hasattr(model, "coords"):
        path = os.path.join(folder, f"{name}.tif")
        _save_raster(model, path, crs)
    elif hasattr(model, "vertices") and hasattr(model, "faces"):
        path = os.path.join(folder, f"{name}.obj")
        _save_mesh(model.vertices, model.faces, path)
    elif isinstance(model, tuple) and len(model) == 2:
        path = os.path.join(folder, f"{name}.obj")
        vertices, faces = model
        _save_mesh(vertices, faces, path)
    else:
        raise InvalidArgument(
            f"city is a {type(model).__name__}: give a path, a GeoDataFrame of footprints, a mesh (vertices, faces), or a "
            "DataArray of surface heights"
        )
    return SavedModel(path)
