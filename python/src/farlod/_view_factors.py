# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What surfaces see of each other, as a sparse matrix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Unpack, get_args

import numpy as np
import numpy.typing as npt

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod._open_city import OpenCity
from farlod._regions import region_of
from farlod._settings import Evaluation, Options
from farlod._surfaces import Choice
from farlod.errors import InvalidArgument

#: Columns behind those of surfaces and cells.
REST = _runtime.words["matrix_rest"]


@dataclass(frozen=True, eq=False)
class ViewFactorMatrix:
    """View factors between surfaces: :meth:`City.view_factor_matrix`. Names are those of the file of ``farlod-svf --matrix``.

    Attributes
    ----------
    data : numpy.ndarray of float32, (entries,)
        View factors, row by row: F_ij is the share of the view of surface i, weighted by the cosine, that column j fills. Each
        row adds up to 1.
    indices : numpy.ndarray of int32, (entries,)
        Their columns, ascending in each row.
    indptr : numpy.ndarray of int64, (rows + 1,)
        Row i has the entries from ``indptr[i]`` to ``indptr[i + 1]``.
    shape : tuple of int
        Rows and columns.
    building : numpy.ndarray of object, (rows,)
        Of each row, and of each of the first columns: as in :meth:`City.surfaces`, in the same order.
    surface : numpy.ndarray of uint32, (rows,)
        Its number in the building.
    area_m2 : numpy.ndarray of float64, (rows,)
        The area of its receivers with data: A_i F_ij = A_j F_ji.
    columns_after_surfaces : list of str
        Names of the other columns: ``ground_I_J`` of the cell I, J, then ``ground_beyond`` (beyond the grid), ``sky``, ``crown``,
        ``other`` (undersides, backs of surfaces, surfaces without a row), ``dropped`` (below the threshold).
    ground_centres_m : numpy.ndarray of float64, (cells, 2)
        Easting and northing of the middle of each of those cells.
    summary : mapping
        The figures of the run, as ``matrix`` of farlod-svf ``--summary`` names them.
    """

    data: npt.NDArray[np.float32]
    indices: npt.NDArray[np.int32]
    indptr: npt.NDArray[np.int64]
    shape: tuple[int, int]
    building: npt.NDArray[np.object_]
    surface: npt.NDArray[np.uint32]
    area_m2: npt.NDArray[np.float64]
    columns_after_surfaces: list[str]
    ground_centres_m: npt.NDArray[np.float64]
    summary: Mapping[str, Any]

    def csr(self) -> Any:
        """The same as a sparse array of SciPy, which shares the data.

        Returns
        -------
        scipy.sparse.csr_array, (rows, columns)

        Examples
        --------
        >>> views = city.view_factor_matrix(spacing=10.0)
        >>> between = views.csr()[:, : len(views.building)]
        >>> exchange = between.multiply(views.area_m2[:, None])  # in m², the same from either side
        """
        import scipy.sparse

        return scipy.sparse.csr_array((self.data, self.indices, self.indptr), shape=self.shape)

    def seen(self, what: str) -> npt.NDArray[np.float64]:
        """What each surface sees of something, 0 to 1.

        Parameters
        ----------
        what : str
            One of ``columns_after_surfaces``, or ``"surfaces"``, or ``"ground"`` for the ground of all cells and beyond.

        Returns
        -------
        numpy.ndarray of float64, (rows,)

        Examples
        --------
        >>> views = city.view_factor_matrix("roofs", spacing=10.0)
        >>> bool((views.seen("sky") > 0.5).any())
        True
        """
        is_wanted = np.zeros(self.shape[1], bool)
        is_wanted[self._columns_of(what)] = True
        rows = np.repeat(np.arange(self.shape[0]), np.diff(self.indptr))
        entries = is_wanted[self.indices]
        return np.bincount(rows[entries], weights=self.data[entries], minlength=self.shape[0]).astype(np.float64)

    def _columns_of(self, what: Any) -> slice:
        surfaces, names = self.shape[0], self.columns_after_surfaces
        if what == "surfaces":
            return slice(0, surfaces)
        if what == "ground":
            return slice(surfaces, surfaces + names.index("ground_beyond") + 1)
        if what not in names:
            raise InvalidArgument(
                f'what is {_arguments.shown(what)}: give "surfaces", "ground", "sky" or another name of columns_after_surfaces'
                + _arguments.nearest(what, ("surfaces", "ground", *REST))
            )
        column = surfaces + names.index(what)
        return slice(column, column + 1)


def _matrix_of(found: Any, threshold: float) -> ViewFactorMatrix:
    names = [f"ground_{i}_{j}" for i, j in found["ground_cells"].tolist()] + list(REST)
    rows = len(found["building"])
    shape = (rows, rows + len(names))
    counts = {"surfaces": rows, "columns": shape[1], "entries": len(found["data"]), "threshold": threshold}
    return ViewFactorMatrix(
        data=found["data"],
        indices=found["indices"],
        indptr=found["indptr"],
        shape=shape,
        building=np.array(found["building"], dtype=object),
        surface=found["surface"],
        area_m2=found["area_m2"],
        columns_after_surfaces=names,
        ground_centres_m=found["ground_centres_m"],
        summary={**counts, **found["figures"]},
    )


class ViewFactorsOfCity(OpenCity):
    """What surfaces see of each other: a part of :class:`farlod.City`."""

    def view_factor_matrix(
        self,
        which: Choice = "all",
        spacing: float = 2.0,
        *,
        threshold: float = 1e-4,
        mask: Any = None,
        **options: Unpack[Options],
    ) -> ViewFactorMatrix:
        """View factors between the surfaces of buildings, and from them to the ground of each cell, the sky and crowns.

        Rays of each receiver meet the whole city. What they found is made reciprocal, and rows add up to 1.

        Parameters
        ----------
        which : {"roofs", "walls", "all"}
            The surfaces that have a row. Others are ``other`` to those that see them.
        spacing : float, default 2.0
            Metres between receivers, as for :meth:`surfaces`.
        threshold : float, default 1e-4
            View factors of surfaces and ground below it have no entry; their sum is ``dropped``.
        mask : as for :meth:`svf_grid`
            Surfaces that have receivers there have a row, each as a whole.
        **options : as for :meth:`svf`
            Of them ``rays``, ``directions`` and ``canopy_rule`` with what belongs to it change the matrix.

        Returns
        -------
        ViewFactorMatrix

        Examples
        --------
        >>> views = city.view_factor_matrix(spacing=10.0, rays=200)
        >>> sums = views.seen("surfaces") + views.seen("ground") + sum(views.seen(name) for name in ("sky", "crown", "other", "dropped"))
        >>> bool((abs(sums - 1.0) < 1e-5).all())
        True
        """
        package = self._open_package()
        evaluation = Evaluation(region=region_of(mask, self.crs_wkt), options=options)
        least = _arguments.number("threshold", threshold)
        found = _runtime.view_factor_matrix(
            package,
            _arguments.word("which", which, get_args(Choice)),
            _arguments.number("spacing", spacing),
            least,
            evaluation.settings(),
            evaluation.caller(),
        )
        return _matrix_of(found, least)
