# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Maps on the axes of matplotlib."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from farlod import _arguments
from farlod.errors import InvalidArgument

if TYPE_CHECKING:
    import matplotlib.axes
    import xarray


def extent(grid: xarray.Dataset) -> tuple[float, float, float, float]:
    """West, east, south and north of the outer edges of a raster."""
    if not {"x", "y"} <= set(getattr(grid, "coords", ())) or min(grid.sizes["x"], grid.sizes["y"]) < 1:
        raise InvalidArgument("grid has no coordinates x and y: give what svf_grid() returns")
    x, y = grid.x.values, np.sort(grid.y.values)
    step = float(x[1] - x[0]) if x.size > 1 else float(y[1] - y[0]) if y.size > 1 else 1.0
    return float(x[0]) - step / 2, float(x[-1]) + step / 2, float(y[0]) - step / 2, float(y[-1]) + step / 2


def draw_map(
    grid: xarray.Dataset,
    variable: str | None,
    outlines: npt.NDArray[np.float64] | None,
    ax: matplotlib.axes.Axes | None,
    colorbar: bool,
    imshow: Mapping[str, Any],
) -> matplotlib.axes.Axes:
    """A raster, a colour bar, and segments (n, 2, 2) above it."""
    import matplotlib.pyplot
    from matplotlib.collections import LineCollection

    names = list(getattr(grid, "data_vars", ()))
    if not names:
        raise InvalidArgument(f"grid is {_arguments.shown(grid)}: give what svf_grid() returns, with coordinates x and y")
    if variable is not None and variable not in names:
        raise InvalidArgument(f"variable is {_arguments.shown(variable)}: give one of " + ", ".join(map(repr, names)) + _arguments.nearest(variable, map(str, names)))
    shown = names[0] if variable is None else variable
    axes = matplotlib.pyplot.subplots()[1] if ax is None else ax
    values = grid[shown].sortby("y", ascending=False)
    style = {"cmap": "viridis", "vmin": 0.0, "vmax": 1.0, "interpolation": "nearest", **imshow}
    image = axes.imshow(values.values, extent=extent(grid), origin="upper", **style)
    if colorbar:
        axes.figure.colorbar(image, ax=axes, label=values.attrs.get("long_name", shown))
    if outlines is not None:
        axes.add_collection(LineCollection(list(outlines), colors="black", linewidths=0.4))
    axes.set_aspect("equal")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.locator_params(nbins=5)
    axes.set_xlabel("easting (m)")
    axes.set_ylabel("northing (m)")
    return axes
