#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests validation/paper_table: its figures, and its table and picture of a small town. Usage: paper_table_test.py BIN"""
from __future__ import annotations

import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "validation/paper_table"
loader = importlib.machinery.SourceFileLoader("paper_table", str(SCRIPT))
paper_table = importlib.util.module_from_spec(importlib.util.spec_from_loader("paper_table", loader))
loader.exec_module(paper_table)

BIN = sys.argv.pop(1)


def run(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(SCRIPT), "--bin", BIN, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Figures(unittest.TestCase):
    def test_errors_are_absolute_and_ranked(self) -> None:
        truth = np.full(200, 0.5)
        error = np.arange(1, 201) / 1000
        errors = paper_table.errors_of(truth + error * np.where(np.arange(200) % 2, 1, -1), truth)
        np.testing.assert_allclose(errors, (0.1005, 0.198, 0.2))

    def test_a_city_that_is_not_there_is_refused(self) -> None:
        refused = run("Atlantis")
        self.assertEqual((refused.returncode, refused.stdout), (1, ""))
        self.assertIn("Atlantis is neither a file nor a city", refused.stderr)


class SmallTown(unittest.TestCase):
    """The columns are c and N; mean, 99 % and max of the paper's map by 1,000 and by 20,000 rays; MB; ours; MB."""

    @classmethod
    def setUpClass(cls) -> None:
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "errors.svg"
            done = run("--size", 300, "--cells", 30, 90, "--receivers", 100, "--no-times", "-o", picture)
            assert done.returncode == 0, done.stderr
            cls.picture = picture.read_text()
        cls.lines = [line.strip("| ").split(" | ") for line in done.stdout.splitlines()]
        cls.rows = [[float(cell) for cell in line[1:]] for line in cls.lines[2:]]

    def test_each_size_of_cells_and_neighborhoods_has_a_row_of_both_kinds(self) -> None:
        self.assertEqual([line[0] for line in self.lines[2:]], ["30, 3", "30, 5", "90, 3", "90, 5"])
        self.assertEqual({len(line) for line in self.lines if len(line) > 1}, {12})

    def test_the_map_from_one_point_errs_more_than_ours_where_cells_are_small(self) -> None:
        by_many_rays, ours = np.array(self.rows)[:, 3:6], np.array(self.rows)[:, 7:10]
        self.assertTrue((by_many_rays[:2, 0] > 4 * ours[:2, 0]).all(), self.rows)
        self.assertTrue((ours[:, 2] < 0.004).all(), self.rows)

    def test_rays_are_noise_where_all_is_near(self) -> None:
        """The last row: 5 x 5 cells of 90 m are the whole town for most receivers."""
        by_few_rays, by_many_rays = self.rows[-1][0:3], self.rows[-1][3:6]
        self.assertGreater(by_few_rays[0], 0.001)
        self.assertLess(by_many_rays[0], 0.0004)

    def test_errors_are_ordered(self) -> None:
        for row in self.rows:
            for first in (0, 3, 7):
                self.assertTrue(0 < row[first] <= row[first + 1] <= row[first + 2], row)

    def test_packages_are_told_in_megabytes(self) -> None:
        for row in self.rows:
            for size_mb in (row[6], row[10]):
                self.assertTrue(0.02 < size_mb < 3.0, row)

    def test_the_picture_names_all_series(self) -> None:
        for name in paper_table.NAMES:
            for neighborhood in (3, 5):
                self.assertIn(f"{name.replace(chr(39), '&apos;')}, N = {neighborhood}, mean",
                              self.picture.replace("'", "&apos;"))


if __name__ == "__main__":
    unittest.main()
