#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Does this build of farlod-pack write the bytes that every other build wrote?

  package_bytes.py check BIN     packs the town and some generated cities with the programs in BIN, and compares their files with the
                                 packages of the newest versions that are here, and with checksums.txt
  package_bytes.py write BIN     writes checksums.txt

Of a manifest, the version of the software and the checksum, which counts it, are left out. Ends with 77 where libraries have other
versions than those that checksums.txt was made with. Far maps of the kind box are compared where Embree takes the same instructions.
"""

import hashlib
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator

sys.dont_write_bytecode = True
import golden  # noqa: E402

TABLE = golden.HERE / "checksums.txt"
EXIT_SKIPPED = 77
SEAL = 29  # bytes at the end of a manifest: docs/package_format.md
HEAD = """# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
# SHA-256 of generated cities, and of the files of their packages: written by package_bytes.py, explained in README.md
"""
MADE_WITH, BOXES_BY = "# Made with ", "boxes by "
# Those that round, trace or compress what is written
LIBRARIES = ("libGeographicLib", "libOpenEXR", "libembree", "libproj", "libz")
# The ending of a city, and the options that make it. Both have overhangs and pitched roofs
CITIES = {
    "straight": (".city.json", ["--size", 200, "--lod", 2, "--overhangs"]),
    "crooked": (".gml", ["--size", 200, "--lod", 2, "--overhangs", "--balconies", "--rotation", 17, "--terrain-relief", 20]),
}
# City, and how it is packed
PACKAGES = {
    "straight_horizon": ("straight", ["--cell", 25]),
    "straight_box": ("straight", ["--cell", 50, "--far-map", "box"]),
    "crooked_horizon": ("crooked", ["--cell", 25]),
    "crooked_whole": ("crooked", ["--cell", 40, "--assign", "whole"]),
    "crooked_box": ("crooked", ["--cell", 50, "--far-map", "box"]),
}


def libraries_of(binaries: pathlib.Path) -> str:
    """With their versions, as the file that a name leads to says them."""
    linked = subprocess.run(["ldd", str(binaries / "farlod-pack")], capture_output=True, text=True, check=True).stdout
    paths = [pathlib.Path(path) for path in re.findall(r"=> (/\S+)", linked)]
    names = {path.resolve().name for path in paths if re.match(r"[A-Za-z]+", path.name).group() in LIBRARIES}
    return ", ".join([" ".join(platform.libc_ver()), *sorted(names)])


def instructions() -> str:
    """Which of its kernels Embree takes on this processor: they round in different ways."""
    flags = set(pathlib.Path("/proc/cpuinfo").read_text().split())
    wanted = {"avx512": {"avx512f", "avx512dq", "avx512cd", "avx512bw", "avx512vl"}, "avx2": {"avx2", "bmi1", "bmi2", "fma"},
              "avx": {"avx"}, "sse4.2": {"sse4_2"}}
    return next((name for name, needed in wanted.items() if needed <= flags), platform.machine())


def contents(path: pathlib.Path) -> bytes:
    """Of a file of a package: what every build must write."""
    data = path.read_bytes()
    if path.name != "manifest.json":
        return data
    return re.sub(rb'"software": "farlod-pack [^"]*"', b'"software": "farlod-pack"', data[:-SEAL], count=1)


def files_of(package: pathlib.Path) -> dict[str, bytes]:
    return {path.relative_to(package).as_posix(): contents(path) for path in sorted(package.rglob("*")) if path.is_file()}


def without_box(files: dict[str, bytes]) -> dict[str, bytes]:
    """The packages of the town were written before manifests had the box of the buildings; those of the cities have it."""
    return {name: re.sub(rb'\n "buildings_box_m": \[[^]]*\],', b"", data) for name, data in files.items()}


def differing(then: dict, now: dict) -> list[str]:
    return sorted(name for name in then.keys() | now.keys() if then.get(name) != now.get(name))


def run(binaries: pathlib.Path, *arguments: object) -> None:
    command = [str(binaries / str(arguments[0])), *map(str, arguments[1:])]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise SystemExit(f"{arguments[0]} ended with {result.returncode}: {result.stderr}")


def check_town(binaries: pathlib.Path, folder: pathlib.Path) -> Iterator[str]:
    for version in range(golden.version_of("format_version"), golden.newest_version() + 1):
        golden.unpack(version, folder / "then")
    (folder / "now").mkdir()
    packages = golden.pack_towns(binaries, folder / "now")
    missing = {then.name for then in (folder / "then").iterdir()} ^ {package.name for package in packages}
    yield from (f"{name}: of one side only" for name in sorted(missing))
    for package in packages:
        if package.name not in missing:
            then, now = files_of(folder / "then" / package.name), without_box(files_of(package))
            yield from (f"{package.name}/{file}" for file in differing(then, now))


def checksums(binaries: pathlib.Path, folder: pathlib.Path) -> dict[str, str]:
    """By the name of a city, or of a file of its package."""
    found = {}
    for city, (ending, options) in CITIES.items():
        path = folder / f"{city}{ending}"
        run(binaries, "farlod-city", "-o", path, *options)
        found[path.name] = hashlib.sha256(path.read_bytes()).hexdigest()
    for name, (city, options) in PACKAGES.items():
        package = folder / f"{name}.farlod"
        run(binaries, "farlod-pack", folder / f"{city}{CITIES[city][0]}", "-o", package, "--quiet", *options)
        found |= {f"{package.name}/{file}": hashlib.sha256(data).hexdigest() for file, data in files_of(package).items()}
    return found


def made_with() -> tuple[str, str]:
    """The libraries and the instructions."""
    return re.search(rf"^{MADE_WITH}(.*); {BOXES_BY}(.*)$", TABLE.read_text(), re.MULTILINE).groups()


def read_table() -> dict[str, str]:
    lines = [line.split("  ") for line in TABLE.read_text().splitlines() if not line.startswith("#")]
    return {name: checksum for checksum, name in lines}


def check(binaries: pathlib.Path) -> None:
    here, (there, boxes_by) = libraries_of(binaries), made_with()
    if here != there:
        print(f"Skipped: checksums.txt was made with {there}, and this is {here}")
        raise SystemExit(EXIT_SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        wrong = [*check_town(binaries, pathlib.Path(folder)), *differing(read_table(), checksums(binaries, pathlib.Path(folder)))]
    compares_boxes = instructions() == boxes_by
    wrong = [name for name in wrong if compares_boxes or "_box" not in name]
    for name in wrong:
        print(f"{name}: other bytes than those of other builds")
    if wrong:
        raise SystemExit(1)
    print(f"The packages of the town and of {len(CITIES)} generated cities have the bytes of all other builds"
          f"{'' if compares_boxes else f', but for far maps of the kind box, which were made with {boxes_by}'}.")


def write(binaries: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        lines = [f"{checksum}  {name}\n" for name, checksum in checksums(binaries, pathlib.Path(folder)).items()]
    TABLE.write_text(HEAD + f"{MADE_WITH}{libraries_of(binaries)}; {BOXES_BY}{instructions()}\n" + "".join(lines))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] in ("check", "write"):
        {"check": check, "write": write}[sys.argv[1]](pathlib.Path(sys.argv[2]))
    else:
        raise SystemExit(__doc__)
