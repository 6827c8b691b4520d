#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests validation/compare_rasters.py."""
from __future__ import annotations

import dataclasses
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "validation"))
import compare_rasters as rasters  # noqa: E402


def grid_of(values: object, west_m: float = 100.0, south_m: float = 200.0) -> object:
    return rasters.Grid(np.array(values, float), west_m, south_m)


def counting() -> object:
    """Ten columns and rows, whose values count up."""
    return grid_of(np.arange(100).reshape(10, 10))


class Comparison(unittest.TestCase):
    def test_equal_rasters_do_not_differ(self) -> None:
        d = rasters.compare(counting(), counting())
        self.assertEqual((d["count"], d["bias"], d["max_abs"]), (100, 0.0, 0.0))
        self.assertAlmostEqual(d["correlation"], 1.0, 15)

    def test_figures_are_those_of_their_names(self) -> None:
        d = rasters.compare(grid_of([[1, 1], [2, 5]]), grid_of([[0, 1], [2, 3]]))
        self.assertEqual((d["bias"], d["max_abs"], d["rms"]), (0.75, 2.0, math.sqrt(5 / 4)))
        # Σ(a − ā)(b − b̄) = 6.5, Σ(a − ā)² = 10.75, Σ(b − b̄)² = 5
        self.assertAlmostEqual(d["correlation"], 6.5 / math.sqrt(10.75 * 5.0), 15)

    def test_ninety_nine_of_a_hundred_are_no_larger(self) -> None:
        raster = counting()
        raster.values -= np.arange(100, 0, -1).reshape(10, 10)
        d = rasters.compare(raster, counting())
        self.assertEqual((d["p99_abs"], d["max_abs"], d["bias"]), (99.0, 100.0, -50.5))

    def test_the_rim_is_left_out(self) -> None:
        raster = counting()
        raster.values[1, 4] = 1000.0
        self.assertEqual(rasters.compare(raster, counting(), 1)["max_abs"], 1000.0 - 14.0)
        inside = rasters.compare(raster, counting(), 2)
        self.assertEqual((inside["count"], inside["max_abs"]), (36, 0.0))
        self.assertEqual(rasters.compare(raster, counting(), 5)["count"], 0)
        self.assertEqual(rasters.compare(raster, counting(), 7)["count"], 0)

    def test_places_are_compared_not_indices(self) -> None:
        # The middle 3 × 2 pixels, two from the west and three from the south
        part = grid_of([[52, 53, 54], [62, 63, 64]], 102.0, 203.0)
        for a, b in ((counting(), part), (part, counting())):
            d = rasters.compare(a, b)
            self.assertEqual((d["count"], d["max_abs"]), (6, 0.0))

    def test_pixels_that_lie_across_are_refused(self) -> None:
        for change in ({"west_m": 100.5}, {"south_m": 200.5}, {"step_m": 2.0}):
            with self.assertRaises(ValueError):
                rasters.compare(dataclasses.replace(counting(), **change), counting())

    def test_pixels_without_a_value_do_not_count(self) -> None:
        raster, reference = counting(), counting()
        raster.values[0, 0] = reference.values[0, 1] = math.nan
        self.assertEqual(rasters.compare(raster, reference)["count"], 98)

    def test_heights_choose_pixels(self) -> None:
        for rim, limits, count in ((0, {"above": 20.0}, 80), (0, {"below": 20.0}, 20), (1, {"below": 20.0}, 8)):
            self.assertEqual(rasters.compare(counting(), counting(), rim, counting(), **limits)["count"], count)


class AsciiGridFile(unittest.TestCase):
    def read(self, text: str) -> object:
        with tempfile.NamedTemporaryFile("w", suffix=".asc") as file:
            file.write(text)
            file.flush()
            return rasters.read_grid(file.name)

    def test_it_is_read_from_the_north_west(self) -> None:
        grid = self.read("NCOLS 3\nnrows 2\nxllcorner 1.5\nyllcorner -2\ncellsize 0.5\nNODATA_value -9999\n1 2.5 -9999\n4 5e-1 -2\n")
        self.assertEqual((grid.west_m, grid.south_m, grid.step_m), (1.5, -2.0, 0.5))
        np.testing.assert_array_equal(grid.values, [[1, 2.5, math.nan], [4, 0.5, -2]])

    def test_it_must_have_its_head_and_its_values(self) -> None:
        head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n"
        for text in ("ncols 2\nnrows 1\ncellsize 1\n1 2\n", head + "1 2 3\n"):
            with self.assertRaises(ValueError):
                self.read(text)
        with self.assertRaises(OSError):
            rasters.read_grid("no_such_file.asc")


if __name__ == "__main__":
    unittest.main()
