# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the algorithms of the plug-in as qgis_process does, for the tests beside this file:

    tests/qgis/NAME_test.py PROGRAMS FOLDER [TEST...]

PROGRAMS is the folder of the programs; FOLDER is emptied. Ends with 77 where QGIS is not installed: then ctest skips it.
"""
from __future__ import annotations

import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

if len(sys.argv) < 3:
    sys.exit(f"usage: {sys.argv[0]} PROGRAMS FOLDER [TEST...]")
ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES, BROKEN = ROOT / "datasets" / "samples", ROOT / "datasets" / "broken"
PROGRAMS, WORK = (pathlib.Path(argument).absolute() for argument in sys.argv[1:3])


def qgis_process() -> str | None:
    """On Debian 12, the script qgis_process hands on an option that the program refuses: then the program itself."""
    path = "/usr/bin:" + os.environ.get("PATH", "")
    return shutil.which("qgis_process.bin", path=path) or shutil.which("qgis_process", path=path)


QGIS_PROCESS = qgis_process() or ""


def environment() -> dict[str, str]:
    """A profile of its own, no window, and the Python of the distribution, which QGIS is built with."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "QGIS", "FARLOD"))}
    return {
        **kept,
        "PATH": "/usr/bin:/bin:" + kept.get("PATH", ""),
        "QT_QPA_PLATFORM": "offscreen",
        "QGIS_CUSTOM_CONFIG_PATH": str(WORK / "profile"),
        "XDG_RUNTIME_DIR": str(WORK),
        "HOME": str(WORK),
        "PYTHONDONTWRITEBYTECODE": "1",
        "FARLOD_BIN": str(PROGRAMS),
        "LC_ALL": "C.UTF-8",
    }


def run(*command: object, **more: str) -> subprocess.CompletedProcess:
    words = [str(word) for word in command]
    return subprocess.run(words, cwd=WORK, env={**environment(), **more}, capture_output=True, text=True, timeout=300)


def must(*command: object) -> str:
    done = run(*command)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def program(name: str, *arguments: object) -> str:
    return must(PROGRAMS / name, *arguments)


def algorithm(name: str, *, must_fail: bool = False, **parameters: object) -> str:
    """What qgis_process says. A list is several values of one parameter."""
    words = []
    for key, value in parameters.items():
        words += [f"{key}={entry}" for entry in (value if isinstance(value, list) else [value])]
    done = run(QGIS_PROCESS, "run", f"farlod:{name}", "--", *words)
    said = done.stdout + done.stderr
    if (done.returncode != 0) != must_fail:
        raise AssertionError(f"farlod:{name} ended with exit code {done.returncode}\n{said}")
    return said


def features(path: pathlib.Path, layer: str = "") -> list[dict]:
    text = must("ogr2ogr", "-f", "GeoJSON", "/vsistdout/", path, *([layer] if layer else []))
    return json.loads(text)["features"]


def pixels(path: pathlib.Path) -> tuple[bytes, list[float], str, int]:
    """The raw values of all bands, where they lie, and in which CRS."""
    raw = WORK / "pixels.bin"
    must("gdal_translate", "-quiet", "-of", "ENVI", path, raw)
    facts = json.loads(must("gdalinfo", "-json", path))
    return raw.read_bytes(), facts["geoTransform"], facts["coordinateSystem"]["wkt"], len(facts["bands"])


def rows(path: pathlib.Path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def number(text: str) -> float | None:
    return float(text) if text else None


def setUpModule() -> None:
    shutil.rmtree(WORK, ignore_errors=True)
    plug_ins = WORK / "profile" / "profiles" / "default" / "python" / "plugins"
    plug_ins.mkdir(parents=True)
    WORK.chmod(0o700)  # Qt wants it of a folder that is XDG_RUNTIME_DIR
    (plug_ins / "farlod").symlink_to(ROOT / "qgis" / "farlod")
    must(QGIS_PROCESS, "plugins", "enable", "farlod")
    program("farlod-pack", SAMPLES / "village.gml", "-o", WORK / "village.farlod", "--cell", 40, "--quiet")


class QgisTest(unittest.TestCase):
    def setUp(self) -> None:
        self.before = set(WORK.iterdir())

    def new_names(self) -> list[str]:
        return sorted(path.name for path in set(WORK.iterdir()) - self.before)


def point_layer(points: list[dict]) -> str:
    """GeoJSON of features that may have `coordinates` (of a point, or of several), and attributes."""
    entries = []
    for point in points:
        properties = {key: value for key, value in point.items() if key != "coordinates"}
        places = point.get("coordinates")
        kind = "MultiPoint" if places and isinstance(places[0], list) else "Point"
        geometry = {"type": kind, "coordinates": places} if places else None
        entries.append({"type": "Feature", "properties": properties, "geometry": geometry})
    return json.dumps({"type": "FeatureCollection", "features": entries})


def village_points(name: str, attributes: dict | None = None, height_m: float | None = None) -> pathlib.Path:
    """Places all over the village and beside it, in degrees; some lie inside of buildings."""
    places = [[549905 + 23.0 * column, 5499905 + 19.0 * row] for row in range(9) for column in range(9)]
    places.append([552000.0, 5502000.0])
    lines = "\n".join(f"{x} {y}" for x, y in places)
    command = ["gdaltransform", "-s_srs", "EPSG:32632", "-t_srs", "EPSG:4326", "-output_xy"]
    done = subprocess.run(command, input=lines, env=environment(), capture_output=True, text=True, check=True)
    degrees = [[float(number) for number in line.split()] for line in done.stdout.splitlines()]
    z = [] if height_m is None else [height_m]
    path = WORK / name
    more = attributes or {}
    path.write_text(
        point_layer([{"name": f"Straße {n}, Ost", "coordinates": place + z, **more} for n, place in enumerate(degrees)])
    )
    return path


def main() -> None:
    if not QGIS_PROCESS:
        print("skipped: qgis_process is not installed (scripts/install-dependencies qgis)")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
