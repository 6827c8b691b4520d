# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of the hemisphere above a point."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from farlod import _arguments

Projection = Literal["equidistant", "equisolid", "orthographic", "stereographic"]

#: Red, green, blue, alpha of sky, geometry of the neighborhood, and the far city: the colours of farlod-svf's pictures.
COLOURS = np.array([[205, 229, 248, 255], [66, 66, 76, 255], [230, 159, 0, 255]], np.uint8)
_TRANSPARENT = np.zeros(4, np.uint8)


def _zenith_angle(radius: npt.NDArray[np.float64], projection: str) -> npt.NDArray[np.float64]:
    """The angle to the zenith in radians at a distance from the middle, which is 1 at the horizontal."""
    angles: npt.NDArray[np.float64]
    inside = np.minimum(radius, 1.0)
    if projection == "equidistant":
        angles = inside * (np.pi / 2)
    elif projection == "equisolid":
        angles = 2.0 * np.arcsin(inside * np.sin(np.pi / 4))
    elif projection == "orthographic":
        angles = np.arcsin(inside)
    else:
        angles = 2.0 * np.arctan(inside)
    return angles


def picture(parts: npt.NDArray[np.uint8], size: int, projection: Projection) -> npt.NDArray[np.uint8]:
    """``parts`` (azimuth, elevation) as Hemisphere has them, as an image (size, size, 4)."""
    chosen = _arguments.word("projection", projection, ("equidistant", "equisolid", "orthographic", "stereographic"))
    offsets = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    # North is up, and east to the left
    east, north = -offsets[np.newaxis, :], -offsets[:, np.newaxis]
    radius = np.hypot(east, north)
    azimuths, elevations = parts.shape
    azimuth = np.mod(np.arctan2(east, north), 2.0 * np.pi) * (azimuths / (2.0 * np.pi))
    elevation = (np.pi / 2 - _zenith_angle(radius, chosen)) * (elevations / (np.pi / 2))
    seen = parts[
        np.minimum(azimuth.astype(np.intp), azimuths - 1), np.clip(elevation.astype(np.intp), 0, elevations - 1)
    ]
    image: npt.NDArray[np.uint8] = COLOURS[seen]
    image[radius > 1.0] = _TRANSPARENT
    return image
