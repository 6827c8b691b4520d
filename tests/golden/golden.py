#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of each version of the format, and the sky view factors that they gave when they were made.

  golden.py check BIN          reads each package with the programs in BIN, and compares the values
  golden.py add BIN FOLDER     packs the town, without trees and with them, with the programs in BIN, and writes the packages whose
                               version FOLDER has not yet, and their values, to FOLDER
"""

import csv
import itertools
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ENGINES = ["auto", "horizon", "rays", "exact"]
# The only cells with far maps of the packages that are partial: half of a block
AREA = "500025,5500000,500030,5500004"
KINDS = ("horizon", "box")
PARTS = {"": [], "_partial": ["--area", AREA]}
TREES = ["--trees", HERE / "trees.csv", "--canopy", HERE / "canopy.asc"]
CANOPIES = ([], TREES)
# Another Embree may let one ray of 1,000 go the other way, and points outside of the grid are traced by all engines
TOLERANCE = 0.0011
EXIT_UNUSABLE = 3


def run(binaries: pathlib.Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    command = [str(binaries / str(arguments[0])), *map(str, arguments[1:])]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)


def manifest_of(package: pathlib.Path) -> dict:
    return json.loads((package / "manifest.json").read_text())


def quantities_of(package: pathlib.Path) -> list[str]:
    return ["svf", "svf_total"] if "canopy" in manifest_of(package) else ["svf"]


def values_of(binaries: pathlib.Path, package: pathlib.Path) -> dict[tuple[str, str, str], str]:
    """Each quantity of each point by each engine; "" where it has none, "refused" where the engine refuses the package."""
    values = {}
    quantities = quantities_of(package)
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "values.csv"
        for engine in ENGINES:
            result = run(binaries, "farlod-svf", package, "-o", table, "--points", HERE / "points.csv", "--points-crs",
                         "EPSG:32632", "--engine", engine, "--quantity", ",".join(quantities), "--quiet")
            if result.returncode not in (0, EXIT_UNUSABLE):
                raise SystemExit(f"{package.name}, engine {engine}: exit code {result.returncode}: {result.stderr}")
            names = [row["id"] for row in read_table(HERE / "points.csv")]
            refused = [{"id": n} | dict.fromkeys(quantities, "refused") for n in names]
            answers = read_table(table) if result.returncode == 0 else refused
            values.update({(row["id"], engine, quantity): row[quantity] for row in answers for quantity in quantities})
    return values


def read_table(path: pathlib.Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def pack_town(binaries: pathlib.Path, kind: str, part: str, trees: list, packed: pathlib.Path) -> None:
    made = run(binaries, "farlod-pack", HERE / "town.geojson", "-o", packed, "--cell", 50, "--neighborhood", 1, "--align", "none",
               "--far-map", kind, "--quiet", *PARTS[part], *trees)
    if made.returncode != 0:
        raise SystemExit(made.stderr)


def add(binaries: pathlib.Path, folder: pathlib.Path) -> None:
    there = versions_in(folder)
    for kind, part, trees in itertools.product(KINDS, PARTS, CANOPIES):
        with tempfile.TemporaryDirectory() as work:
            packed = pathlib.Path(work) / "town.farlod"
            pack_town(binaries, kind, part, trees, packed)
            version = manifest_of(packed)["version"]
            if version in there:
                continue
            name = f"version_{version}_{kind}{part}{'_trees' if trees else ''}"
            shutil.copytree(packed, folder / f"{name}.farlod")
            write_values(folder / f"{name}.csv", values_of(binaries, packed), quantities_of(packed))


def versions_in(folder: pathlib.Path) -> set[int]:
    return {int(path.name.split("_")[1]) for path in folder.glob("version_*.farlod")}


def write_values(path: pathlib.Path, values: dict[tuple[str, str, str], str], quantities: list[str]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["point", "engine", *quantities])
        for point, engine in dict.fromkeys((point, engine) for point, engine, _ in values):
            writer.writerow([point, engine, *(values[point, engine, quantity] for quantity in quantities)])


def differences(package: pathlib.Path, values: dict[tuple[str, str, str], str]) -> list[str]:
    found = []
    rows = read_table(package.with_suffix(".csv"))
    expected = {(row["point"], row["engine"], quantity): row[quantity] for row in rows for quantity in list(row)[2:]}
    if expected.keys() != values.keys():
        found.append(f"{package.name}: other points, engines or quantities than in its table")
    for key, was in expected.items():
        now = values.get(key, "nothing")
        numbers = re.fullmatch(r"[0-9.]+", was) and re.fullmatch(r"[0-9.]+", now)
        same = abs(float(was) - float(now)) <= TOLERANCE if numbers else was == now
        if not same:
            found.append(f"{package.name}: {key[0]}, engine {key[1]}, {key[2]}: {was or 'no value'} then, {now or 'no value'} now")
    return found


def check_packages(binaries: pathlib.Path) -> list[str]:
    found = []
    for package in sorted(HERE.glob("*.farlod")):
        whole = run(binaries, "farlod-info", package, "--check")
        if whole.returncode != 0:
            found.append(f"{package.name}: {whole.stderr}")
            continue
        found += differences(package, values_of(binaries, package))
    return found


def version_of(name: str) -> int:
    layout = (HERE.parent.parent / "package/layout.hpp").read_text()
    return {name: int(value) for name, value in re.findall(r"uint32_t (\w+_version) = (\d+);", layout)}[name]


def check_all_versions_are_there() -> list[str]:
    versions = range(version_of("oldest_format_version"), version_of("format_version") + 1)
    names = [f"version_{version}_{kind}" for version in versions for kind in KINDS]
    there = [path.stem for path in HERE.glob("*.farlod")]
    return [f"no package of {name}: see README.md" for name in names if not any(t.startswith(name) for t in there)]


def check_other_versions(binaries: pathlib.Path) -> list[str]:
    """Manifests without a checksum, as those before version 8 are, say the older versions and a newer one: each is refused by
    that number."""
    found = []
    oldest, newer = version_of("oldest_format_version"), version_of("format_version") + 1
    for source, version in itertools.product((f"version_{oldest}_horizon", f"version_{oldest}_box_partial"), (*range(1, oldest), newer)):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder) / "other.farlod"
            shutil.copytree(HERE / f"{source}.farlod", package)
            manifest = manifest_of(package) | {"version": version}
            del manifest["xxh3"]
            (package / "manifest.json").write_text(json.dumps(manifest))
            for program in (["farlod-info", package, "--check"], ["farlod-svf", package, "-o", f"{folder}/o.csv", "--at", "500001,5500022"]):
                result = run(binaries, *program)
                if result.returncode != EXIT_UNUSABLE or f"format version {version}," not in result.stderr:
                    found.append(f"version {version} is not refused: {program[0]} ends with {result.returncode}: {result.stderr}")
    return found


def check(binaries: pathlib.Path) -> None:
    found = check_all_versions_are_there() + check_packages(binaries) + check_other_versions(binaries)
    print("\n".join(found) or "All packages of former versions give what they gave.")
    raise SystemExit(1 if found else 0)


if __name__ == "__main__":
    if sys.argv[1:2] == ["check"] and len(sys.argv) == 3:
        check(pathlib.Path(sys.argv[2]))
    elif sys.argv[1:2] == ["add"] and len(sys.argv) == 4:
        add(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
    else:
        raise SystemExit(__doc__)
