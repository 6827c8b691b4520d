#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Prints how far one ESRI ASCII grid is from another, as cells of a row of docs/validation.md: count | bias | r | rms | 99 % | max

    validation/compare_rasters.py RASTER REFERENCE [--rim N] [--height GRID [--above M] [--below M]]

Pixels are compared where the two overlap: an answer for another place is not an error of the answer.
"""
from __future__ import annotations

import argparse
import itertools
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HEAD = ("ncols", "nrows", "xllcorner", "yllcorner", "cellsize", "nodata_value")


@dataclass
class Grid:
    """Its outermost corner in the south-west, and its values from the north-west; NaN where there is no data."""

    values: np.ndarray
    west_m: float = 0.0
    south_m: float = 0.0
    step_m: float = 1.0

    def on(self, reference: Grid) -> np.ndarray:
        """The values at the pixels of another grid; NaN beyond this one."""
        columns = (reference.west_m - self.west_m) / self.step_m
        rows = self.values.shape[0] - reference.values.shape[0] - (reference.south_m - self.south_m) / self.step_m
        if self.step_m != reference.step_m or columns % 1 or rows % 1:
            raise ValueError("the pixels of the rasters do not lie one on the other")
        places = [np.arange(size) + int(first) for size, first in zip(reference.values.shape, (rows, columns))]
        inside = [(place >= 0) & (place < size) for place, size in zip(places, self.values.shape)]
        result = np.full(reference.values.shape, np.nan)
        result[np.ix_(*inside)] = self.values[np.ix_(*(place[there] for place, there in zip(places, inside)))]
        return result


def read_grid(file: Path) -> Grid:
    with open(file) as text:
        head = dict(line.lower().split()[:2] for line in itertools.islice(text, len(HEAD)))
        values = np.array(text.read().split(), float)
    if missing := set(HEAD) - head.keys():
        raise ValueError(f"{file}: its head has no {', '.join(sorted(missing))}")
    columns, rows, west_m, south_m, step_m, no_data = (float(head[key]) for key in HEAD)
    if values.size != rows * columns:
        raise ValueError(f"{file}: {values.size} values, where its head says {rows * columns:.0f}")
    values[values == no_data] = np.nan
    return Grid(values.reshape(int(rows), int(columns)), west_m, south_m, step_m)


def compare(raster: Grid, reference: Grid, rim: int = 0, height: Grid | None = None, above: float = -math.inf,
            below: float = math.inf) -> dict[str, float]:
    """How far a raster is from a reference, without so many pixels along its borders; with a grid of heights, where they lie in
    [above, below). All are 0 when nothing is compared."""
    values, expected = raster.on(reference), reference.values
    wanted = ~np.isnan(values) & ~np.isnan(expected)
    if height is not None:
        heights = height.on(reference)
        wanted &= (heights >= above) & (heights < below)
    middle = tuple(slice(rim, max(rim, size - rim)) for size in wanted.shape)
    a, b = values[middle][wanted[middle]], expected[middle][wanted[middle]]
    if a.size == 0:
        return dict.fromkeys(("count", "bias", "correlation", "rms", "p99_abs", "max_abs"), 0.0)
    sizes = np.sort(np.abs(a - b))
    return {"count": a.size, "bias": a.mean() - b.mean(), "correlation": np.corrcoef(a, b)[0, 1] if np.ptp(a) and np.ptp(b) else 0.0,
            "rms": math.sqrt(np.mean((a - b) ** 2)), "p99_abs": sizes[(99 * a.size + 99) // 100 - 1], "max_abs": sizes[-1]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("raster", type=Path)
    parser.add_argument("reference", type=Path, help="its pixels lie on the other's")
    parser.add_argument("--rim", type=int, default=0, help="pixels left out along each border of the reference")
    parser.add_argument("--height", type=Path, help="grid of heights, for --above and --below")
    parser.add_argument("--above", type=float, default=-math.inf, help="only pixels that are at least this high")
    parser.add_argument("--below", type=float, default=math.inf, help="only pixels that are lower than this")
    a = parser.parse_args()
    if a.height is None and (a.above, a.below) != (-math.inf, math.inf):
        parser.error("--above and --below need --height")
    try:
        d = compare(read_grid(a.raster), read_grid(a.reference), a.rim, a.height and read_grid(a.height), a.above, a.below)
    except (OSError, ValueError) as error:
        sys.exit(f"compare_rasters: {error}")
    print("{count:.0f} | {bias:+.4f} | {correlation:.4f} | {rms:.4f} | {p99_abs:.4f} | {max_abs:.4f}".format(**d))


if __name__ == "__main__":
    main()
