# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The urban form of cells as a GeoDataFrame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Unpack

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod._open_city import OpenCity
from farlod._regions import zones_of
from farlod._settings import Evaluation, Options

if TYPE_CHECKING:
    import geopandas

#: Columns that count something, and have a number in every row.
COUNTS = ("buildings",)


class CellsOfCity(OpenCity):
    """What each cell of the grid has of buildings: a part of :class:`farlod.City`."""

    def cells(
        self, svf: float | None = None, *, zones: Any = None, **options: Unpack[Options]
    ) -> geopandas.GeoDataFrame:
        """Urban form of each cell of the grid: plan area fraction, frontal area density for 16 wind directions, heights, roughness.

        Parameters
        ----------
        svf : float, optional
            Metres between receivers, 0.05 to 1,000: gives the mean sky view factors of the ground between buildings
            (``svf_ground``), of walls (``svf_walls``) and of roofs (``svf_roofs``).
        zones : geopandas.GeoDataFrame or GeoSeries of polygons, optional
            Census blocks, local climate zones, squares of a model: the rows are these, in the place of cells, with their index,
            geometry and CRS. Walls and roofs are cut exactly at their borders; a wall on a border belongs to the zone of its
            building. ``area_m2`` is all of the polygon in the CRS of the city, also beyond the grid.
        **options : as for :meth:`svf`
            All but ``threads``, ``memory_limit`` and ``progress`` are for these alone.

        Returns
        -------
        geopandas.GeoDataFrame
            A row for each cell, from the south-west row by row, with the columns of the table of ``farlod-info --cells``, not
            rounded: ``geometry`` (the square of the cell), ``i``, ``j``, ``x_m`` and ``y_m`` (its centre), ``lambda_p``,
            ``lambda_f``, ``lambda_f_000`` … ``lambda_f_337``, ``vegetation_fraction`` and so on. NaN where a cell has nothing
            to tell, as heights without buildings.

        Examples
        --------
        >>> cells = city.cells()
        >>> bool((cells.lambda_p <= 1.0).all()), int(cells.area_m2.sum()) == len(cells) * city.info["cell_edge_m"] ** 2
        (True, True)
        """
        import geopandas
        import shapely.geometry

        package = self._open_package()
        evaluation = Evaluation(options=options)
        spacing = None if svf is None else _arguments.number("svf", svf)
        if zones is not None:
            return self._zones(package, zones, spacing, evaluation)
        found = _runtime.cells_of(package, spacing, evaluation.settings(), evaluation.caller())
        corners = found["corners_m"]
        middle = 0.5 * (corners[:, 0] + corners[:, 2])
        columns = {"i": found["i"], "j": found["j"], "x_m": middle[:, 0], "y_m": middle[:, 1], **found["columns"]}
        return geopandas.GeoDataFrame(_with_counts(columns), geometry=[shapely.geometry.Polygon(square) for square in corners], crs=self.crs)

    def _zones(self, package: Any, zones: Any, spacing: float | None, evaluation: Evaluation) -> geopandas.GeoDataFrame:
        import geopandas

        rings = zones_of(zones, self.crs_wkt)
        columns = _with_counts(_runtime.zones_of(package, rings, spacing, evaluation.settings(), evaluation.caller()))
        return geopandas.GeoDataFrame(columns, geometry=zones.geometry.values, index=zones.index, crs=zones.geometry.crs)


def _with_counts(columns: dict[str, Any]) -> dict[str, Any]:
    return {name: values.astype("int64") if name in COUNTS else values for name, values in columns.items()}
