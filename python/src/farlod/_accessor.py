# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""``dsm.farlod``: sky view factors of a surface model that is an array of xarray."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray

from farlod._city import City
from farlod._crs import crs_of_array
from farlod._packing import pack
from farlod.errors import InvalidArgument

_EVALUATION = ("height", "above", "metric", "max_error", "bounds", "quantities", "engine", "azimuths", "rays", "directions")



def _with_crs(array: xarray.DataArray, crs: Any) -> xarray.DataArray:
    """An array that says its CRS: its own, or this one where it says none."""
    import pyproj

    if crs is None or crs_of_array(array) is not None:
        return array
    return array.assign_coords(spatial_ref=((), 0, pyproj.CRS.from_user_input(crs).to_cf()))


def _by_points(city: City, array: xarray.DataArray, options: Mapping[str, Any]) -> xarray.Dataset:
    """The pixels as points of a city whose CRS is another: pixels in degrees are no squares there."""
    import geopandas

    x, y = np.meshgrid(array.x.values, array.y.values)
    places = geopandas.GeoSeries(geopandas.points_from_xy(x.ravel(), y.ravel()), crs=crs_of_array(array))
    answers = city.evaluate(places, **options)
    quantity = "svf_solid" if options.get("metric") == "solid" else "svf"
    columns = {quantity: answers.svf, f"{quantity}_low": answers.low, f"{quantity}_high": answers.high, **answers.quantities}
    bands = {name: (("y", "x"), column.reshape(x.shape)) for name, column in columns.items() if column is not None}
    coords = {name: array.coords[name] for name in ("y", "x", "spatial_ref") if name in array.coords}
    return xarray.Dataset(bands, coords)


_register: Any = xarray.register_dataarray_accessor  # it has no types


@_register("farlod")
class FarlodAccessor:
    """Accessor ``.farlod`` of an :class:`xarray.DataArray` of surface heights in metres on (y, x), with a CRS.

    Examples
    --------
    >>> dsm = surface_model  # a street between two blocks, with .rio.crs
    >>> dsm.farlod.svf().dims
    ('y', 'x')
    """

    def __init__(self, array: xarray.DataArray) -> None:
        self._array = array

    def pack(self, path: str | os.PathLike[str], **settings: Any) -> City:
        """Makes a package of the surface model, and opens it. All of the surface is ground.

        Parameters
        ----------
        path : str or path-like
            The folder to make.
        **settings
            As for :func:`farlod.pack`.

        Returns
        -------
        City
        """
        return pack(self._array, path, **settings)

    def svf(self, *, height: float = 0.0, **settings: Any) -> xarray.DataArray | xarray.Dataset:
        """Sky view factors on the surface, pixel by pixel.

        Parameters
        ----------
        height : float, default 0.0
            Metres above the surface.
        **settings
            As for :func:`farlod.pack` and :meth:`farlod.City.svf_grid`.

        Returns
        -------
        xarray.DataArray (y, x)
            On the same coordinates; a Dataset with ``bounds=True`` or ``quantities``.
        """
        if "like" in settings or "step" in settings or "chunks" in settings:
            raise InvalidArgument("svf() takes the pixels of the array: use .farlod.pack() and svf_grid() for others")
        evaluation = {name: settings.pop(name) for name in _EVALUATION if name in settings}
        run = {name: settings[name] for name in ("threads", "memory_limit", "progress") if name in settings}
        with tempfile.TemporaryDirectory(prefix="farlod-") as folder:
            with self.pack(os.path.join(folder, "surface.farlod"), **settings) as city:
                options: dict[str, Any] = {"height": height, **evaluation, **run}
                array = _with_crs(self._array, settings.get("crs"))
                is_in_city_crs = crs_of_array(array).equals(city.crs, ignore_axis_order=True)
                grid = city.svf_grid(like=array, **options) if is_in_city_crs else _by_points(city, array, options)
        return grid if len(grid.data_vars) > 1 else next(iter(grid.data_vars.values()))
