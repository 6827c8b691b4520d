# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Sky view factors of large cities.

A city becomes a package once, with :func:`pack`. :func:`open` gives a :class:`City`, which answers points, rasters and the
surfaces of buildings.

>>> city = farlod.open(village)
>>> grid = city.svf_grid(step=5.0)
>>> round(float(grid.svf.mean()), 2)
0.8

Lengths are in metres, azimuths in degrees clockwise from true north, coordinates in the CRS of the city (:attr:`City.crs`).
NaN is no data. Arrays go in and come out without a copy where their layout allows it, and other threads of Python run meanwhile.
With xarray installed, ``import farlod`` also gives arrays the accessor ``.farlod`` (:class:`FarlodAccessor`).
"""

from __future__ import annotations

from farlod._answers import Hemisphere, PackageCheck, PointAnswers, SvfInterval
from farlod._city import City, open
from farlod._light import Light
from farlod._modules import runtime as _runtime
from farlod._packing import Heights, Problem, ProblemsWarning, Report, Trees, pack
from farlod._settings import Options
from farlod._view_factors import ViewFactorMatrix
from farlod.errors import (
    Cancelled,
    Error,
    InputError,
    InvalidArgument,
    InvalidPoint,
    LimitReached,
    OutputError,
    PackageDamaged,
    PackageUnusable,
    ProblemsRefused,
)

__version__: str = _runtime.version

__all__ = [
    "Cancelled",
    "City",
    "Error",
    "Heights",
    "Hemisphere",
    "InputError",
    "InvalidArgument",
    "InvalidPoint",
    "Light",
    "LimitReached",
    "Options",
    "OutputError",
    "PackageCheck",
    "PackageDamaged",
    "PackageUnusable",
    "PointAnswers",
    "Problem",
    "ProblemsRefused",
    "ProblemsWarning",
    "Report",
    "SvfInterval",
    "Trees",
    "ViewFactorMatrix",
    "open",
    "pack",
]

try:
    import xarray as _xarray
except ModuleNotFoundError:  # it is optional
    pass
else:
    from farlod._accessor import FarlodAccessor

    __all__ += ["FarlodAccessor"]
    del _xarray
