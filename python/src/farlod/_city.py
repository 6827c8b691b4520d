# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""An open package, and what can be asked of it."""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Unpack, get_args

from farlod import _arguments, _grids, _plots, _surfaces
from farlod._answers import PackageCheck
from farlod._cells import CellsOfCity
from farlod._hemispheres import HemispheresOfCity
from farlod._irradiation import IrradiationOfCity
from farlod._light import Light
from farlod._modules import runtime as _runtime
from farlod._points import PointsOfCity
from farlod._regions import region_of
from farlod._settings import Above, Evaluation, Metric, Options, Progress, Quantity, caller_settings
from farlod._view_factors import ViewFactorsOfCity
from farlod.errors import InvalidArgument, PackageUnusable

if TYPE_CHECKING:
    import geopandas
    import matplotlib.axes
    import xarray


class City(PointsOfCity, IrradiationOfCity, HemispheresOfCity, CellsOfCity, ViewFactorsOfCity):
    """A city in memory: an open package. Made by :func:`farlod.open` and :func:`farlod.pack`.

    Any number of threads may use one city. It can be pickled, and is opened again where it is unpickled. As a context manager
    it closes itself.

    Coordinates are those of the CRS of the package (:attr:`crs`): easting and northing in metres; heights are metres above
    sea level. Azimuths are degrees clockwise from true north. NaN is no data: inside a building, below the ground, or where
    there is no ground.

    Examples
    --------
    >>> city = farlod.open(village)
    >>> west, south, east, north = city.bounds
    >>> svf = city.svf([[(west + east) / 2, (south + north) / 2]])
    >>> svf.shape, svf.dtype
    ((1,), dtype('float32'))
    """

    def __reduce__(self) -> tuple[Any, tuple[str, int, Any]]:
        self._open_package()
        return _reopened, (self._path, _stamp_of(self._path), self._features_crs)

    def __dask_tokenize__(self) -> tuple[str, str, int]:
        return "farlod.City", self._path, _stamp_of(self._path)

    # Rasters and surfaces

    def svf_grid(
        self,
        step: float | None = None,
        bbox: Any = None,
        mask: Any = None,
        *,
        within: float | None = None,
        like: Any = None,
        chunks: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        metric: Metric = "cosine",
        max_error: float | None = None,
        bounds: bool = False,
        quantities: Iterable[Quantity] = (),
        light: Light | None = None,
        verify: int = 0,
        **options: Unpack[Options],
    ) -> xarray.Dataset:
        """A raster of sky view factors over the city, or a part of it.

        Parameters
        ----------
        step : float, optional
            Edge of a pixel in metres, 0.01 to 10,000. Pixels begin at multiples of it (default: of 1; or the pixels of the
            raster that the city is).
        bbox : (west, south, east, north), optional
            In the CRS of the city (default: ``city_bounds``; all cells are in ``bounds``). One beside the city is refused.
        mask : geopandas.GeoSeries or GeoDataFrame of polygons, or a polygon of shapely in the CRS of the city, optional
            Pixels whose centres lie outside of it have no data, and cost next to nothing.
        within : float, optional
            Pixels that are farther from every building than so many metres, in the plan, have no data either; those of
            pavements are within 3.
        like : xarray.DataArray or Dataset on (y, x), optional
            Takes the pixels of this raster, which is north-up, has square pixels, and the CRS of the city.
        chunks : int, tuple or "auto", optional
            Edge of blocks in pixels. The raster is then computed lazily, block by block, by dask; each block with one thread,
            unless ``threads`` says otherwise. Its values are those of a raster without chunks, to the bit.
        height, above, metric, max_error, bounds, **options : as for :meth:`svf`
        quantities : as for :meth:`evaluate`
        light : Light, optional
            Of a period: adds the variables of :meth:`irradiation`, that of months on (month, y, x). With it, ``"irradiance"``,
            ``"illuminance"`` and ``"shade"`` are quantities, too.
        verify : as for :meth:`evaluate`
            Not with chunks.

        Returns
        -------
        xarray.Dataset on (y, x)
            ``svf`` (``svf_solid`` with that metric), with ``bounds`` also ``svf_low`` and ``svf_high``, and a variable for each
            further quantity: float32, NaN where there is no data, and far beyond the cells of the grid.
            ``spatial_ref`` holds the CRS, where rioxarray and GDAL look for it; the attribute ``summary`` the figures of the run as JSON. y runs from north to south.

        Examples
        --------
        >>> grid = city.svf_grid(step=5.0)
        >>> grid.svf.dims, grid.svf.dtype
        (('y', 'x'), dtype('float32'))
        >>> lazy = city.svf_grid(step=5.0, chunks=16)
        >>> bool((lazy.svf.compute().fillna(-1) == grid.svf.fillna(-1)).all())
        True
        """
        package = self._open_package()
        plan = _grids.plan(package, step, bbox, like, self.crs)
        lazy = options.copy()
        if chunks is not None:
            lazy.setdefault("threads", 1)
        region = region_of(mask, self.crs_wkt)
        evaluation = Evaluation(
            metric,
            height,
            above,
            bounds,
            max_error,
            quantities,
            light=light,
            region=region if chunks is None else None,
            within=within,
            verify=verify,
            options=lazy,
        )
        if chunks is None:
            return _grids.eager(package, plan, evaluation, self.crs, like)
        return _grids.lazy(self, plan, evaluation, mask, chunks, like)

    def ground(self, step: float = 1.0, bbox: Any = None, **options: Any) -> xarray.DataArray:
        """Heights of the ground above sea level, in metres, on the raster of :meth:`svf_grid`.

        Examples
        --------
        >>> city.ground(step=10.0).dims
        ('y', 'x')
        """
        package = self._open_package()
        plan = _grids.plan(package, step, bbox, None, self.crs)
        return _grids.ground(package, plan, caller_settings(_runtime, **options), self.crs)

    def surfaces(
        self,
        which: _surfaces.Choice = "all",
        spacing: float = 2.0,
        *,
        points: bool = False,
        geometry: bool = True,
        crs: Any = None,
        metric: Metric = "cosine",
        max_error: float | None = None,
        bounds: bool = False,
        quantities: Iterable[Quantity] = (),
        light: Light | None = None,
        irradiation_threshold: float | None = None,
        mask: Any = None,
        verify: int = 0,
        **options: Unpack[Options],
    ) -> geopandas.GeoDataFrame:
        """Sky view factors of the roofs and walls of all buildings.

        Parameters
        ----------
        which : {"roofs", "walls", "all"}
        spacing : float, default 2.0
            Metres between receivers, 0.05 to 1,000: each triangle of area A has ⌈A/spacing²⌉ of them.
        points : bool, default False
            Whether the rows are the receivers, and not the surfaces.
        geometry : bool, default True
            Whether surfaces get their polygons; without, the geometry is None, and nothing is read for it. Receivers always have
            theirs.
        crs : anything that pyproj takes, optional
            CRS of the result. By default that of the GeoDataFrame that the city was packed from, else that of the city.
        metric, max_error, bounds, **options : as for :meth:`svf`
        quantities : as for :meth:`evaluate`
        light : Light, optional
            Of a period: adds irradiation in kWh/m², direct, diffuse, reflected, and of months (``irradiation_01`` …), and
            ``irradiation_kwh`` of each surface.
        irradiation_threshold : float, optional
            In kWh/m²: adds ``area_above_m2``, the area that gets at least so much.
        mask : as for :meth:`svf_grid`
        verify : as for :meth:`evaluate`
            The figures of the run are ``attrs["summary"]``.

        Returns
        -------
        geopandas.GeoDataFrame
            A row for each surface, with the columns of the tables of farlod-svf: ``geometry`` (MultiPolygon Z), ``building``,
            ``surface`` (its number in the building), ``kind``, ``azimuth_deg`` and ``tilt_deg`` of its outward normal,
            ``area_m2`` of what has an answer and ``covered_area_m2`` of what has none, ``receivers``, ``nodata`` (receivers
            without an answer), ``svf_mean`` (weighted by area), ``svf_min``, ``svf_max``, a column for each quantity, and
            ``surface_id``, what the city file calls the surface, where it has ids. With ``points`` a row for each receiver:
            Point Z, ``building``, ``surface``, ``kind``, ``azimuth_deg``, ``tilt_deg``, ``area_m2``, ``svf``, with ``bounds``
            also ``svf_low`` and ``svf_high``.

        Examples
        --------
        >>> walls = city.surfaces("walls", spacing=4.0)
        >>> bool((walls.svf_mean.dropna() <= 0.5 + 1e-3).all())  # the lower half of what a wall faces is ground
        True
        """
        package = self._open_package()
        if points is True and geometry is False:
            raise InvalidArgument("points always have a geometry: leave geometry out")
        evaluation = Evaluation(
            metric,
            bounds=bounds,
            max_error=max_error,
            quantities=quantities,
            light=light,
            region=region_of(mask, self.crs_wkt),
            verify=verify,
            options=options,
        )
        frame = _surfaces.frame(
            package,
            _arguments.word("which", which, get_args(_surfaces.Choice)),
            _arguments.number("spacing", spacing),
            None if irradiation_threshold is None else _arguments.number("irradiation_threshold", irradiation_threshold),
            _arguments.flag("points", points),
            _arguments.flag("geometry", geometry),
            evaluation,
            self.crs,
        )
        wanted = self._features_crs if crs is None else crs
        return frame if wanted is None or frame.crs == wanted else frame.to_crs(wanted)

    # Pictures and checks

    def plot(
        self,
        grid: xarray.Dataset | None = None,
        *,
        ax: matplotlib.axes.Axes | None = None,
        variable: str | None = None,
        outlines: bool = True,
        colorbar: bool = True,
        step: float | None = None,
        **imshow: Any,
    ) -> matplotlib.axes.Axes:
        """Draws a map: a raster, and the outlines of the buildings.

        Parameters
        ----------
        grid : xarray.Dataset, optional
            From :meth:`svf_grid`. Without it, one of at most 1,000 pixels along its edge is computed, or with ``step``.
        ax : matplotlib.axes.Axes, optional
            Where to draw; new axes without it.
        variable : str, optional
            Which variable of the grid; the first by default.
        outlines : bool, default True
            Whether to draw the outlines of roofs.
        colorbar : bool, default True
            Whether to draw what the colours mean.
        **imshow
            Handed to :meth:`matplotlib.axes.Axes.imshow`.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> axes = city.plot(step=5.0)
        >>> axes.get_xlabel()
        'easting (m)'
        """
        package = self._open_package()
        if grid is not None and step is not None:
            raise InvalidArgument("grid and step both say which pixels: give one of them")
        if grid is None:
            west, south, east, north = self.city_bounds
            grid = self.svf_grid(step if step is not None else max(1.0, math.ceil(max(east - west, north - south) / 1000.0)))
        lines = None
        if outlines:
            box = _plots.extent(grid)
            lines = _runtime.building_outlines(package, (box[0], box[2], box[1], box[3]), caller_settings(_runtime))
        return _plots.draw_map(grid, variable, lines, ax, colorbar, imshow)

    def check(self, *, threads: int = 0, memory_limit: int | None = None, progress: Progress = None) -> PackageCheck:
        """Reads the whole package: each file is compared with its checksum, each tile is checked, each far map is decoded.

        Examples
        --------
        >>> city.check().damage
        []
        """
        found = _runtime.check_package(self._open_package(), caller_settings(_runtime, threads, memory_limit, progress))
        return PackageCheck(**found)


def _stamp_of(path: str) -> int:
    """Changes when another package is made in the folder."""
    try:
        return os.stat(os.path.join(path, "manifest.json")).st_mtime_ns
    except OSError as error:
        raise PackageUnusable(f"{path} is not a package any more: {error}") from error


@functools.lru_cache(maxsize=4)
def _opened_before(path: str, stamp: int) -> Any:
    return _runtime.Package(path)


def _reopened(path: str, stamp: int, features_crs: Any) -> City:
    """A pickled city. A process that gets the same city again and again, as a worker of dask, opens it once."""
    if _stamp_of(path) != stamp:
        raise PackageUnusable(f"{path} has been packed again since the city was pickled: open it, and pickle it, again")
    city = City.__new__(City)
    city._path = path
    city._package = _opened_before(path, stamp)
    city._description = city._package.description()
    city._report = None
    city._features_crs = features_crs
    return city


def open(path: str | os.PathLike[str]) -> City:
    """Opens a package, as farlod.pack() and the program farlod-pack make them.

    Parameters
    ----------
    path : str or path-like
        The folder of the package.

    Returns
    -------
    City

    Raises
    ------
    PackageUnusable
        There is no package, or one of another version of the format.
    PackageDamaged
        It contradicts itself. The message names the file and the first rule that it breaks.

    Examples
    --------
    >>> with farlod.open(village) as city:
    ...     city.info["buildings"]
    32
    """
    return City(path)
