#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Packs cities in QGIS, and compares the packages with those of farlod-pack. qgis_runs.py says how to call it."""
from __future__ import annotations

import json
import pathlib
import shutil

from qgis_runs import (
    algorithm,
    BROKEN,
    features,
    main,
    must,
    point_layer,
    program,
    QgisTest,
    SAMPLES,
    setUpModule,
    WORK,
)


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


if __name__ == "__main__":
    main()
