# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What evaluations return."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas

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
