# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""``dsm.farlod``: sky view factors of a surface model that is an array of xarray."""

from __future__ import annotations

import os
import tempfile
from typing import Any

import xarray

from farlod._city import City
from farlod._packing import pack
from farlod.errors import InvalidArgument

_EVALUATION = ("height", "above", "metric", "max_error", "bounds", "quantities", "engine", "azimuths", "rays", "directions")

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

    def pack(self, path: str | os.PathLike[str], terrain: Any = None, **settings: Any) -> City:
        """Makes a package of the surface model, and opens it.

        Parameters
        ----------
        path : str or path-like
            The folder to make.
        terrain : path or xarray.DataArray, optional
            Elevations of the ground. Without it, the surface is all ground.
        **settings
            As for :func:`farlod.pack`.

        Returns
        -------
        City
        """
        return pack(self._array, path, terrain=terrain, **settings)

    def svf(self, *, terrain: Any = None, height: float = 0.0, **settings: Any) -> xarray.DataArray | xarray.Dataset:
        """Sky view factors on the surface, pixel by pixel.

        Parameters
        ----------
        terrain : path or xarray.DataArray, optional
            Elevations of the ground.
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
        evaluation.setdefault("above", "surface")
        with tempfile.TemporaryDirectory(prefix="farlod-") as folder:
            with self.pack(os.path.join(folder, "surface.farlod"), terrain, **settings) as city:
                grid = city.svf_grid(like=self._array, height=height, **evaluation, **run)
        return grid if len(grid.data_vars) > 1 else next(iter(grid.data_vars.values()))
