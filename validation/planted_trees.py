# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Trees of 5 to 18 m by chance, as a raster of the tops of their crowns above the ground."""
import numpy as np

REACH = 8  # pixels from a tree's middle


def plant(ground: np.ndarray, share: float, random: np.random.Generator) -> np.ndarray:
    """Until a share of the pixels has a crown; all stand on ground."""
    canopy, (y, x) = np.zeros(ground.shape, "f4"), np.mgrid[-REACH:REACH + 1, -REACH:REACH + 1]
    while np.count_nonzero(canopy) < share * canopy.size:
        row, column = (int(random.integers(REACH, n - REACH)) for n in canopy.shape)
        squared = (x**2 + y**2) / random.uniform(2.0, 6.0) ** 2
        tree = random.uniform(5.0, 18.0) * (1.0 - 0.4 * squared) + random.normal(0.0, 0.3, squared.shape)
        part = np.s_[row - REACH:row + REACH + 1, column - REACH:column + REACH + 1]
        canopy[part] = np.maximum(canopy[part], np.where((squared <= 1.0) & ground[part], np.maximum(tree, 1.0), 0.0))
    return canopy
