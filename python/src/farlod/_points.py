# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What can be asked of the points of a city."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal, Unpack, get_args, overload

import numpy as np

from farlod import _arguments, _grids
from farlod._answers import Floats, PointAnswers, SvfInterval, Values
from farlod._light import Light
from farlod._open_city import OpenCity
from farlod._receivers import Receivers
from farlod._settings import Above, Evaluation, Metric, Options, Quantity, SkyPatches
from farlod.errors import InvalidArgument

if TYPE_CHECKING:
    import xarray


class PointsOfCity(OpenCity):
    """Points, one by one: a part of :class:`farlod.City`."""

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
            pandas.Series with its index. Points more than 200 m beyond the grid (``bounds``) have no answer: NaN, and a warning;
            where all lie there, they are refused.
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
            (``shadow_1``, …); ``"view_factors"``: what is seen, by class (``view_sky``, ``view_ground``, ``view_roof``,
            ``view_wall_n``, …, ``view_crown``, ``view_other``), and ``"view_factors_below"``: what of it lies below the
            horizontal (``view_ground_below``, …); the same classes as the six faces of a cube see them, whatever the normal,
            ``"view_cube"`` (``view_sky_up``, …, with ``_down``, ``_north``, ``_east``, ``_south``, ``_west``), all around as
            shares of solid angle, ``"view_sphere"`` (``view_sky_sphere``, …), and in a field at eye level, ``"view_eye"``
            (``view_crown_eye``, the green view, …); ``"view_building"``: the share of the view that the building ``sees``
            fills, and whether anything of it is seen (``sees_building``); with the crowns of a package's trees ``"svf_total"`` (and ``svfveg``), ``"svfaveg"``,
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
        azimuth: Any = None,
        elevation: Any = None,
        hours: Any = None,
        *,
        light: Light | None = None,
        trees: bool = False,
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
        light : Light, optional
            Its positions of the sun, in place of the three arrays: ``city.light(period="2026-06-21")`` has those of a day.
        trees : bool
            Whether crowns of trees take of each hour what they take of light (``canopy_rule``, ``transmissivity`` …).
        height, above, max_error, **options : as for :meth:`svf`

        Returns
        -------
        numpy.ndarray of float32, (n,)

        Examples
        --------
        >>> city.sunlit([[x, y, 300.0]], azimuth=[180.0, 270.0], elevation=[40.0, -5.0], hours=[1.0, 1.0])
        array([1.], dtype=float32)
        >>> open_place = city.sunlit([[x, y, 300.0]], light=city.light(period="2026-06-21"))
        >>> bool(15.0 < open_place[0] < 17.0)
        True
        """
        receivers = self._receivers(points, normals)
        sun = _positions_of(azimuth, elevation, hours, light)
        evaluation = Evaluation(height=height, above=above, max_error=max_error, sun=sun, sunlit_total=trees, options=options)
        table = self._answers(receivers, evaluation)["further"]
        return _labelled(np.ascontiguousarray(table[:, -1]), receivers, "sunlit_h")


def _positions_of(azimuth: Any, elevation: Any, hours: Any, light: Light | None) -> tuple[Any, Any, Any]:
    """Of the sun. Raises InvalidArgument unless there are either three arrays or a light."""
    arrays = {"azimuth": azimuth, "elevation": elevation, "hours": hours}
    missing = [name for name, values in arrays.items() if values is None]
    if light is None and not missing:
        return azimuth, elevation, hours
    if light is None or len(missing) < len(arrays):
        raise InvalidArgument("the sun's positions are arrays of azimuth, elevation and hours, or those of a light: give one of the two")
    if not isinstance(light, Light):
        raise InvalidArgument(f"light is a {type(light).__name__}: give a farlod.Light, as City.light() makes it")
    return light.sun


def _labelled(values: Floats, receivers: Receivers, name: str = "svf") -> Values:
    if receivers.index is None:
        return values
    import pandas

    return pandas.Series(values, index=receivers.index, name=name)
