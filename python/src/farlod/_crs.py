# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Where arrays of xarray say their CRS."""

from __future__ import annotations

from typing import Any


def crs_of_array(array: Any) -> Any:
    """The CRS of a DataArray or Dataset as a pyproj.CRS, from its accessor ``.rio`` or its ``spatial_ref``; None where it says
    none."""
    import pyproj

    accessor = getattr(array, "rio", None)
    attributes = array.coords["spatial_ref"].attrs if "spatial_ref" in array.coords else {}
    its = accessor.crs if accessor is not None else attributes.get("crs_wkt")
    return pyproj.CRS.from_user_input(its) if its else None
