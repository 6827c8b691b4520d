# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""An open package, and what can be asked of it."""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union, Unpack, get_args, overload

import numpy as np
import numpy.typing as npt

from farlod import _arguments, _fisheye, _grids, _plots, _surfaces
from farlod._modules import runtime as _runtime
from farlod._receivers import Receivers, receivers_of
from farlod._regions import region_of
from farlod._settings import Above, Evaluation, Light, Metric, Options, Progress, Quantity, SkyModel, SkyPatches, caller_settings
from farlod.errors import InvalidArgument, PackageUnusable

if TYPE_CHECKING:
    import geopandas
    import matplotlib.axes
    import pandas
    import xarray

Floats = npt.NDArray[np.float32]
Values = Union[Floats, "pandas.Series[float]"]


class SvfInterval(NamedTuple):
    """Sky view factors with certain bounds: three arrays of one shape, ``low <= svf <= high``. NaN where there is no data.

    The bounds enclose what the true far city gives with the same azimuths or rays. The sky between these is not in them:
    ``max_error`` limits that.
    """

    svf: Values
    low: Values
    high: Values


@dataclass(frozen=True)
class PointAnswers:
    """What :meth:`City.evaluate` found at n points.

    Attributes
    ----------
    svf : numpy.ndarray of float32, (n,)
        0 to 1; NaN inside a building, below the ground, or where there is no ground.
    low, high : numpy.ndarray of float32, (n,), or None
        Certain bounds, with ``bounds=True``.
    height : numpy.ndarray of float64, (n,)
        Where the receivers stand, in metres above sea level.
    quantities : mapping of str to numpy.ndarray of float32, (n,)
        A column for each further quantity, under its name (``svfN``, ``hidden_near``, ``horizon_90``, ...).
    summary : mapping
        The figures of the run, as farlod-svf ``--summary`` names them.
    """

    svf: Floats
    low: Floats | None
    high: Floats | None
    height: npt.NDArray[np.float64]
    quantities: Mapping[str, Floats]
    summary: Mapping[str, Any]


@dataclass(frozen=True)
class Hemisphere:
    """What a point sees when it looks up: :meth:`City.look_up`.

    Attributes
    ----------
    svf : float
        Its sky view factor.
    height : float
        Where it stands, in metres above sea level.
    parts : numpy.ndarray of uint8, (1440, 360)
        0: sky, 1: geometry of the neighborhood, 2: the far city alone, 3: the crown of a tree. By azimuth, in quarters of a degree clockwise from true
        north, and by elevation, from the horizontal upwards.
    horizon : numpy.ndarray of float32, (n,)
        The elevation in degrees above which all is sky, at azimuths in equal steps clockwise from true north.
    """

    svf: float
    height: float
    parts: npt.NDArray[np.uint8]
    horizon: Floats


@dataclass(frozen=True)
class PackageCheck:
    """What came of reading a whole package: :meth:`City.check`. ``damage`` has a sentence for each thing that is wrong."""

    files: int
    bytes: int
    cells: int
    far_maps: int
    damage: list[str]


class City:
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

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = os.path.abspath(_arguments.path("path", path))
        self._package: Any = _runtime.Package(self._path)
        self._description: Mapping[str, Any] = self._package.description()
        self._report: Any = None
        self._features_crs: Any = None  # of the GeoDataFrame that the city was packed from

    # What it is

    @property
    def path(self) -> str:
        """The folder of the package."""
        return self._path

    @property
    def report(self) -> Any:
        """The :class:`farlod.Report` of :func:`farlod.pack`, or None."""
        return self._report

    @property
    def info(self) -> Mapping[str, Any]:
        """What the package says of itself: its CRS, grid, far maps, inputs, counts.

        Examples
        --------
        >>> city.info["buildings"], city.info["neighborhood"]
        (32, 3)
        """
        return dict(self._description)

    @property
    def crs_wkt(self) -> str:
        """The CRS of all coordinates, as WKT. It is projected, and in metres."""
        return str(self._description["crs_wkt"])

    @property
    def crs(self) -> Any:
        """The same as a :class:`pyproj.CRS`.

        Examples
        --------
        >>> city.crs.to_epsg()
        32632
        """
        import pyproj

        epsg = self._description["epsg"]
        return pyproj.CRS.from_epsg(epsg) if epsg else pyproj.CRS.from_wkt(self.crs_wkt)

    @property
    def bounds(self) -> _arguments.Bbox:
        """West, south, east and north of the grid of cells, in metres of the CRS."""
        west, south, east, north = self._description["bounds_m"]
        return west, south, east, north

    @property
    def closed(self) -> bool:
        """Whether the city was closed: all functions then raise InvalidArgument."""
        return self._package is None

    def close(self) -> None:
        """Forgets the package. Runs of other threads that are under way end as if nothing had happened."""
        self._package = None

    def __enter__(self) -> City:
        self._open_package()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        d = self._description
        state = "closed" if self.closed else f"{d['columns']} x {d['rows']} cells of {d['cell_edge_m']:g} m"
        return f"<farlod.City {os.path.basename(self._path)!r}: {d['buildings']:,} buildings, {d['crs_name']}, {state}>"

    def __reduce__(self) -> tuple[Any, tuple[str, int, Any]]:
        self._open_package()
        return _reopened, (self._path, _stamp_of(self._path), self._features_crs)

    def __dask_tokenize__(self) -> tuple[str, str, int]:
        return "farlod.City", self._path, _stamp_of(self._path)

    def _open_package(self) -> Any:
        if self._package is None:
            raise InvalidArgument(f"the city {self._path} is closed: open it again with farlod.open()")
        return self._package

    def _receivers(self, points: Any, normals: Any) -> Receivers:
        self._open_package()
        return receivers_of(points, normals, self.crs_wkt, float(self._description["convergence_deg"]))

    def _answers(self, receivers: Receivers, evaluation: Evaluation) -> Mapping[str, Any]:
        columns = _runtime.PointColumns(receivers.x, receivers.y, receivers.z, receivers.azimuth, receivers.tilt)
        answers: Mapping[str, Any] = _runtime.evaluate_points(
            self._open_package(), columns, evaluation.placing(), evaluation.settings(), evaluation.caller()
        )
        return answers

    # Points

    @overload
    def svf(
        self,
        points: Any,
        *,
        normals: Any = ...,
        height: float = ...,
        above: Above = ...,
        metric: Metric = ...,
        max_error: float | None = ...,
        bounds: Literal[False] = ...,
        **options: Unpack[Options],
    ) -> Values: ...

    @overload
    def svf(
        self,
        points: Any,
        *,
        normals: Any = ...,
        height: float = ...,
        above: Above = ...,
        metric: Metric = ...,
        max_error: float | None = ...,
        bounds: Literal[True],
        **options: Unpack[Options],
    ) -> SvfInterval: ...

    def svf(
        self,
        points: Any,
        *,
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        metric: Metric = "cosine",
        max_error: float | None = None,
        bounds: bool = False,
        **options: Unpack[Options],
    ) -> Values | SvfInterval:
        """Sky view factors of points.

        Parameters
        ----------
        points : array_like of float, (n, 2) or (n, 3); geopandas.GeoSeries or GeoDataFrame of points
            Easting and northing in metres of the CRS of the city; the third column is the height above sea level, NaN where
            ``height`` and ``above`` place the point. A GeoSeries is brought from its CRS into the city's, and the answer is a
            pandas.Series with its index.
        normals : array_like of float, (n, 3) or (n, 2), optional
            Where the points look: vectors along the axes of the CRS (east, north, up), of any length; or azimuths (clockwise
            from true north) and tilts (0 looks up, 90 level, 180 down), in degrees. Straight up without it.
        height : float, default 1.5
            Metres above ``above``, for points without a height of their own.
        above : {"ground", "surface", "sea"}
            What ``height`` counts from: the ground; the ground or the roof, whichever is on top; the zero of heights.
        metric : {"cosine", "solid"}
            How directions are weighted: by the cosine to the normal (the view factor), or all alike (the share of solid angle).
        max_error : float, optional
            Largest error allowed, 0.0001 to 1, for certain: the whole city decides what is left open.
        bounds : bool, default False
            Whether to compute bounds of each value, too, between which the true one of the packed city lies.
        **options
            See :class:`farlod.Options`.

        Returns
        -------
        numpy.ndarray of float32, (n,); with ``bounds``, a :class:`SvfInterval` of three
            0 to 1, NaN where there is no data.

        Raises
        ------
        InvalidArgument
            A wrong shape, value or CRS, or the city is closed; InvalidPoint, with its ``index``, for a point that lies nowhere.
        PackageDamaged, LimitReached, Cancelled
            See :mod:`farlod.errors`. Ctrl-C raises KeyboardInterrupt.

        Examples
        --------
        >>> city.svf([[x, y]]).round(2)
        array([0.94], dtype=float32)
        >>> city.svf([[x, y, 300.0]]).round(2)  # above all roofs
        array([1.], dtype=float32)
        >>> svf, low, high = city.svf([[x, y]], bounds=True)
        >>> bool(low[0] <= svf[0] <= high[0])
        True
        """
        receivers = self._receivers(points, normals)
        evaluation = Evaluation(metric, height, above, bounds, max_error, options=options)
        answers = self._answers(receivers, evaluation)
        if not bounds:
            return _labelled(answers["svf"], receivers)
        return SvfInterval(*(_labelled(answers[name], receivers) for name in ("svf", "low", "high")))

    def evaluate(
        self,
        points: Any,
        *,
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        metric: Metric = "cosine",
        max_error: float | None = None,
        bounds: bool = False,
        quantities: Iterable[Quantity] = (),
        verify: int = 0,
        **options: Unpack[Options],
    ) -> PointAnswers:
        """Sky view factors of points, further quantities, and the figures of the run: arrays in the order of the points.

        Parameters
        ----------
        quantities : iterable of str
            What to compute besides. ``"svf_solid"``: the share of solid angle; ``"directional"``: the four halves of the sky as
            UMEP has them (``svfN``, ``svfE``, ``svfS``, ``svfW``); ``"hidden"``: the shares that near and far geometry hide
            (``hidden_near``, ``hidden_far``); ``"shadow_patches"``: what hides each of the 153 patches of SOLWEIG, as bits
            (``shadow_1``, …); with the crowns of a package's trees ``"svf_total"`` (and ``svfveg``), ``"svfaveg"``,
            ``"directional_vegetation"``: both of the halves of the sky (``svfNveg``, …, ``svfNaveg``, …), and ``"shares"``: of
            sky, vegetation and building.
        verify : int, default 0
            So many random receivers are computed again, exactly, and compared: ``summary["verify"]``.
        points, normals, height, above, metric, max_error, bounds, **options
            As for :meth:`svf`.

        Returns
        -------
        PointAnswers

        Examples
        --------
        >>> answers = city.evaluate([[x, y]], quantities=["directional", "hidden"])
        >>> sorted(answers.quantities)
        ['hidden_far', 'hidden_near', 'svfE', 'svfN', 'svfS', 'svfW']
        >>> float(answers.svf[0] + answers.quantities["hidden_near"][0] + answers.quantities["hidden_far"][0])
        1.0
        """
        receivers = self._receivers(points, normals)
        evaluation = Evaluation(metric, height, above, bounds, max_error, quantities, verify=verify, options=options)
        answers = self._answers(receivers, evaluation)
        names = evaluation.further().columns()
        return PointAnswers(
            answers["svf"],
            answers["low"] if bounds else None,
            answers["high"] if bounds else None,
            answers["height_m"],
            {name: np.ascontiguousarray(answers["further"][:, n]) for n, name in enumerate(names)},
            answers["summary"],
        )

    def horizon(
        self,
        points: Any,
        n_azimuth: int = 360,
        *,
        distances: bool = False,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        **options: Unpack[Options],
    ) -> xarray.DataArray | xarray.Dataset:
        """Elevations of the horizon around points.

        Parameters
        ----------
        points : as for :meth:`svf`
        n_azimuth : int, default 360
            4 to 3,600 azimuths in equal steps clockwise from true north, the first of them north.
        distances : bool, default False
            Whether to tell the level distance to what makes the horizon, too.
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        xarray.DataArray (point, azimuth)
            Degrees above which all is sky; 90 where there is no sky. With ``distances`` a Dataset of ``horizon`` and
            ``distance`` (metres, NaN where the horizon is level).

        Examples
        --------
        >>> horizon = city.horizon([[x, y]], n_azimuth=8)
        >>> horizon.dims, horizon.azimuth.values.tolist()
        (('point', 'azimuth'), [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0])
        """
        count = _arguments.whole_number("n_azimuth", n_azimuth, 4, 3600)
        receivers = self._receivers(points, None)
        evaluation = Evaluation(
            height=height,
            above=above,
            max_error=max_error,
            horizons=count,
            horizon_distances=_arguments.flag("distances", distances),
            options=options,
        )
        table = self._answers(receivers, evaluation)["further"]
        return _grids.horizons(table, count, receivers.index)

    def sky_patches(
        self,
        points: Any,
        patches: SkyPatches = "tregenza",
        *,
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        **options: Unpack[Options],
    ) -> xarray.DataArray:
        """The share of each patch of the sky that points see, weighted by the cosine to their normals.

        Parameters
        ----------
        points, normals : as for :meth:`svf`
        patches : {"tregenza", "reinhart"}
            145 or 577 patches, counted as Radiance counts them: band by band from the horizon upwards, the first of a band at
            true north, the others clockwise; the zenith is the last.
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        xarray.DataArray (point, patch)
            0 to 1. The coordinates ``azimuth`` and ``elevation`` are those of the middle of each patch, in degrees, and
            ``view_factor`` is its weight for a point that looks straight up: ``(share * share.view_factor).sum("patch")`` is
            the sky view factor of such a point.

        Examples
        --------
        >>> shares = city.sky_patches([[x, y]])
        >>> shares.shape
        (1, 145)
        >>> round(float((shares * shares.view_factor).sum()), 2)
        0.94
        """
        receivers = self._receivers(points, normals)
        evaluation = Evaluation(
            height=height,
            above=above,
            max_error=max_error,
            sky_patches=_arguments.word("patches", patches, get_args(SkyPatches)),
            options=options,
        )
        return _grids.patches(self._answers(receivers, evaluation)["further"], receivers.index)

    def sunlit(
        self,
        points: Any,
        azimuth: Any,
        elevation: Any,
        hours: Any,
        *,
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        **options: Unpack[Options],
    ) -> Values:
        """Hours for which the sun shines on points, under a clear sky.

        Parameters
        ----------
        points, normals : as for :meth:`svf`
        azimuth, elevation : array_like of float, (m,)
            Where the sun is, in degrees; azimuths clockwise from true north, as pvlib has them.
        hours : array_like of float, (m,)
            The time that each position stands for.
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        numpy.ndarray of float32, (n,)

        Examples
        --------
        >>> city.sunlit([[x, y, 300.0]], azimuth=[180.0, 270.0], elevation=[40.0, -5.0], hours=[1.0, 1.0])
        array([1.], dtype=float32)
        """
        receivers = self._receivers(points, normals)
        sun = (azimuth, elevation, hours)
        evaluation = Evaluation(height=height, above=above, max_error=max_error, sun=sun, options=options)
        table = self._answers(receivers, evaluation)["further"]
        return _labelled(np.ascontiguousarray(table[:, 0]), receivers)

    def irradiation(
        self,
        points: Any,
        azimuth: Any,
        elevation: Any,
        direct_normal: Any,
        diffuse: Any,
        *,
        hours: Any = 1.0,
        month: Any = None,
        extraterrestrial: Any = 1361.0,
        sky_model: SkyModel = "perez",
        albedo: tuple[float, float] = (0.2, 0.2),
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        **options: Unpack[Options],
    ) -> dict[str, Values]:
        """What falls on points in a period, in kWh/m²; the crowns of trees let all light through.

        Parameters
        ----------
        points, normals : as for :meth:`svf`
        azimuth, elevation : array_like of float, (m,)
            Where the sun is in each interval of the period, as pvlib has it.
        direct_normal, diffuse : array_like of float, (m,)
            Means of the intervals in W/m², on a plane that faces the sun and from the sky on a level one (DNI and DHI).
        hours, extraterrestrial : float or array_like of float, (m,)
            The length of the intervals, and W/m² outside of the atmosphere.
        month : array_like of int, (m,)
            1 to 12; adds a value for each month.
        sky_model : {"perez", "isotropic"}
        albedo : pair of float
            What the ground and façades reflect, once.
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        dict of str to numpy.ndarray of float32, (n,)
            ``"irradiation"``, of which there are ``"irradiation_direct"``, ``"irradiation_diffuse"`` and
            ``"irradiation_reflected"``, and with ``month`` ``"irradiation_01"`` …

        Examples
        --------
        >>> noon = city.irradiation([[x, y, 300.0]], 180.0, 30.0, direct_normal=800.0, diffuse=100.0)
        >>> round(float(noon["irradiation"][0]), 3)
        0.5
        """
        receivers = self._receivers(points, normals)
        light = Light(azimuth, elevation, direct_normal, diffuse, hours, month, extraterrestrial, sky_model, albedo)
        evaluation = Evaluation(height=height, above=above, max_error=max_error, light=light, options=options)
        table = self._answers(receivers, evaluation)["further"]
        names = evaluation.further().columns()
        return {name: _labelled(np.ascontiguousarray(table[:, k]), receivers) for k, name in enumerate(names)}

    # One point

    def look_up(
        self,
        point: Any,
        *,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        **options: Unpack[Options],
    ) -> Hemisphere | None:
        """What a point sees when it looks up, direction by direction.

        Parameters
        ----------
        point : array_like of float, (2,) or (3,)
            Easting, northing, and the height above sea level.
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        Hemisphere, or None where there is no data

        Examples
        --------
        >>> sky = city.look_up((x, y))
        >>> sky.parts.shape, round(sky.svf, 2)
        ((1440, 360), 0.94)
        """
        package = self._open_package()
        place = _arguments.floats("point", point)
        if place.shape not in ((2,), (3,)):
            raise InvalidArgument(f"point has the shape {place.shape}: give x and y, or x, y and z")
        evaluation = Evaluation(height=height, above=above, max_error=max_error, options=options)
        z = float(place[2]) if place.size == 3 and not math.isnan(place[2]) else None
        seen = _runtime.look_up(
            package,
            (float(place[0]), float(place[1])),
            z,
            evaluation.placing(),
            evaluation.settings(),
            evaluation.caller(),
        )
        if seen is None:
            return None
        return Hemisphere(seen["svf"], seen["height_m"], seen["parts"], np.degrees(np.arctan(seen["horizon_tangent"])))

    def fisheye(
        self,
        point: Any,
        size: int = 512,
        projection: _fisheye.Projection = "equidistant",
        *,
        height: float = 1.5,
        above: Above = "ground",
        **options: Unpack[Options],
    ) -> npt.NDArray[np.uint8]:
        """A picture of what a point sees when it looks up. North is up and east is to the left, as for one who lies on the back.

        Parameters
        ----------
        point : as for :meth:`look_up`
        size : int, default 512
            Pixels along the edge, 16 to 8,192.
        projection : {"equidistant", "equisolid", "orthographic", "stereographic"}
            How the angle to the zenith becomes a distance from the middle.
        height, above, **options : as for :meth:`svf`

        Returns
        -------
        numpy.ndarray of uint8, (size, size, 4)
            Red, green, blue, alpha: sky, geometry of the neighborhood, the far city; transparent outside of the circle.

        Examples
        --------
        >>> city.fisheye((x, y), size=64).shape
        (64, 64, 4)
        """
        edge = _arguments.whole_number("size", size, 16, 8192)
        sky = self.look_up(point, height=height, above=above, **options)
        if sky is None:
            raise InvalidArgument("point has no sky: it lies inside a building, below the ground, or where there is no ground")
        return _fisheye.picture(sky.parts, edge, projection)

    # Rasters and surfaces

    def svf_grid(
        self,
        step: float | None = None,
        bbox: Any = None,
        mask: Any = None,
        *,
        like: Any = None,
        chunks: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        metric: Metric = "cosine",
        max_error: float | None = None,
        bounds: bool = False,
        quantities: Iterable[Quantity] = (),
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
            In the CRS of the city.
        mask : geopandas.GeoSeries or GeoDataFrame of polygons, or a polygon of shapely in the CRS of the city, optional
            Pixels whose centres lie outside of it have no data, and cost next to nothing.
        like : xarray.DataArray or Dataset on (y, x), optional
            Takes the pixels of this raster, which is north-up, has square pixels, and the CRS of the city.
        chunks : int, tuple or "auto", optional
            Edge of blocks in pixels. The raster is then computed lazily, block by block, by dask; each block with one thread,
            unless ``threads`` says otherwise. Its values are those of a raster without chunks, to the bit.
        height, above, metric, max_error, bounds, **options : as for :meth:`svf`
        quantities : as for :meth:`evaluate`
        verify : as for :meth:`evaluate`
            Not with chunks.

        Returns
        -------
        xarray.Dataset on (y, x)
            ``svf`` (``svf_solid`` with that metric), with ``bounds`` also ``svf_low`` and ``svf_high``, and a variable for each
            further quantity: float32, NaN where
            there is no data, and beyond the cells of the grid. ``spatial_ref`` holds the CRS, where rioxarray and GDAL look for
            it; the attribute ``summary`` the figures of the run as JSON. y runs from north to south.

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
            region=region if chunks is None else None,
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
        mask : as for :meth:`svf_grid`
        verify : as for :meth:`evaluate`
            The figures of the run are ``attrs["summary"]``.

        Returns
        -------
        geopandas.GeoDataFrame
            A row for each surface, with the columns of the tables of farlod-svf: ``geometry`` (MultiPolygon Z), ``building``,
            ``surface`` (its number in the building), ``kind``, ``azimuth_deg`` and ``tilt_deg`` of its outward normal,
            ``area_m2`` of what has an answer and ``covered_area_m2`` of what has none, ``receivers``, ``nodata`` (receivers
            without an answer), ``svf_mean`` (weighted by area), ``svf_min``, ``svf_max``, and a column for each quantity. With
            ``points`` a row for each receiver: Point Z, ``building``, ``surface``, ``kind``, ``azimuth_deg``, ``tilt_deg``,
            ``area_m2``, ``svf``, with ``bounds`` also ``svf_low`` and ``svf_high``.

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
            region=region_of(mask, self.crs_wkt),
            verify=verify,
            options=options,
        )
        frame = _surfaces.frame(
            package,
            _arguments.word("which", which, get_args(_surfaces.Choice)),
            _arguments.number("spacing", spacing),
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
            west, south, east, north = self.bounds
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


def _labelled(values: Floats, receivers: Receivers) -> Values:
    if receivers.index is None:
        return values
    import pandas

    return pandas.Series(values, index=receivers.index, name="svf")


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
