# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The urban form of cells as a GeoDataFrame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod._open_city import OpenCity
from farlod._settings import Evaluation, Options

if TYPE_CHECKING:
    import geopandas

#: Columns that count something, and have a number in every row.
COUNTS = ("buildings",)


class CellsOfCity(OpenCity):
    """What each cell of the grid has of buildings: a part of :class:`farlod.City`."""

    def cells(self, svf: float | None = None, **options: Unpack[Options]) -> geopandas.GeoDataFrame:
        """Urban form of each cell of the grid: plan area fraction, frontal area density for 16 wind directions, heights, roughness.

        Parameters
        ----------
        svf : float, optional
            Metres between receivers, 0.05 to 1,000: gives the mean sky view factors of the ground between buildings
            (``svf_ground``), of walls (``svf_walls``) and of roofs (``svf_roofs``).
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
        found = _runtime.cells_of(package, spacing, evaluation.settings(), evaluation.caller())
        corners = found["corners_m"]
        middle = 0.5 * (corners[:, 0] + corners[:, 2])
        columns = {"i": found["i"], "j": found["j"], "x_m": middle[:, 0], "y_m": middle[:, 1], **found["columns"]}
        for name in COUNTS:
            columns[name] = columns[name].astype("int64")
        return geopandas.GeoDataFrame(columns, geometry=[shapely.geometry.Polygon(square) for square in corners], crs=self.crs)
