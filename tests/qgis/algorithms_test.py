#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests the algorithms of the plug-in as qgis_process runs them, and compares what they write with what the programs write.

    tests/qgis/algorithms_test.py PROGRAMS FOLDER [TEST...]

PROGRAMS is the folder of the programs; FOLDER is emptied. Ends with 77 where QGIS is not installed: then ctest skips it.
"""
from __future__ import annotations

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES, BROKEN = ROOT / "datasets" / "samples", ROOT / "datasets" / "broken"
PROGRAMS = WORK = pathlib.Path()
QGIS_PROCESS = ""


def qgis_process() -> str | None:
    """On Debian 12, the script qgis_process hands on an option that the program refuses: then the program itself."""
    path = "/usr/bin:" + os.environ.get("PATH", "")
    return shutil.which("qgis_process.bin", path=path) or shutil.which("qgis_process", path=path)


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


class Pack(QgisTest):
    def test_the_package_is_that_of_the_program(self) -> None:
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, OUTPUT=WORK / "same.farlod")
        self.assertEqual(self.new_names(), ["same.farlod"])
        must("diff", "--recursive", WORK / "village.farlod", WORK / "same.farlod")

    def test_counts_and_problems_are_told(self) -> None:
        odd = BROKEN / "402_self_intersecting.city.json"
        said = algorithm("pack", INPUT=odd, REPORT=WORK / "odd.geojson", OUTPUT=WORK / "odd.farlod")
        self.assertRegex(said, r"WARNING:\s*402 self_intersecting \(repaired\): .*402_self_intersecting.city.json, ")
        self.assertRegex(said, r"BUILDINGS:\s*2\n")
        self.assertRegex(said, r"PROBLEMS:\s*1\n")
        self.assertEqual([feature["properties"]["code"] for feature in features(WORK / "odd.geojson")], [402])
        self.assertEqual(self.new_names(), ["odd.farlod", "odd.geojson"])

    def test_several_files_become_one_city(self) -> None:
        program("farlod-city", "-o", WORK / "bridges.city.json", "--size", 300, "--lod", 2, "--overhangs")
        files = [SAMPLES / "village.gml", WORK / "bridges.city.json"]
        said = algorithm("pack", INPUT=files, OUTPUT=WORK / "both.farlod")
        program("farlod-pack", *files, "-o", WORK / "expected_both.farlod", "--quiet")
        must("diff", "--recursive", WORK / "expected_both.farlod", WORK / "both.farlod")
        self.assertRegex(said, r"Grid: turned by")

    def test_what_obj_files_need(self) -> None:
        output = WORK / "obj.farlod"
        folder = WORK / "objects"
        folder.mkdir()
        shutil.copy(SAMPLES / "village.obj", folder)
        algorithm("pack", INPUT_FOLDER=folder, CRS="EPSG:32632", ORIGIN="10,20", ALIGN="none", NEIGHBORHOOD=5, OUTPUT=output)
        program("farlod-pack", SAMPLES / "village.obj", "--crs", "EPSG:32632", "--origin", "10,20", "--align", "none",
                "--neighborhood", 5, "-o", WORK / "expected_obj.farlod", "--quiet")
        must("diff", "--recursive", WORK / "expected_obj.farlod", output)

    def test_a_package_is_replaced_only_on_request(self) -> None:
        output = WORK / "again.farlod"
        algorithm("pack", INPUT=SAMPLES / "village.gml", OUTPUT=output)
        said = algorithm("pack", INPUT=SAMPLES / "village.gml", OUTPUT=output, CELL=40, must_fail=True)
        self.assertIn("exists already", said)
        algorithm("pack", INPUT=SAMPLES / "village.gml", OUTPUT=output, CELL=40, OVERWRITE=True)
        must("diff", "--recursive", WORK / "village.farlod", output)


class Area(QgisTest):
    QUARTER, REST = "550000,550030,5499960,5499990", "549900,550200,5499900,5500200"

    def test_far_maps_are_made_for_an_extent_and_added_for_another(self) -> None:
        output = WORK / "area.farlod"
        settings = {"INPUT": SAMPLES / "village.gml", "CELL": 40, "OUTPUT": output}
        algorithm("pack", AREA_EXTENT=f"{self.QUARTER} [EPSG:32632]", **settings)
        facts = json.loads(program("farlod-info", output, "--json"))
        self.assertLess(facts["far_map"]["cells"], facts["grid"]["cell_count"])
        said = algorithm("pack", AREA_EXTENT=f"{self.REST} [EPSG:32632]", **{**settings, "INPUT": SAMPLES / "village.obj"},
                         CRS="EPSG:32632", must_fail=True)
        self.assertIn("farlod-pack: ", said)
        algorithm("pack", AREA_EXTENT=f"{self.REST} [EPSG:32632]", **settings)
        must("diff", "--recursive", WORK / "village.farlod", output)
        self.assertEqual(self.new_names(), ["area.farlod"])

    def test_a_layer_may_say_where(self) -> None:
        station = WORK / "station.geojson"
        station.write_text(point_layer([{"coordinates": [9.6925, 49.6500]}]))
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, AREA_LAYER=station, OUTPUT=WORK / "station.farlod")
        program("farlod-pack", SAMPLES / "village.gml", "--cell", 40, "--area", station,
                "-o", WORK / "expected_station.farlod", "--quiet")
        must("diff", "--recursive", WORK / "expected_station.farlod", WORK / "station.farlod")


class Footprints(QgisTest):
    def test_a_layer_gives_what_its_file_gives(self) -> None:
        # A GeoPackage may have several layers, so the layer that was chosen is saved; a GeoJSON file is read as it is
        two = WORK / "two.gpkg"
        must("ogr2ogr", two, SAMPLES / "village.geojson", "-nln", "others", "-where", "height > 15")
        must("ogr2ogr", "-update", two, SAMPLES / "village.geojson", "-nln", "chosen")
        program("farlod-pack", SAMPLES / "village.geojson", "--height-field", "height", "--base-field", "base",
                "-o", WORK / "expected_layer.farlod", "--quiet")
        for name, layer in {"geojson": SAMPLES / "village.geojson", "gpkg": f"{two}|layername=chosen"}.items():
            output = WORK / f"{name}.farlod"
            algorithm("pack", FOOTPRINTS=layer, HEIGHT_FIELD="height", BASE_FIELD="base", OUTPUT=output)
            must("diff", "--recursive", WORK / "expected_layer.farlod" / "blocks", output / "blocks")

    def test_a_terrain_is_read(self) -> None:
        terrain = WORK / "terrain.asc"
        rows_of_heights = "\n".join(" ".join(str(column / 2) for column in range(40)) for _ in range(40))
        head = "ncols 40\nnrows 40\nxllcorner 549850\nyllcorner 5499850\ncellsize 10\n"
        terrain.write_text(head + rows_of_heights + "\n")
        terrain.with_suffix(".prj").write_text(must("gdalsrsinfo", "-o", "wkt1_esri", "EPSG:32632"))
        algorithm("pack", FOOTPRINTS=SAMPLES / "village.geojson", HEIGHT_FIELD="height", TERRAIN=terrain,
                  OUTPUT=WORK / "hilly.farlod")
        program("farlod-pack", SAMPLES / "village.geojson", "--height-field", "height", "--terrain", terrain,
                "-o", WORK / "expected_hilly.farlod", "--quiet")
        must("diff", "--recursive", WORK / "expected_hilly.farlod", WORK / "hilly.farlod")
        west, east, around = WORK / "west.tif", WORK / "east.tif", WORK / "around.tif"
        must("gdal_translate", "-srcwin", 0, 0, 21, 40, terrain, west)
        must("gdal_translate", "-srcwin", 19, 0, 21, 40, terrain, east)
        must("gdal_translate", "-a_ullr", 545000, 5505000, 555000, 5495000, terrain, around)
        algorithm("pack", FOOTPRINTS=SAMPLES / "village.geojson", HEIGHT_FIELD="height", TERRAIN=[west, east], FAR_TERRAIN=around,
                  OUTPUT=WORK / "tiles.farlod")
        program("farlod-pack", SAMPLES / "village.geojson", "--height-field", "height", "--terrain", west, "--terrain", east,
                "--far-terrain", around, "-o", WORK / "expected_tiles.farlod", "--quiet")
        must("diff", "--recursive", WORK / "expected_tiles.farlod", WORK / "tiles.farlod")


class Trees(QgisTest):
    TREES = "id,x,y,KRONE,H\n1,550010,5499990,4,9\n2,550030,5499990,6,12\n"

    def packed(self, name: str, *options: object) -> pathlib.Path:
        output = WORK / f"expected_{name}.farlod"
        program("farlod-pack", SAMPLES / "village.gml", "--cell", 40, *options, "-o", output, "--quiet")
        return output

    def test_a_layer_gives_what_its_file_gives(self) -> None:
        table, layer = WORK / "trees.csv", WORK / "trees.geojson"
        table.write_text(self.TREES)
        must("ogr2ogr", layer, table, "-oo", "X_POSSIBLE_NAMES=x", "-oo", "Y_POSSIBLE_NAMES=y", "-oo", "AUTODETECT_TYPE=YES",
             "-a_srs", "EPSG:32632")
        expected = self.packed("trees", "--trees", layer, "--tree-height-field", "H", "--crown-field", "KRONE")
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, TREES=layer, TREE_HEIGHT_FIELD="H", CROWN_FIELD="KRONE",
                  OUTPUT=WORK / "trees.farlod")
        must("diff", "--recursive", expected, WORK / "trees.farlod")
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, TREE_FILES=table, TREE_HEIGHT_FIELD="H", CROWN_FIELD="KRONE",
                  OUTPUT=WORK / "table.farlod")
        must("cmp", expected / "crowns.bin", WORK / "table.farlod" / "crowns.bin")

    def test_canopies_are_read(self) -> None:
        tops, trunks = WORK / "tops.asc", WORK / "trunks.asc"
        head = "ncols 3\nnrows 2\nxllcorner 550000\nyllcorner 5499990\ncellsize 2\n"
        tops.write_text(head + "0 8 9\n7 6 0\n")
        trunks.write_text(head + "0 2 3\n2 1 0\n")
        for raster in (tops, trunks):
            raster.with_suffix(".prj").write_text(must("gdalsrsinfo", "-o", "wkt1_esri", "EPSG:32632"))
        expected = self.packed("canopy", "--canopy", tops, "--trunk", trunks, "--canopy-absolute")
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, CANOPY=tops, TRUNK=trunks, CANOPY_ABSOLUTE=True,
                  OUTPUT=WORK / "canopy.farlod")
        must("diff", "--recursive", expected, WORK / "canopy.farlod")
        expected = self.packed("ratio", "--canopy", tops, "--trunk-ratio", 0.5)
        algorithm("pack", INPUT=SAMPLES / "village.gml", CELL=40, CANOPY=tops, TRUNK_RATIO=0.5, OUTPUT=WORK / "ratio.farlod")
        must("diff", "--recursive", expected, WORK / "ratio.farlod")


class Raster(QgisTest):
    def compare(self, name: str, options: list[object], **parameters: object) -> str:
        ours, theirs = WORK / f"{name}_qgis.tif", WORK / f"{name}.tif"
        said = algorithm("raster", PACKAGE=WORK / "village.farlod", OUTPUT=ours, **parameters)
        program("farlod-svf", WORK / "village.farlod", "-o", theirs, "--quiet", *options)
        self.assertEqual(pixels(ours), pixels(theirs))
        return said

    def test_pixels_are_those_of_the_program(self) -> None:
        said = self.compare("plain", ["--grid", 2, "--summary", WORK / "summary.json"], STEP=2)
        mean = json.loads((WORK / "summary.json").read_text())["svf"]["mean"]
        self.assertRegex(said, rf"SVF_MEAN:\s*{mean:.6g}")
        self.assertEqual([name for name in self.new_names() if name.startswith("plain_qgis")], ["plain_qgis.tif"])

    def test_the_default_is_that_of_the_program(self) -> None:
        self.compare("default", ["--grid", 2, "--height", 1.5])

    def test_options_arrive(self) -> None:
        self.compare("roofs", ["--grid", 4, "--on-surface", "--height", 0.05, "--bounds", "--azimuths", 64, "--sky", "solid"],
                     STEP=4, ON_SURFACE=True, HEIGHT=0.05, BOUNDS=True, AZIMUTHS=64, SKY="solid")
        self.compare("rays", ["--grid", 8, "--engine", "rays", "--rays", 200], STEP=8, ENGINE="rays", RAYS=200)
        self.compare("error", ["--grid", 8, "--max-error", 0.02, "--bounds"], STEP=8, MAX_ERROR=0.02, BOUNDS=True)
        said = self.compare("verified", ["--grid", 8], STEP=8, VERIFY=20)
        self.assertIn("Errors against exact (20 random receivers", said)

    def test_further_quantities_are_bands(self) -> None:
        self.compare("more", ["--grid", 8, "--quantity", "directional,sky_patches,sunlit", "--sky-patches", 577, "--horizons", 12,
                              "--sun", "2026-06-21"],
                     STEP=8, QUANTITIES=["directional", "sky_patches", "sunlit"], SKY_PATCHES=577, HORIZONS=12, SUN="2026-06-21")
        self.assertEqual(pixels(WORK / "more_qgis.tif")[3], 1 + 4 + 577 + 12 + 1)

    def test_extent_and_mask_choose_pixels(self) -> None:
        self.compare("box", ["--grid", 2, "--bbox", "550000,5499950,550040,5499990"], STEP=2,
                     EXTENT="550000,550040,5499950,5499990 [EPSG:32632]")
        must("ogr2ogr", WORK / "mask.gpkg", SAMPLES / "village.geojson", "-t_srs", "EPSG:4326", "-where", "height > 15")
        self.compare("mask", ["--grid", 2, "--on-surface", "--mask", WORK / "mask.gpkg"], STEP=2, ON_SURFACE=True,
                     MASK=WORK / "mask.gpkg")
        # 0.001° are some 70 m: the box around them in the package's CRS
        algorithm("raster", PACKAGE=WORK / "village.farlod", STEP=2, EXTENT="9.6920,9.6930,49.6500,49.6505 [EPSG:4326]",
                  OUTPUT=WORK / "degrees.tif")
        size = json.loads(must("gdalinfo", "-json", WORK / "degrees.tif"))["size"]
        self.assertTrue(30 <= size[0] <= 45 and 20 <= size[1] <= 40, size)

    def test_pixels_of_another_raster(self) -> None:
        must("gdal_create", "-outsize", 20, 10, "-a_srs", "EPSG:32632", "-a_ullr", 550000.5, 5500000, 550040.5, 5499980,
             WORK / "model.tif")
        self.compare("like", ["--grid-like", WORK / "model.tif"], LIKE=WORK / "model.tif")

    def test_other_formats(self) -> None:
        algorithm("raster", PACKAGE=WORK / "village.farlod", STEP=8, OUTPUT=WORK / "map.asc")
        program("farlod-svf", WORK / "village.farlod", "-o", WORK / "expected.asc", "--grid", 8, "--quiet")
        self.assertEqual((WORK / "map.asc").read_text(), (WORK / "expected.asc").read_text())
        self.assertEqual((WORK / "map.prj").read_text(), (WORK / "expected.prj").read_text())


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


class Points(QgisTest):
    def compare(self, points: pathlib.Path, options: list[object], columns: list[str], **parameters: object) -> list[dict]:
        """The features, whose `columns` are those of the program, row by row."""
        ours, theirs = WORK / f"{points.stem}_qgis.gpkg", WORK / f"{points.stem}.csv"
        algorithm("points", PACKAGE=WORK / "village.farlod", INPUT=points, OUTPUT=ours, **parameters)
        program("farlod-svf", WORK / "village.farlod", "-o", theirs, "--points", points, "--quiet", *options)
        found, expected = features(ours), rows(theirs)
        self.assertEqual(
            [[feature["properties"][column] for column in columns] for feature in found],
            [[number(row[column]) for column in columns] for row in expected],
        )
        return found

    def test_answers_come_back_beside_all_attributes(self) -> None:
        points = village_points("plain.geojson", {"code": "007", "count": 3, "empty": None})
        found = self.compare(points, [], ["svf", "z_m"])
        known = [feature["properties"]["svf"] for feature in found]
        self.assertIn(None, known, "a place inside of a building")
        self.assertGreater(len([value for value in known if value is not None]), 40)
        given = json.loads(points.read_text())["features"]
        for feature, before in zip(found, given):
            self.assertEqual({**feature["properties"], **before["properties"]}, feature["properties"])
            for place, expected in zip(feature["geometry"]["coordinates"], before["geometry"]["coordinates"]):
                self.assertAlmostEqual(place, expected, places=9)
        self.assertEqual(list(found[0]["properties"]), ["name", "code", "count", "empty", "z_m", "svf"])
        self.assertIn('ID["EPSG",4326]', must("ogrinfo", "-so", "-al", WORK / "plain_qgis.gpkg"))

    def test_options_arrive(self) -> None:
        options = ["--height", 3, "--on-surface", "--bounds", "--quantity", "directional,hidden", "--horizons", 8]
        columns = ["svf", "svf_low", "svf_high", "svfN", "svfW", "hidden_far", "horizon_000", "horizon_315"]
        self.compare(village_points("more.geojson"), options, columns, HEIGHT=3, ON_SURFACE=True, BOUNDS=True,
                     QUANTITIES=["directional", "hidden"], HORIZONS=8)

    def test_normals_are_taken_from_fields(self) -> None:
        points = village_points("normals.geojson", {"azimuth": 120.0, "tilt": 90.0})
        found = self.compare(points, [], ["svf", "z_m"], AZIMUTH_FIELD="azimuth", TILT_FIELD="tilt")
        self.assertLess(max(feature["properties"]["svf"] or 0.0 for feature in found), 0.51)
        algorithm("points", PACKAGE=WORK / "village.farlod", INPUT=points, OUTPUT=WORK / "up.gpkg")
        self.assertGreater(max(feature["properties"]["svf"] or 0.0 for feature in features(WORK / "up.gpkg")), 0.9)

    def test_z_is_a_height_unless_it_is_not(self) -> None:
        points = village_points("high.geojson", height_m=30.0)
        found = self.compare(points, [], ["svf", "z_m"])
        self.assertEqual({feature["properties"]["z_m"] for feature in found} - {None}, {30.0})
        algorithm("points", PACKAGE=WORK / "village.farlod", INPUT=points, USE_Z=False, OUTPUT=WORK / "low.gpkg")
        low = features(WORK / "low.gpkg")
        self.assertEqual({feature["properties"]["z_m"] for feature in low} - {None}, {1.5})
        self.assertEqual(low[0]["geometry"]["coordinates"][2], 30.0)

    def test_a_column_that_is_there_already_stays(self) -> None:
        found = algorithm("points", PACKAGE=WORK / "village.farlod", OUTPUT=WORK / "twice_qgis.gpkg",
                          INPUT=village_points("twice.geojson", {"SVF": 7.0, "fid": 5}))
        self.assertRegex(found, "OUTPUT:")
        properties = features(WORK / "twice_qgis.gpkg")[0]["properties"]
        self.assertEqual(properties["SVF"], 7.0)
        self.assertLess(properties["svf_2"], 1.0)

    def test_features_of_several_points_and_of_none(self) -> None:
        single = json.loads(village_points("single.geojson").read_text())["features"]
        one, other = [feature["geometry"]["coordinates"] for feature in single[1:3]]
        several = WORK / "several.geojson"
        several.write_text(
            point_layer([{"name": "two", "coordinates": [one, other]}, {"name": "none"}, {"name": "one", "coordinates": [one]}])
        )
        algorithm("points", PACKAGE=WORK / "village.farlod", INPUT=several, OUTPUT=WORK / "several.gpkg")
        found = features(WORK / "several.gpkg")
        self.assertEqual([feature["properties"]["name"] for feature in found], ["two", "two", "none", "one"])
        values = [feature["properties"]["svf"] for feature in found]
        self.assertIsNone(values[2])
        self.assertIsNone(found[2]["geometry"])
        self.assertEqual(values[0], values[3])
        self.assertNotEqual(values[0], values[1])


class Surfaces(QgisTest):
    def compare(self, name: str, options: list[object], **parameters: object) -> str:
        layers = ["receivers", "surfaces", "buildings"]
        outputs = {layer.upper(): WORK / f"{name}_{layer}.gpkg" for layer in layers}
        said = algorithm("surfaces", PACKAGE=WORK / "village.farlod", **outputs, **parameters)
        program("farlod-svf", WORK / "village.farlod", "-o", WORK / f"{name}.csv", "--quiet", *options)
        for layer, file in zip(layers, [f"{name}.csv", f"{name}.surfaces.csv", f"{name}.buildings.csv"]):
            expected = rows(WORK / file)
            found = [feature["properties"] for feature in features(outputs[layer.upper()])]
            self.assertGreater(len(found), 20)
            self.assertEqual(len(found), len(expected))
            for ours, theirs in zip(found, expected):
                self.compare_row(ours, theirs)
        return said

    # Of further quantities, a GeoPackage has all digits of a float, and CSV has seven
    SEVENTH_DIGIT = 1e-7

    def compare_row(self, ours: dict, theirs: dict[str, str]) -> None:
        self.assertEqual([key for key in ours if key != "fid"], list(theirs))
        for key, text in theirs.items():
            if key in ("building", "kind") or not text:
                self.assertEqual(ours[key] or "", text)
            else:
                self.assertAlmostEqual(ours[key], float(text), delta=self.SEVENTH_DIGIT)

    def test_walls(self) -> None:
        said = self.compare("walls", ["--surfaces", "walls", "--spacing", 2])
        self.assertRegex(said, r"SVF_MAX:\s*0\.4999")
        place = features(WORK / "walls_receivers.gpkg")[0]["geometry"]["coordinates"]
        self.assertEqual(len(place), 3)

    def test_options_arrive(self) -> None:
        self.compare("all", ["--surfaces", "all", "--spacing", 4, "--bounds", "--quantity", "svf_solid", "--azimuths", 64],
                     WHICH="all", SPACING=4, BOUNDS=True, QUANTITIES="svf_solid", AZIMUTHS=64)

    def test_extent_chooses_receivers(self) -> None:
        self.compare("box", ["--surfaces", "walls", "--spacing", 1, "--bbox", "549920,5499920,550080,5500080"], SPACING=1,
                     EXTENT="549920,550080,5499920,5500080 [EPSG:32632]")

    def test_what_is_not_wanted_is_not_written(self) -> None:
        said = algorithm("surfaces", PACKAGE=WORK / "village.farlod", WHICH="roofs", BUILDINGS=WORK / "alone.gpkg")
        self.assertEqual(self.new_names(), ["alone.gpkg"])
        self.assertNotIn("RECEIVERS:\t/", said)


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


def main() -> None:
    global PROGRAMS, WORK, QGIS_PROCESS
    if len(sys.argv) < 3:
        sys.exit("usage: tests/qgis/algorithms_test.py PROGRAMS FOLDER [TEST...]")
    QGIS_PROCESS = qgis_process() or ""
    if not QGIS_PROCESS:
        print("skipped: qgis_process is not installed (scripts/install-dependencies qgis)")
        sys.exit(77)
    PROGRAMS, WORK = (pathlib.Path(argument).absolute() for argument in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])


if __name__ == "__main__":
    main()
