# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Sky view factors as UMEP finds them, in NumPy: shadows by shifts of whole pixels, in the directions of 153 patches of the sky.

With less work than UMEP's own functions have for a step: logical arrays for shadows, in place.
"""
from collections.abc import Iterator

import numpy as np

# Patches of each band, the borders of bands, their middles, and the azimuths of their first patches, in degrees
COUNTS = (31, 30, 28, 24, 19, 13, 7, 1)
BORDERS = (0, 12, 24, 36, 48, 60, 72, 84, 90)
ELEVATIONS = (6, 18, 30, 42, 54, 66, 78, 90)
FIRST_AZIMUTHS = (0, 4, 2, 5, 8, 0, 10, 0)
HALVES = {"N": 270, "E": 0, "S": 90, "W": 180}  # the azimuths at which they begin


def patches() -> Iterator[tuple[float, float, float]]:
    """Azimuth and elevation of the middle of each patch, in degrees, and its share of the sky."""
    for count, low, high, elevation, first in zip(COUNTS, BORDERS, BORDERS[1:], ELEVATIONS, FIRST_AZIMUTHS):
        share = (np.sin(np.radians(high)) ** 2 - np.sin(np.radians(low)) ** 2) / count
        for n in range(count):
            yield first + 360 * n / count, elevation, share


def shifts(shape: tuple[int, int], highest_m: float, step_m: float, azimuth: float, elevation: float) -> Iterator[tuple]:
    """Pixels, the pixels that lie the shift away from them, and how much a ray rises on the way.

    Each step goes a pixel along the longer axis, and is rounded on the other one.
    """
    right, down = np.sin(np.radians(azimuth)), -np.cos(np.radians(azimuth))
    longer = max(abs(right), abs(down))
    rise_m = step_m * np.tan(np.radians(elevation)) / longer
    rows, columns = shape
    for n in range(1, int(highest_m / rise_m) + 2):
        x, y = round(n * right / longer), round(n * down / longer)
        if abs(x) >= columns or abs(y) >= rows:
            break
        here = np.s_[max(0, -y) : rows - max(0, y), max(0, -x) : columns - max(0, x)]
        there = np.s_[max(0, y) : rows + min(0, y), max(0, x) : columns + min(0, x)]
        yield here, there, n * rise_m


def seen(height_m: np.ndarray, step_m: float, azimuth: float, elevation: float) -> np.ndarray:
    """Where nothing hides a direction."""
    if elevation == 90:
        return np.ones(height_m.shape, bool)
    highest_m = height_m.copy()
    for here, there, rise_m in shifts(height_m.shape, np.ptp(height_m), step_m, azimuth, elevation):
        highest_m[here] = np.maximum(highest_m[here], height_m[there] - rise_m)
    return highest_m <= height_m


def sky_view_factors(height_m: np.ndarray, step_m: float) -> np.ndarray:
    return sum(share * seen(height_m, step_m, azimuth, elevation) for azimuth, elevation, share in patches())


def hidden(height_m: np.ndarray, top_m: np.ndarray, bottom_m: np.ndarray, step_m: float, azimuth: float,
           elevation: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where something solid hides a direction (B), a crown does and nothing solid (V (1 - B)), a crown before something solid (F).

    Tops and bottoms of crowns are elevations, below the ground where there are none.
    """
    solid, crown, before = (np.zeros(height_m.shape, bool) for _ in range(3))
    highest_m, last_m = height_m.copy(), 0.0
    reach_m = max(height_m.max(), top_m.max()) - height_m.min()
    for here, there, rise_m in shifts(height_m.shape, reach_m, step_m, azimuth, min(elevation, 89.9)):
        highest_m[here] = np.maximum(highest_m[here], height_m[there] - rise_m)
        np.greater(highest_m, height_m, out=solid)
        # A crown is met unless the ray is below its bottom, or above its top, at both ends of the step
        ends = [edge[there] - rise > height_m[here] for edge in (top_m, bottom_m) for rise in (rise_m, last_m)]
        crown[here] |= (ends[0] | ends[1] | ends[2] | ends[3]) & ~(ends[0] & ends[1] & ends[2] & ends[3])
        crown &= ~solid
        before |= crown
        last_m = rise_m
    return solid, crown, before & solid


def with_vegetation(height_m: np.ndarray, top_m: np.ndarray, bottom_m: np.ndarray, step_m: float) -> dict[str, np.ndarray]:
    """The fifteen rasters of svfs.zip: svf, svfveg and svfaveg of the whole sky and of its halves."""
    names = [f"svf{half}{kind}" for kind in ("", "veg", "aveg") for half in ("", *HALVES)]
    svf = {name: np.ones(height_m.shape, "f4") for name in names}
    for azimuth, elevation, share in patches():
        hiding = dict(zip(("", "veg", "aveg"), hidden(height_m, top_m, bottom_m, step_m, azimuth, elevation)))
        for kind, where in hiding.items():
            svf[f"svf{kind}"] -= np.float32(share) * where
            for half, begin in HALVES.items():
                if (azimuth - begin) % 360 < 180:
                    svf[f"svf{half}{kind}"] -= np.float32(2 * share) * where
    return svf
