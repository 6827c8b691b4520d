# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The light of a period."""

from __future__ import annotations

import datetime
import os
from typing import Any, get_args

import numpy as np
import numpy.typing as npt

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod._settings import SkyModel
from farlod.errors import InvalidArgument

_Columns = dict[str, npt.NDArray[np.float64]]

_OF_INTERVALS = ("direct_normal", "diffuse", "direct_normal_lux", "diffuse_lux", "hours", "extraterrestrial", "month", "begin")


def _seconds_of(begin: Any) -> npt.NDArray[np.float64]:
    """Since 1970."""
    try:
        times = np.asarray(begin, "datetime64[s]")
    except (TypeError, ValueError):
        raise InvalidArgument(f"begin is {_arguments.shown(begin)}: give times as datetime64") from None
    if np.isnat(times).any():
        raise InvalidArgument("begin has a NaT: give a time for each interval")
    return times.astype(np.float64)


class Light:
    """The light of a period: where the sun is, and what comes from it and from the sky. Of weather, :meth:`City.light` makes it.

    Parameters
    ----------
    azimuth, elevation : array_like of float, (m,)
        Where the sun is in each interval of the period, in degrees, as pvlib has it.
    direct_normal, diffuse : array_like of float, (m,)
        Means of the intervals in W/m², on a plane that faces the sun and from the sky on a level one (DNI and DHI).
    hours, extraterrestrial : float or array_like of float, (m,)
        The length of the intervals, and W/m² outside of the atmosphere.
    direct_normal_lux, diffuse_lux : array_like of float, (m,), optional
        The same two as light to the eye, NaN where it is not known: ``"illuminance"`` needs some.
    month : array_like of int, (m,), optional
        1 to 12; irradiation then has a value for each month, too.
    begin : array_like of datetime64, (m,), optional
        When the intervals begin; ``"shade"`` then has a value for each that has a sun, too.
    sky_model : {"perez", "isotropic"}
        How the light of the sky is spread over it.
    albedo : pair of float
        What the ground and façades reflect, once.

    Attributes
    ----------
    source : str
        What it is made of, for people.
    remarks : list of str
        What was missing, filled, left out or doubtful in a file of weather.
    hours : float
        Of all intervals.
    global_horizontal : float
        What falls on a level plane in the open, in kWh/m².

    Examples
    --------
    >>> noon = farlod.Light(180.0, 30.0, direct_normal=800.0, diffuse=100.0)
    >>> round(noon.global_horizontal, 3)
    0.5
    """

    source: str
    remarks: list[str]
    hours: float
    global_horizontal: float

    def __init__(
        self,
        azimuth: Any,
        elevation: Any,
        direct_normal: Any,
        diffuse: Any,
        *,
        hours: Any = 1.0,
        month: Any = None,
        begin: Any = None,
        extraterrestrial: Any = 1361.0,
        direct_normal_lux: Any = np.nan,
        diffuse_lux: Any = np.nan,
        sky_model: SkyModel = "perez",
        albedo: tuple[float, float] = (0.2, 0.2),
    ) -> None:
        given = {
            "azimuth": azimuth,
            "elevation": elevation,
            "direct_normal": direct_normal,
            "diffuse": diffuse,
            "direct_normal_lux": direct_normal_lux,
            "diffuse_lux": diffuse_lux,
            "hours": hours,
            "extraterrestrial": extraterrestrial,
            "month": 1.0 if month is None else month,
            "begin": 0.0 if begin is None else _seconds_of(begin),
        }
        columns = {name: _arguments.floats(name, values) for name, values in given.items()}
        try:
            together = np.broadcast_arrays(*columns.values())
        except ValueError:
            raise InvalidArgument(f"{', '.join(columns)} are not of one length: give one of each for each interval") from None
        of_intervals = {name: np.array(column, np.float64).ravel() for name, column in zip(columns, together)}
        # In each interval the sun stands still; a night has none
        up = ~(of_intervals["elevation"] <= 0.0)
        suns = {name: of_intervals[name][up] for name in ("azimuth", "elevation", "hours")}
        self._set(of_intervals, up.astype(np.float64), suns, (month is not None, begin is not None), sky_model, albedo)
        self.source, self.remarks = "arrays", []

    def _set(
        self,
        intervals: _Columns,
        sun_count: npt.NDArray[np.float64],
        suns: _Columns,
        by: tuple[bool, bool],
        sky_model: Any,
        albedo: Any,
    ) -> None:
        self._columns = [intervals[name] for name in _OF_INTERVALS]
        self._suns = [sun_count, suns["azimuth"], suns["elevation"], suns["hours"]]
        self._by_month, self._by_step = by
        self._sky_model = _arguments.word("sky_model", sky_model, get_args(SkyModel))
        self._albedo = tuple(_arguments.floats("albedo", albedo).ravel().tolist())
        if len(self._albedo) != 2:
            raise InvalidArgument(f"albedo is {_arguments.shown(albedo)}: give two numbers, those of the ground and of façades")
        self.hours = float(intervals["hours"].sum())
        self.global_horizontal = _runtime.global_horizontal_kwh_m2(*self._columns, *self._suns)

    @property
    def sun(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Where the sun is, as :meth:`City.sunlit` takes it: azimuths and elevations in degrees, and hours of each."""
        _, azimuth, elevation, hours = self._suns
        return azimuth, elevation, hours

    def _add_to(self, further: Any) -> None:
        """Asks ``Quantities`` for the irradiation of this light. Raises InvalidArgument."""
        further.set_light(*self._columns, *self._suns, self._sky_model, *self._albedo, self._by_month, self._by_step)
        further.ask("irradiation")

    def __repr__(self) -> str:
        return f"<farlod.Light of {self.hours:g} hours, {self.global_horizontal:.4g} kWh/m² on a level plane: {self.source}>"


def _period_text(period: Any) -> str:
    if getattr(period, "shape", ()) or not isinstance(period, (str, int, np.datetime64, datetime.date)):
        raise InvalidArgument(f'period is {_arguments.shown(period)}: give a text like "2026-06-21" or "2026-06/2026-08"')
    return str(period)


def light_over(
    place: tuple[float, float],
    weather: str | os.PathLike[str] | None,
    period: str | None,
    step: int,
    linke_turbidity: float,
    by_month: bool,
    by_step: bool,
    sky_model: SkyModel,
    albedo: tuple[float, float],
) -> Light:
    """The light of weather, or of a clear sky, over a longitude and latitude, as City.light() describes it."""
    found = _runtime.light_of_period(
        "" if weather is None else os.path.abspath(_arguments.path("weather", weather)),
        "" if period is None else _period_text(period),
        _arguments.whole_number("step", step, 1, 60),
        _arguments.number("linke_turbidity", linke_turbidity),
        *place,
    )
    light = Light.__new__(Light)
    by = (_arguments.flag("by_month", by_month), _arguments.flag("by_step", by_step))
    light._set(found["intervals"], found["sun_count"], found["suns"], by, sky_model, albedo)
    light.hours, light.source, light.remarks = found["hours"], found["source"], found["remarks"]
    return light
