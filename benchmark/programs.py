# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Runs programs for the scripts that measure them, which are in this folder and in validation/."""
from __future__ import annotations

import argparse
import contextlib
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]

# Cities as they exist in the world, below a folder, and what farlod-pack must know of them
REAL = {
    "Rotterdam, Delfshaven: open shells": ("rotterdam/*.json",),
    "Tokyo, PLATEAU: projecting floors": ("tokyo/*.gml",),
    "North Rhine-Westphalia, two tiles": ("nrw/*.gml",),
    "Berlin, 17 buildings": ("trees/berlin_lidar/lod2_buildings_berlin_test_area.gml",),
    "Delft, with terrain": ("delft/*.json",),
    "Manhattan: footprints": ("manhattan/manhattan.geojson", "--height-field", "height"),
    "Omiya: footprints": ("omiya/omiya.geojson", "--height-field", "TAKASA"),
    "Queens: LoD2": ("nyc_queens/queens_da4.obj", "--crs", "EPSG:32118", "--origin", "312420.625,52705.512"),
    "Zürich: hillsides": ("zurich/*.json",),
}


class Run(NamedTuple):
    out: str
    processor_s: float
    wall_s: float


class ProgramFailed(SystemExit):
    """Holds the command, and what it said."""


def run(*command: object, **environment: str) -> Run:
    """Throws ProgramFailed."""
    words = [str(word) for word in command]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    try:
        done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **environment}, check=False)
    except FileNotFoundError:
        raise ProgramFailed(f"there is no program {words[0]}: build the project, or give --bin, the folder of the programs") from None
    wall_s, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise ProgramFailed(f"{' '.join(words)} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return Run(done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall_s)


class Programs:
    """The programs of `bin`. What they make is in `folder`."""

    def __init__(self, bin: Path, folder: Path) -> None:
        self.bin, self.folder = bin, folder
        self.package = folder / "city.farlod"

    def run(self, program: str, *arguments: object) -> Run:
        return run(self.bin / program, *arguments)

    def summary(self, program: str, *arguments: object) -> dict:
        """Of a program that has --summary."""
        file = self.folder / "summary.json"
        self.run(program, *arguments, "--quiet", "--summary", file)
        return json.loads(file.read_text())

    def pack(self, *arguments: object) -> dict:
        """The summary of making `package`."""
        return self.summary("farlod-pack", *arguments, "-o", self.package, "--force")

    def generate(self, name: str, *options: object) -> Path:
        city = self.folder / name
        self.run("farlod-city", "-o", city, *options, "--quiet")
        return city


def rows_of_cities(programs: Programs, data: Path | None, chosen: list[str], generated: dict[str, tuple[str, ...]],
                   row: Callable[[str, list[object]], None]) -> None:
    """Calls `row` with the name of a city, and its files and options for farlod-pack: those of REAL that are in a folder, and generated
    ones, whose ending and options are given. `chosen` are words that names begin with. A row says which are absent, or failed."""
    for name, (pattern, *options) in {**REAL, **generated}.items():
        if chosen and not name.startswith(tuple(chosen)):
            continue
        if name in generated:
            files = [programs.generate(f"generated{pattern}", *options)]
            options = []
        else:
            files = sorted(data.glob(pattern)) if data else []
        try:
            row(name, [*files, *options]) if files else print_row(name, "absent")
        except ProgramFailed:
            print_row(name, "a program failed")


def parser_of(description: str | None) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "bin", help="folder of the programs")
    return parser


def median_of(runs: Iterable[dict], value: Callable[[dict], float]) -> float:
    return statistics.median(value(r) for r in runs)


def print_row(*cells: object) -> None:
    print("|", " | ".join(str(cell) for cell in cells), "|", flush=True)


def print_head(*cells: str) -> None:
    print_row(*cells)
    print("|" + "---|" * len(cells), flush=True)


def processor() -> str:
    with open("/proc/cpuinfo") as cpus:
        return next((line.split(":", 1)[1].strip() for line in cpus if line.startswith("model name")), "unknown")


def compiler() -> str:
    name = os.environ.get("CXX", "c++")
    return f"{name} {run(name, '-dumpfullversion').out.strip()}"


def build(*programs: str) -> None:
    subprocess.run([ROOT / "scripts/install-dependencies", "tests"], stdout=sys.stderr, check=True)
    subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, stdout=subprocess.DEVNULL, check=True)
    subprocess.run(["cmake", "--build", "--preset", "release", "--parallel", str(os.cpu_count()), "--target",
                    *(f"bin/{program}" for program in programs)], cwd=ROOT, stdout=sys.stderr, check=True)


@contextlib.contextmanager
def folder_of(kept: Path | None) -> Iterator[Path]:
    """The folder that is kept, or else one that is gone afterwards."""
    if kept is not None:
        kept.mkdir(parents=True, exist_ok=True)
        yield kept
        return
    with tempfile.TemporaryDirectory(prefix="farlod-") as name:
        yield Path(name)
