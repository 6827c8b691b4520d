# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What a caller gives, as the library takes it. All functions raise InvalidArgument, which names the argument."""

from __future__ import annotations

import difflib
import math
import operator
import os
import reprlib
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from farlod.errors import InvalidArgument

Bbox = tuple[float, float, float, float]

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = 60


def shown(value: Any) -> str:
    """``value`` as a message shows it: in one short line, and of an array its shape."""
    shape = getattr(value, "shape", ())
    if isinstance(shape, tuple) and shape:
        return f"a {type(value).__name__} of the shape {shape}"
    return " ".join(_SHORT.repr(value).split())


def nearest(value: Any, words: Iterable[str]) -> str:
    """``'; did you mean "roofs"?'``, where ``value`` is nearly one of the words."""
    near = difflib.get_close_matches(value.lower(), list(words), 1, 0.7) if isinstance(value, str) else []
    return f'; did you mean "{near[0]}"?' if near else ""


def whole_number(name: str, value: Any, low: int, high: int) -> int:
    """``value`` as an int from ``low`` to ``high``."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InvalidArgument(f"{name} is {shown(value)}: give a whole number from {low:,} to {high:,}") from None
    if isinstance(value, bool) or not low <= number <= high:
        raise InvalidArgument(f"{name} is {shown(value)}: give a whole number from {low:,} to {high:,}")
    return number


def number(name: str, value: Any) -> float:
    """``value`` as a finite float."""
    try:
        as_float = math.nan if isinstance(value, (bool, str, bytes)) else float(value)
    except (TypeError, ValueError, OverflowError):
        as_float = math.nan
    if not math.isfinite(as_float):
        raise InvalidArgument(f"{name} is {shown(value)}: give a number")
    return as_float


def word(name: str, value: Any, words: Iterable[str]) -> str:
    """``value``, which is one of some words."""
    known = tuple(words)
    if not isinstance(value, str) or value not in known:
        raise InvalidArgument(f"{name} is {shown(value)}: give one of " + ", ".join(f'"{each}"' for each in known) + nearest(value, known))
    return value


def flag(name: str, value: Any) -> bool:
    """``value``, which is true or false."""
    if not isinstance(value, (bool, np.bool_)):
        raise InvalidArgument(f"{name} is {shown(value)}: give True or False")
    return bool(value)


def path(name: str, value: Any) -> str:
    """``value`` as the path of a file or folder."""
    try:
        text = os.fsdecode(value)
    except TypeError:
        raise InvalidArgument(f"{name} is {shown(value)}: give a path") from None
    if not text or "\0" in text:
        raise InvalidArgument(f"{name} is {shown(value)}: give the path of a file or folder")
    return text


def floats(name: str, value: Any) -> npt.NDArray[np.float64]:
    """``value`` as an array of 64-bit floats; not copied where it is one."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiu" and array.size > 0:
            raise TypeError
        return array.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise InvalidArgument(f"{name} cannot be read as an array of numbers: give an array of floats") from None


def bbox(name: str, value: Any) -> Bbox:
    """``value`` as west, south, east, north."""
    corners = floats(name, value)
    if corners.shape != (4,) or not np.isfinite(corners).all():
        raise InvalidArgument(f"{name} is {shown(value)}: give four numbers, west, south, east, north, in the CRS of the city")
    west, south, east, north = (float(corner) for corner in corners)
    if west >= east or south >= north:
        raise InvalidArgument(f"{name} is {shown(value)}, which is empty: give west < east and south < north")
    return west, south, east, north
