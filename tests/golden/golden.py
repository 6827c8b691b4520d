#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Packages of each version of the format, and the sky view factors that each of them gives.

  golden.py check BIN     reads each package with the programs in BIN, and compares the values
  golden.py add BIN       packs the town, with trees, with mountains and without both, and hills, with the programs in BIN, and
                          writes the packages of each version that is not here yet
"""

import csv
import itertools
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ENGINES = ["auto", "horizon", "rays", "exact"]
# The only cells with far maps of the packages that are partial: half of a block
AREA = "500025,5500000,500030,5500004"
KINDS = ("horizon", "box")
PARTS = {"": [], "_partial": ["--area", AREA]}
TREES = ["--trees", HERE / "trees.csv", "--canopy", HERE / "canopy.asc"]
# What stands in and around the town, and the parts of KINDS that are packed with it
TOWNS = {"": ([], PARTS), "_trees": (TREES, PARTS), "_mountains": (["--far-terrain", HERE / "mountains.asc"], ["_partial"])}
# Hills, whose far maps are of one kind
HILLS = ["--crs", "EPSG:32632"]
# Another Embree may let one ray of 1,000 go the other way, and points outside of the grid are traced by all engines
TOLERANCE = 0.0011
EXIT_UNUSABLE = 3


def run(binaries: pathlib.Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    command = [str(binaries / str(arguments[0])), *map(str, arguments[1:])]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)


def manifest_of(package: pathlib.Path) -> dict:
    return json.loads((package / "manifest.json").read_text())


def unpack(version: int, folder: pathlib.Path) -> list[pathlib.Path]:
    """The packages of a version, in a folder of the caller's."""
    with zipfile.ZipFile(HERE / f"version_{version}.zip") as archive:
        archive.extractall(folder)
    return sorted(folder.glob("*.farlod"))


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


def pack_towns(binaries: pathlib.Path, folder: pathlib.Path) -> list[pathlib.Path]:
    """The packages of the town by these programs, in a folder of the caller's, each with its version in its name."""
    packages = []

    def pack(file: str, kind: str, part: str, what: str, cell_m: int, options: list) -> None:
        packed = folder / "town.farlod"
        made = run(binaries, "farlod-pack", HERE / file, "-o", packed, "--cell", cell_m, "--neighborhood", 1, "--align", "none",
                   "--far-map", kind, "--quiet", *PARTS[part], *options)
        if made.returncode != 0:
            raise SystemExit(made.stderr)
        packages.append(packed.rename(folder / f"version_{manifest_of(packed)['version']}_{kind}{part}{what}.farlod"))

    for kind, (town, (options, parts)) in itertools.product(KINDS, TOWNS.items()):
        for part in parts:
            pack("town.geojson", kind, part, town, 50, options)
    for part in PARTS:
        pack("relief.asc", "horizon", part, "_relief", 20, HILLS)
    return packages


def add(binaries: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        packages = pack_towns(binaries, folder)
        for version in sorted({re.match(r"version_\d+", package.name).group() for package in packages}):
            if (HERE / f"{version}.zip").exists():
                print(f"packages of {version} are here already")
                continue
            files = [path for package in packages if package.name.startswith(f"{version}_") for path in package.rglob("*")]
            with zipfile.ZipFile(HERE / f"{version}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
                for path in sorted(path for path in files if path.is_file()):
                    archive.write(path, path.relative_to(folder))


def differences(package: pathlib.Path, then: dict[tuple[str, str], dict[str, str]], now: dict[tuple[str, str, str], str]) -> list[str]:
    found = []
    quantities = quantities_of(package)
    expected = {(*key, quantity): row[quantity] for key, row in then.items() for quantity in quantities}
    if expected.keys() != now.keys():
        found.append(f"{package.name}: other points, engines or quantities than in its table")
    for key, was in expected.items():
        value = now.get(key, "nothing")
        numbers = re.fullmatch(r"[0-9.]+", was) and re.fullmatch(r"[0-9.]+", value)
        same = abs(float(was) - float(value)) <= TOLERANCE if numbers else was == value
        if not same:
            found.append(f"{package.name}: {key[0]}, engine {key[1]}, {key[2]}: {was or 'no value'} then, {value or 'no value'} now")
    return found


def check_packages(binaries: pathlib.Path, packages: list[pathlib.Path]) -> list[str]:
    """The same town gives the same values, whatever version it was packed in."""
    found = []
    rows = read_table(HERE / "values.csv")
    for package in packages:
        whole = run(binaries, "farlod-info", package, "--check")
        if whole.returncode != 0:
            found.append(f"{package.name}: {whole.stderr}")
            continue
        kind = re.fullmatch(r"version_\d+_(.*?)(_trees)?", package.stem).group(1)
        then = {(row["point"], row["engine"]): row for row in rows if row["package"] == kind}
        found += differences(package, then, values_of(binaries, package))
    return found


def version_of(name: str) -> int:
    layout = (HERE.parent.parent / "package/layout.hpp").read_text()
    return {name: int(value) for name, value in re.findall(r"uint32_t (\w+_version) = (\d+);", layout)}[name]


def newest_version() -> int:
    """That of a rough surface."""
    return version_of("relief_format_version")


def check_kinds(version: int, packages: list[pathlib.Path]) -> list[str]:
    kinds = [f"version_{version}_{kind}" for kind in (KINDS[:1] if version == newest_version() else KINDS)]
    return [f"no package of {kind}: see README.md" for kind in kinds if not any(p.stem.startswith(kind) for p in packages)]


def check_other_versions(binaries: pathlib.Path, package: pathlib.Path) -> list[str]:
    """Manifests without a checksum, as those before version 8 are, say the older versions and a newer one: each is refused by
    that number."""
    found = []
    manifest = manifest_of(package)
    del manifest["xxh3"]
    for version in (*range(1, version_of("oldest_format_version")), newest_version() + 1):
        (package / "manifest.json").write_text(json.dumps(manifest | {"version": version}))
        table = package.parent / "o.csv"
        for program in (["farlod-info", package, "--check"], ["farlod-svf", package, "-o", table, "--at", "500001,5500022"]):
            result = run(binaries, *program)
            if result.returncode != EXIT_UNUSABLE or f"format version {version}," not in result.stderr:
                found.append(f"version {version} is not refused: {program[0]} ends with {result.returncode}: {result.stderr}")
    return found


def check(binaries: pathlib.Path) -> None:
    found = []
    for version in range(version_of("oldest_format_version"), newest_version() + 1):
        with tempfile.TemporaryDirectory() as folder:
            packages = unpack(version, pathlib.Path(folder))
            found += check_kinds(version, packages) + check_packages(binaries, packages)
            found += [line for package in packages for line in check_other_versions(binaries, package)]
    print("\n".join(found) or "All packages of former versions give what they gave.")
    raise SystemExit(1 if found else 0)


if __name__ == "__main__":
    if sys.argv[1:2] == ["check"] and len(sys.argv) == 3:
        check(pathlib.Path(sys.argv[2]))
    elif sys.argv[1:2] == ["add"] and len(sys.argv) == 3:
        add(pathlib.Path(sys.argv[2]))
    else:
        raise SystemExit(__doc__)
