# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What an open package is, before anything is asked of it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import TracebackType
from typing import Any, Self

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod._receivers import Receivers, receivers_of, require_near
from farlod._settings import Evaluation
from farlod.errors import InvalidArgument


class OpenCity:
    """A package that is open, or was closed: the base of :class:`farlod.City`."""

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
    def city_bounds(self) -> _arguments.Bbox:
        """West, south, east and north of the buildings and what is around them, or of the raster that the city is: of rasters, by
        default. Around them is 50 m, or a thirtieth of the box's side where that is less, but no less than 5 m. Of a bare
        terrain, the same as ``bounds``."""
        west, south, east, north = self._description["city_m"]
        return west, south, east, north

    @property
    def closed(self) -> bool:
        """Whether the city was closed: all functions then raise InvalidArgument."""
        return self._package is None

    def close(self) -> None:
        """Forgets the package. Runs of other threads that are under way end as if nothing had happened."""
        self._package = None

    def __enter__(self) -> Self:
        self._open_package()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def __repr__(self) -> str:
        d = self._description
        state = "closed" if self.closed else f"{d['columns']} x {d['rows']} cells of {d['cell_edge_m']:g} m"
        return f"<farlod.City {os.path.basename(self._path)!r}: {d['buildings']:,} buildings, {d['crs_name']}, {state}>"

    def _open_package(self) -> Any:
        if self._package is None:
            raise InvalidArgument(f"the city {self._path} is closed: open it again with farlod.open()")
        return self._package

    def _receivers(self, points: Any, normals: Any) -> Receivers:
        self._open_package()
        receivers = receivers_of(points, normals, self.crs_wkt, float(self._description["convergence_deg"]), self.bounds)
        require_near(receivers.x, receivers.y, self.bounds, self._description["crs_name"], given=receivers.first_given)
        return receivers

    def _answers(self, receivers: Receivers, evaluation: Evaluation) -> Mapping[str, Any]:
        columns = _runtime.PointColumns(receivers.x, receivers.y, receivers.z, receivers.azimuth, receivers.tilt)
        answers: Mapping[str, Any] = _runtime.evaluate_points(
            self._open_package(), columns, evaluation.placing(), evaluation.settings(), evaluation.caller()
        )
        return answers
