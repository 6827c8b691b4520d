#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests validation/umep_method.py on scenes with known answers."""
import sys
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation"))
from umep_method import HALVES, patches, sky_view_factors, with_vegetation  # noqa: E402

SIDE, BELOW_M = 21, -1000.0
MIDDLE = (SIDE // 2, SIDE // 2)
ROUNDING = 153 * np.finfo("f4").eps  # of sums of shares, in floats


def level() -> np.ndarray:
    return np.zeros((SIDE, SIDE))


class UmepMethod(unittest.TestCase):
    def test_patches_are_the_whole_sky(self):
        self.assertEqual(len(list(patches())), 153)
        self.assertAlmostEqual(sum(share for _, _, share in patches()), 1, delta=ROUNDING)

    def test_level_ground_sees_all(self):
        np.testing.assert_allclose(sky_view_factors(level(), 1.0), 1, atol=ROUNDING)

    def test_a_deep_well_sees_the_zenith_alone(self):
        height_m = level() + 1000
        height_m[MIDDLE] = 0
        zenith = [share for _, elevation, share in patches() if elevation == 90]
        self.assertAlmostEqual(sky_view_factors(height_m, 1.0)[MIDDLE], sum(zenith), delta=ROUNDING)

    def test_a_wall_in_the_west_takes_the_western_half(self):
        height_m = level()
        height_m[:, : MIDDLE[1]] = 1e6
        svf = with_vegetation(height_m, level() + BELOW_M, level() + BELOW_M, 1.0)
        self.assertGreater(svf["svfE"][MIDDLE], 0.9)
        self.assertLess(svf["svfW"][MIDDLE], 0.1)

    def test_without_crowns_the_sky_is_that_of_what_is_solid(self):
        height_m = np.random.default_rng(3).uniform(0, 5, (SIDE, SIDE))
        svf = with_vegetation(height_m, level() + BELOW_M, level() + BELOW_M, 1.0)
        np.testing.assert_allclose(svf["svf"], sky_view_factors(height_m, 1.0), atol=4e-3)  # the zenith is a patch like others
        np.testing.assert_allclose(svf["svfveg"], 1, atol=ROUNDING)
        np.testing.assert_allclose(svf["svfaveg"], 1, atol=ROUNDING)

    def test_a_crown_overhead_hides_the_sky_and_no_wall(self):
        svf = with_vegetation(level(), level() + 8, level() + 3, 1.0)
        np.testing.assert_allclose(svf["svf"], 1, atol=ROUNDING)
        self.assertLess(svf["svfveg"][MIDDLE], 0.1)
        np.testing.assert_allclose(svf["svfaveg"], 1, atol=ROUNDING)

    def test_a_crown_before_a_wall_counts_in_svfaveg_alone(self):
        height_m, top_m, bottom_m = level(), level() + BELOW_M, level() + BELOW_M
        height_m[0, :] = 1e6  # in the north
        top_m[MIDDLE[0] - 3, :], bottom_m[MIDDLE[0] - 3, :] = 4, 0.1
        svf = with_vegetation(height_m, top_m, bottom_m, 1.0)
        self.assertLess(svf["svfNaveg"][MIDDLE], 0.9)
        self.assertGreater(svf["svfSaveg"][MIDDLE], 0.999)
        self.assertGreater(svf["svfSveg"][MIDDLE], 0.999)

    def test_a_crown_behind_a_wall_does_not_count(self):
        height_m, top_m, bottom_m = level(), level() + BELOW_M, level() + BELOW_M
        height_m[MIDDLE[0] - 3, :] = 1e6
        top_m[0, :], bottom_m[0, :] = 9, 0.1
        svf = with_vegetation(height_m, top_m, bottom_m, 1.0)
        self.assertGreater(svf["svfNveg"][MIDDLE], 0.999)
        self.assertGreater(svf["svfNaveg"][MIDDLE], 0.999)

    def test_halves_add_up(self):
        random = np.random.default_rng(4)
        height_m = random.uniform(0, 5, (SIDE, SIDE))
        svf = with_vegetation(height_m, height_m + random.uniform(1, 9, height_m.shape), height_m + 0.5, 1.0)
        for kind in ("", "veg", "aveg"):
            for pair in ("NS", "EW"):
                mean = sum(svf[f"svf{half}{kind}"] for half in pair) / 2
                np.testing.assert_allclose(mean, svf[f"svf{kind}"], atol=2 * ROUNDING, err_msg=f"{kind} {pair}")
        self.assertEqual(sorted(HALVES), sorted("NESW"))


if __name__ == "__main__":
    unittest.main()
