# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What falls on the points of a city."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Unpack

from farlod import _grids
from farlod._light import Light, light_over
from farlod._open_city import OpenCity
from farlod._settings import Above, Evaluation, Options, Quantity, SkyModel
from farlod.errors import InvalidArgument

if TYPE_CHECKING:
    import xarray


class IrradiationOfCity(OpenCity):
    """The light of a period, and what falls on points: a part of :class:`farlod.City`."""

    def light(
        self,
        weather: str | os.PathLike[str] | None = None,
        period: str | None = None,
        *,
        step: int = 5,
        linke_turbidity: float = 3.0,
        by_month: bool = False,
        by_step: bool = False,
        sky_model: SkyModel = "perez",
        albedo: tuple[float, float] = (0.2, 0.2),
    ) -> Light:
        """The light of weather over the city, or of a clear sky. Its :attr:`Light.remarks` say what of a file was doubtful.

        Parameters
        ----------
        weather : str or path-like, optional
            EPW, a TMY of PVGIS or NREL as CSV, or a CSV of times and global, direct and diffuse irradiance. Without it, the sky
            is clear.
        period : str, optional
            As ``"2026-06-21"``, ``"2026-06/08"``, ``"2026-06-21T10:00/16:00"``, or of any year ``"06-21"``; by default all of the
            weather. A clear sky needs one, with a year.
        step : int, default 5
            Minutes from one position of the sun to the next, 1 to 60.
        linke_turbidity : float, default 3.0
            Of a clear sky, 1 to 12.
        by_month : bool, default False
            Whether irradiation has a value for each month, too.
        by_step : bool, default False
            Whether ``"shade"`` has a value for each interval with a sun, too: of a clear sky, each ``step``.
        sky_model, albedo : as for :class:`Light`

        Returns
        -------
        Light

        Examples
        --------
        >>> light = city.light(period="2026-06-21")
        >>> light.hours, 8.0 < light.global_horizontal < 9.0
        (24.0, True)
        """
        self._open_package()
        return light_over(self._place(), weather, period, step, linke_turbidity, by_month, by_step, sky_model, albedo)

    def _place(self) -> tuple[float, float]:
        """Longitude and latitude of the middle."""
        import pyproj

        west, south, east, north = self.bounds
        to_degrees = pyproj.Transformer.from_crs(self.crs, "EPSG:4326", always_xy=True)
        longitude, latitude = to_degrees.transform(0.5 * (west + east), 0.5 * (south + north))
        return float(longitude), float(latitude)

    def irradiation(
        self,
        points: Any,
        light: Light,
        *,
        normals: Any = None,
        height: float = 1.5,
        above: Above = "ground",
        max_error: float | None = None,
        quantities: Iterable[Quantity] = (),
        **options: Unpack[Options],
    ) -> xarray.Dataset:
        """What falls on points in a period, in kWh/m².

        Crowns of trees take light, by ``canopy_rule``, ``leaf_off`` and ``transmissivity``.

        Parameters
        ----------
        points, normals : as for :meth:`svf`
        light : Light
            :meth:`light` makes it of weather.
        height, above, max_error, **options : as for :meth:`svf`
        quantities : as for :meth:`evaluate`
            And ``"irradiance"``, the mean in W/m², ``"illuminance"``, the mean in lx of weather that has it, and ``"shade"``, the
            share of the hours with a sun in which none shines.

        Returns
        -------
        xarray.Dataset on (point)
            ``irradiation``, which is the sum of ``irradiation_direct``, ``irradiation_diffuse`` and ``irradiation_reflected``;
            where the light tells months, ``irradiation_by_month`` on (point, month); with ``"shade"``, where it tells steps,
            ``shade_by_step`` on (point, time).

        Examples
        --------
        >>> year = city.light(period="2025", by_month=True, step=60)
        >>> found = city.irradiation([[x, y, 300.0]], year)
        >>> found.irradiation_by_month.sizes["month"], int(found.irradiation_by_month.idxmax("month")[0])
        (12, 6)
        """
        receivers = self._receivers(points, normals)
        if light is None:
            raise InvalidArgument("light is None: give a farlod.Light, as City.light() makes it")
        evaluation = Evaluation(
            height=height, above=above, max_error=max_error, quantities=quantities, light=light, options=options
        )
        table = self._answers(receivers, evaluation)["further"]
        return _grids.columns_of_points(table, evaluation, receivers.index)
