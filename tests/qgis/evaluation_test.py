#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Computes sky view factors in QGIS, and compares them with those of farlod-svf. qgis_runs.py says how to call it."""
from __future__ import annotations

import json
import pathlib

from qgis_runs import (
    algorithm,
    features,
    main,
    must,
    number,
    pixels,
    point_layer,
    program,
    QgisTest,
    rows,
    SAMPLES,
    setUpModule,
    village_points,
    WORK,
)


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

    def test_views_are_bands(self) -> None:
        self.compare("views", ["--grid", 8, "--rays", 200, "--quantity", "view_sphere,view_eye", "--wall-sectors", 8,
                               "--eye-field", 20.0],
                     STEP=8, RAYS=200, QUANTITIES=["view_sphere", "view_eye"], WALL_SECTORS="8", EYE_FIELD=20.0)
        self.assertEqual(pixels(WORK / "views_qgis.tif")[3], 1 + 13 + 13)

    def test_a_building_is_looked_for(self) -> None:
        self.compare("landmark", ["--grid", 8, "--rays", 200, "--quantity", "view_building", "--sees", "building_0_0_0"],
                     STEP=8, RAYS=200, QUANTITIES=["view_building"], WALL_SECTORS="8", SEES="building_0_0_0")
        self.assertEqual(pixels(WORK / "landmark_qgis.tif")[3], 1 + 2)

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
        self.assertEqual(list(found[0]["properties"]), ["name", "code", "count", "empty", "z_m", "height_above_ground_m", "svf"])
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


if __name__ == "__main__":
    main()
