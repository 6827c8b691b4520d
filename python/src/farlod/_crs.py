# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Where arrays of xarray say their CRS, and what the library is told of one."""

from __future__ import annotations

from typing import Any

from farlod import _arguments
from farlod.errors import InvalidArgument


def crs_of_array(array: Any) -> Any:
    """The CRS of a DataArray or Dataset as a pyproj.CRS, from its accessor ``.rio`` or its ``spatial_ref``; None where it says
    none."""
    import pyproj

    accessor = getattr(array, "rio", None)
    attributes = array.coords["spatial_ref"].attrs if "spatial_ref" in array.coords else {}
    its = accessor.crs if accessor is not None else attributes.get("crs_wkt")
    return pyproj.CRS.from_user_input(its) if its else None


def crs_text(name: str, crs: Any) -> str:
    """"EPSG:n", from anything that pyproj takes."""
    if crs is None:
        return ""
    if isinstance(crs, str):
        return _arguments.path(name, crs)
    import pyproj

    try:
        epsg = pyproj.CRS.from_user_input(crs).to_epsg()
    except pyproj.exceptions.CRSError as error:
        raise InvalidArgument(f"{name} is {_arguments.shown(crs)}, which is no CRS: give one like \"EPSG:25832\" ({error})") from None
    if epsg is None:
        raise InvalidArgument(f"{name} has no EPSG code: give one that has, like \"EPSG:25832\"")
    return f"EPSG:{epsg}"
