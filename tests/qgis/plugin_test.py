#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The plug-in as a whole: what QGIS lists of it, its tutorial, and what it refuses. qgis_runs.py says how to call it."""
from __future__ import annotations

import json
import re

from qgis_runs import (
    algorithm,
    main,
    must,
    QGIS_PROCESS,
    QgisTest,
    ROOT,
    run,
    setUpModule,
    village_points,
    WORK,
)


class Plugin(QgisTest):
    def test_all_algorithms_are_listed(self) -> None:
        said = must(QGIS_PROCESS, "list")
        for name, title in {
            "pack": "Pack a city",
            "raster": "Sky view factor raster",
            "points": "Sky view factor of points",
            "surfaces": "Sky view factor of façades and roofs",
        }.items():
            self.assertRegex(said, rf"farlod:{name}\s+{title}\n")

    def test_each_has_help_and_so_has_each_parameter(self) -> None:
        for name in ("pack", "raster", "points", "surfaces"):
            facts = json.loads(must(QGIS_PROCESS, "help", f"farlod:{name}", "--json"))
            self.assertGreater(len(facts["algorithm_details"]["short_description"]), 50)
            for key, parameter in facts["parameters"].items():
                if not parameter["is_destination"]:
                    self.assertGreater(len(parameter.get("help", "")), 3, f"{name} {key}")


class Tutorial(QgisTest):
    def test_its_commands_say_what_it_says(self) -> None:
        """A block of the page is a command of qgis_process, or lines that the command above it says."""
        folder = WORK / "tutorial"
        folder.mkdir()
        (folder / "datasets").symlink_to(ROOT / "datasets")
        page = (ROOT / "docs/tutorials/qgis.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        said, commands, lines = "", 0, 0
        for block in blocks:
            if block.startswith("qgis_process run "):
                said = must("sh", "-c", f"cd '{folder}' && '{QGIS_PROCESS}'" + block.removeprefix("qgis_process"))
                commands += 1
            elif commands > 0:
                for line in block.splitlines():
                    key, value = line.split(": ")
                    self.assertRegex(said, rf"(?m)^{key}:\s*{value}")
                    lines += 1
        self.assertEqual((commands, lines), (6, 17))


class Refusals(QgisTest):
    """That wrong inputs end with an exit code; processing_test.py has all of them."""

    def refused(self, name: str, text: str, **parameters: object) -> None:
        said = algorithm(name, must_fail=True, **parameters)
        self.assertRegex(said, text)
        self.assertEqual(self.new_names(), [])

    def test_what_the_program_says_is_the_error(self) -> None:
        self.refused("pack", "farlod-pack: lost.gml does not exist", INPUT="lost.gml", OUTPUT=WORK / "none.farlod")
        self.refused("raster", "farlod-svf: .*lost.farlod", PACKAGE=WORK / "lost.farlod", OUTPUT=WORK / "none.tif")
        points = village_points("points.geojson")
        self.before.add(points)
        self.refused("points", "farlod-svf: .*lost.farlod", PACKAGE=WORK / "lost.farlod", INPUT=points, OUTPUT=WORK / "none.gpkg")
        self.refused("surfaces", "sunlit needs a day", PACKAGE=WORK / "village.farlod", QUANTITIES="sunlit",
                     BUILDINGS=WORK / "none.gpkg")

    def test_programs_that_are_not_found(self) -> None:
        words = [f"PACKAGE={WORK / 'village.farlod'}", f"OUTPUT={WORK / 'none.tif'}"]
        done = run(QGIS_PROCESS, "run", "farlod:raster", "--", *words, FARLOD_BIN="", PATH="/usr/bin:/bin")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout + done.stderr, "farlod-svf was not found. Install the programs of Far-LoD")


if __name__ == "__main__":
    main()
