# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What one point of a city sees."""

from __future__ import annotations

import math
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from farlod import _arguments, _fisheye
from farlod._answers import Hemisphere
from farlod._modules import runtime as _runtime
from farlod._open_city import OpenCity
from farlod._receivers import require_near
from farlod._settings import Above, Evaluation, Options
from farlod.errors import InvalidArgument


class HemispheresOfCity(OpenCity):
    """One point that looks up: a part of :class:`farlod.City`."""

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
        require_near(place[:1], place[1:2], self.bounds, self._description["crs_name"])
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
