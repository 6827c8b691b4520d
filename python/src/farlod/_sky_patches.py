# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The divisions of the sky by Tregenza (1987) and Reinhart, as the library counts their patches (farlod/quantities.hpp)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

#: Patches of each band of Tregenza's, from the horizon upwards, without the zenith.
TREGENZA_BANDS = (30, 30, 24, 24, 18, 12, 6)


def _bands(patches: int) -> tuple[list[int], float]:
    """The number of patches of each band, and how high a band is in degrees."""
    if patches == 145:
        return list(TREGENZA_BANDS), 90.0 / 7.5
    return [2 * count for count in TREGENZA_BANDS for _ in range(2)], 90.0 / 14.5


def middle_of_patches(patches: int) -> tuple[Floats, Floats, Floats]:
    """Azimuths and elevations of the middles of 145 or 577 patches, in degrees, and the view factors of the patches from a level
    surface: the sines squared of a band's upper border less that of its lower one, divided among its patches."""
    counts, height = _bands(patches)
    azimuth, elevation, weight = [], [], []
    for band, count in enumerate(counts):
        low, high = np.radians(band * height), np.radians((band + 1) * height)
        azimuth.append(np.arange(count) * (360.0 / count))
        elevation.append(np.full(count, (band + 0.5) * height))
        weight.append(np.full(count, (np.sin(high) ** 2 - np.sin(low) ** 2) / count))
    top = np.radians(len(counts) * height)
    return (
        np.concatenate([*azimuth, [0.0]]),
        np.concatenate([*elevation, [90.0]]),
        np.concatenate([*weight, [1.0 - np.sin(top) ** 2]]),
    )
