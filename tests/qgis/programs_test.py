#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests what of the plug-in needs no QGIS: finding and running programs, their options, and where they write.

    tests/qgis/programs_test.py PROGRAMS

PROGRAMS is the folder of the programs.
"""
from __future__ import annotations

import importlib
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import types
import unittest

PLUG_IN = pathlib.Path(__file__).resolve().parents[2] / "qgis" / "farlod"
PROGRAMS = pathlib.Path()
sys.dont_write_bytecode = True


def module(name: str) -> types.ModuleType:
    sys.path.insert(0, str(PLUG_IN))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(PLUG_IN))


program_run, program_folder, staging = module("program_run"), module("program_folder"), module("staging")


class Listener:
    """Notes what it is told. Cancels when the progress reaches `cancels_at`."""

    def __init__(self, cancels_at: float = 101.0) -> None:
        self.progress: list[float] = []
        self.stages: list[str] = []
        self.warnings: list[str] = []
        self.cancels_at = cancels_at

    def isCanceled(self) -> bool:
        return bool(self.progress) and self.progress[-1] >= self.cancels_at

    def setProgress(self, percent: float) -> None:
        self.progress.append(percent)

    def setProgressText(self, text: str) -> None:
        self.stages.append(text)

    def pushWarning(self, text: str) -> None:
        self.warnings.append(text)


class InTemporaryFolder(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def script(self, name: str, text: str) -> str:
        path = self.folder / name
        path.write_text("#!/bin/sh\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)


class RunningPrograms(InTemporaryFolder):
    def test_lines_of_the_output_are_returned(self) -> None:
        script = self.script("says", "echo '1 building'; echo; echo 'CRS: Gauß–Krüger'; echo 'far maps: 5 %, about 1 s left'")
        listener = Listener()
        self.assertEqual(
            program_run.run_program([script], listener), ["1 building", "CRS: Gauß–Krüger", "far maps: 5 %, about 1 s left"]
        )
        self.assertEqual(listener.progress, [])

    def test_arguments_arrive_as_they_are(self) -> None:
        script = self.script("repeats", 'printf "%s\\n" "$@"')
        self.assertEqual(program_run.run_program([script, "a b", "$HOME;", "é"], Listener()), ["a b", "$HOME;", "é"])

    def test_progress_is_told_by_stage(self) -> None:
        lines = r"printf '\r\033[Ktiles: 5 %%, about 2 min 01 s left\r\033[Ktiles: 50 %%, about 1 s left\r\033[K' >&2; "
        script = self.script("works", lines + "echo 'far maps: 100 %, about 0 s left' >&2")
        listener = Listener()
        program_run.run_program([script], listener)
        self.assertEqual(listener.progress, [5.0, 50.0, 100.0])
        self.assertEqual(listener.stages, ["tiles", "far maps"])

    def test_programs_are_on_a_terminal_which_is_why_they_tell_progress_often(self) -> None:
        self.assertEqual(program_run.run_program([self.script("asks", "test -t 2 && echo yes")], Listener()), ["yes"])

    def test_what_a_failing_program_says_is_its_error(self) -> None:
        script = self.script("fails", "echo 'tiles: 5 %, about 1 s left' >&2; echo 'farlod-pack: town.gml is empty' >&2; exit 3")
        with self.assertRaises(program_run.ProgramFailed) as raised:
            program_run.run_program([script], Listener())
        self.assertEqual((str(raised.exception), raised.exception.exit_code), ("farlod-pack: town.gml is empty", 3))

    def test_what_a_program_says_though_it_succeeds_is_a_warning(self) -> None:
        listener = Listener()
        program_run.run_program([self.script("warns", "echo 'tiles: 5 %, about 1 s left' >&2; echo 'low on disk' >&2")], listener)
        self.assertEqual(listener.warnings, ["low on disk"])

    def test_a_silent_failure_has_its_exit_code(self) -> None:
        with self.assertRaisesRegex(program_run.ProgramFailed, "^fails ended with exit code 5$"):
            program_run.run_program([self.script("fails", "exit 5")], Listener())

    def test_cancelling_ends_the_program(self) -> None:
        begin = "echo $$ > pid; trap 'echo told > end; exit 1' TERM; echo 'tiles: 30 %, about 9 s left' >&2; "
        wait = "i=0; while [ $i -lt 600 ]; do sleep 0.1; i=$((i+1)); done"
        script = self.script("sleeps", f"cd {self.folder}; {begin}{wait}")
        with self.assertRaises(program_run.Cancelled):
            program_run.run_program([script], Listener(cancels_at=30.0))
        self.assertEqual((self.folder / "end").read_text(), "told\n")
        with self.assertRaises(ProcessLookupError):
            os.kill(int((self.folder / "pid").read_text()), 0)

    def test_a_program_that_does_not_listen_is_killed(self) -> None:
        self.addCleanup(setattr, program_run, "GRACE_S", program_run.GRACE_S)
        program_run.GRACE_S = 0.3
        wait = "i=0; while [ $i -lt 600 ]; do sleep 0.1; i=$((i+1)); done"
        begin = f"cd {self.folder}; trap '' TERM; echo 'tiles: 30 %, about 9 s left' >&2"
        script = self.script("deaf", f"{begin}; {wait}; echo lived > end")
        with self.assertRaises(program_run.Cancelled):
            program_run.run_program([script], Listener(cancels_at=30.0))
        self.assertFalse((self.folder / "end").exists())


class Options(unittest.TestCase):
    def options_in(self, text: str) -> set[str]:
        return set(re.findall(r"--[a-z]+(?:-[a-z]+)*", text))

    def test_those_of_the_plug_in_are_those_of_the_programs(self) -> None:
        evaluation = ("evaluation.py", "raster.py", "points.py", "surfaces.py")
        for programs, files in ((("farlod-pack",), ("pack.py",)), (("farlod-svf", "farlod-info"), evaluation)):
            helped = "".join(subprocess.check_output([PROGRAMS / program, "--help"], text=True) for program in programs)
            named = self.options_in("".join((PLUG_IN / file).read_text(encoding="utf-8") for file in files))
            self.assertGreater(len(named), 5)
            self.assertEqual(named - self.options_in(helped), set(), programs)


class FindingPrograms(InTemporaryFolder):
    def setUp(self) -> None:
        super().setUp()
        for place in ("settings", "variable", "path"):
            (self.folder / place).mkdir()
            self.script(f"{place}/farlod-svf", "")
        (self.folder / "empty").mkdir()

        # What is installed on this computer is not what is looked for
        self.addCleanup(setattr, program_folder, "USUAL_PLACES", program_folder.USUAL_PLACES)
        program_folder.USUAL_PLACES = tuple(place for place in program_folder.USUAL_PLACES if place.startswith("~"))

    def installed(self, place: str) -> str:
        (self.folder / place / "bin").mkdir(parents=True)
        return self.script(f"{place}/bin/farlod-svf", "")

    def found(self, settings: str, **environment: str) -> str:
        places = {name: str(self.folder / place) for name, place in {"HOME": "home", **environment}.items()}
        python_path = [str(self.folder / "site-packages"), str(self.folder / "lost")]
        return program_folder.find_program("farlod-svf", str(self.folder / settings) if settings else "", places, python_path)

    def test_the_setting_comes_before_the_variable_before_the_path(self) -> None:
        places = {"FARLOD_BIN": "variable", "PATH": "path"}
        self.assertEqual(self.found("settings", **places), str(self.folder / "settings/farlod-svf"))
        self.assertEqual(self.found("", **places), str(self.folder / "variable/farlod-svf"))
        self.assertEqual(self.found("", PATH="path"), str(self.folder / "path/farlod-svf"))

    def test_a_folder_that_is_named_and_wrong_is_told(self) -> None:
        with self.assertRaisesRegex(program_folder.ProgramMissing, "empty, which the Processing option Far-LoD.* names: give"):
            self.found("empty", FARLOD_BIN="variable")
        with self.assertRaisesRegex(program_folder.ProgramMissing, "empty, which the environment variable FARLOD_BIN names"):
            self.found("", FARLOD_BIN="empty", PATH="path")

    def test_what_to_do_is_told_when_it_is_nowhere(self) -> None:
        with self.assertRaisesRegex(program_folder.ProgramMissing, "farlod-svf was not found. Install .*archive.*FARLOD_BIN.*PATH"):
            self.found("", PATH="empty")

    def test_an_archive_is_found_where_people_unpack_it(self) -> None:
        for place in ("home/farlod-0.9.0-linux-x86_64", "home/farlod-0.10.1-linux-x86_64", "home/.local/opt/farlod", "home/.local"):
            program = self.installed(place)
            self.assertEqual(self.found("", PATH="empty"), program)

    def test_the_latest_archive_is_taken(self) -> None:
        programs = {version: self.installed(f"home/farlod-{version}-linux-x86_64") for version in ("0.10.0", "0.9.1", "0.8.2")}
        self.assertEqual(self.found("", PATH="empty"), programs["0.10.0"])

    def test_a_wheel_in_this_python_comes_after_the_path_before_archives(self) -> None:
        self.installed("home/.local")
        program = self.installed("site-packages/farlod/_prefix")
        self.assertEqual(self.found("", PATH="empty"), program)
        self.assertEqual(self.found("", PATH="path"), str(self.folder / "path/farlod-svf"))


class WhereProgramsWrite(InTemporaryFolder):
    def test_results_are_moved_to_their_places(self) -> None:
        (self.folder / "svf.asc").write_text("old")
        with staging.Staging(str(self.folder / "svf.asc")) as stage:
            stage.result.write_text("map")
            stage.result.with_suffix(".prj").write_text("CRS")
            (stage.folder / "mask.gpkg").write_text("input")
            stage.hand_over()
        self.assertEqual({path.name: path.read_text() for path in self.folder.iterdir()}, {"svf.asc": "map", "svf.prj": "CRS"})

    def test_a_run_that_fails_leaves_nothing_and_takes_nothing(self) -> None:
        (self.folder / "svf.tif").write_text("old")
        with self.assertRaises(ZeroDivisionError), staging.Staging(str(self.folder / "svf.tif")) as stage:
            stage.result.write_text("half a map")
            raise ZeroDivisionError
        self.assertEqual({path.name: path.read_text() for path in self.folder.iterdir()}, {"svf.tif": "old"})

    def test_a_missing_folder_is_told(self) -> None:
        with self.assertRaisesRegex(staging.OutputRefused, "there is no folder .*lost; make it first"):
            staging.Staging(str(self.folder / "lost" / "svf.tif"))

    def package(self, name: str, *files: str) -> pathlib.Path:
        for file in files:
            path = self.folder / name / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name)
        return self.folder / name

    def test_a_package_is_replaced_as_a_whole(self) -> None:
        old = self.package("town.farlod", "manifest.json", "blocks/0_0/tiles.bin")
        with staging.Staging(str(old)) as stage:
            stage.result.mkdir()
            (stage.result / "manifest.json").write_text("new")
            stage.hand_over_package()
        self.assertEqual([path.name for path in self.folder.iterdir()], ["town.farlod"])
        self.assertEqual([path.name for path in old.iterdir()], ["manifest.json"])
        self.assertEqual((old / "manifest.json").read_text(), "new")

    def test_only_packages_are_replaced_and_only_on_request(self) -> None:
        package = self.package("town.farlod", "manifest.json")
        staging.require_room_for_package(self.folder / "new.farlod", overwrite=False)
        staging.require_room_for_package(package, overwrite=True)
        with self.assertRaisesRegex(staging.OutputRefused, "exists already"):
            staging.require_room_for_package(package, overwrite=False)
        whole = self.package("whole.farlod", "manifest.json", "crowns.bin", "far_terrain.bin", "heights.bin", "sources.bin")
        staging.require_room_for_package(whole, overwrite=True)
        with self.assertRaisesRegex(staging.OutputRefused, "holds letter.txt, which is not part of a package"):
            staging.require_room_for_package(self.package("home", "letter.txt"), overwrite=True)
        with self.assertRaisesRegex(staging.OutputRefused, "is a file"):
            staging.require_room_for_package(package / "manifest.json", overwrite=True)

    def test_unfinished_work_goes_away_when_a_run_fails_unless_it_was_there_before(self) -> None:
        package = self.package("town.farlod", "manifest.json")
        unfinished = self.folder / "town.farlod.unfinished"
        for was_there in (False, True):
            with self.assertRaises(ZeroDivisionError), staging.NothingUnfinished(package):
                self.package("town.farlod.unfinished", "blocks/0_0/tiles.bin")
                raise ZeroDivisionError
            self.assertEqual(unfinished.exists(), was_there)
            unfinished.mkdir(exist_ok=True)
        self.assertTrue(package.exists())


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1))
    unittest.main()
