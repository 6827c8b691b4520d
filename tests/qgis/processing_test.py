#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Tests the algorithms within a QGIS without a window, as its dialogues and models call them: layers of a project, the option of
Processing, progress, Cancel, and the style of a map.

    tests/qgis/processing_test.py PROGRAMS FOLDER

PROGRAMS is the folder of the programs; FOLDER is emptied. Ends with 77 where PyQGIS is not installed: then ctest skips it.
"""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ.pop("FARLOD_BIN", None)
sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = ["/usr/share/qgis/python/plugins", str(ROOT / "qgis")]
try:
    from qgis.core import (
        QgsApplication,
        QgsProcessingContext,
        QgsProcessingException,
        QgsProcessingFeatureSourceDefinition,
        QgsProcessingFeedback,
        QgsProject,
        QgsRasterLayer,
        QgsVectorLayer,
    )
except ImportError:
    print("skipped: PyQGIS is not installed (scripts/install-dependencies qgis)")
    sys.exit(77)

SAMPLES = ROOT / "datasets" / "samples"
PROGRAMS = WORK = pathlib.Path()


class Feedback(QgsProcessingFeedback):
    """Notes what it is told, and cancels at the first progress of a stage."""

    def __init__(self, cancels_in: str = "") -> None:
        super().__init__(False)
        self.cancels_in, self.stage = cancels_in, ""
        self.stages: list[str] = []
        self.percents: list[float] = []
        self.progressChanged.connect(self.note)

    def setProgressText(self, text: str) -> None:
        self.stage = text
        self.stages.append(text)

    def note(self, percent: float) -> None:
        self.percents.append(percent)
        if self.cancels_in and self.stage == self.cancels_in:
            self.cancel()


def program(name: str, *arguments: object) -> None:
    subprocess.run([PROGRAMS / name, *map(str, arguments), "--quiet"], check=True)


class ProcessingTest(unittest.TestCase):
    def setUp(self) -> None:
        self.before = set(WORK.iterdir())

    def new_names(self) -> list[str]:
        return sorted(path.name for path in set(WORK.iterdir()) - self.before)

    def run_algorithm(self, name: str, feedback: QgsProcessingFeedback | None = None, context: QgsProcessingContext | None = None,
                      **parameters: object) -> dict:
        given = {key: str(value) if isinstance(value, pathlib.Path) else value for key, value in parameters.items()}
        return processing.run(f"farlod:{name}", given, feedback=feedback or Feedback(), context=context)


class Projects(ProcessingTest):
    def footprints(self) -> QgsVectorLayer:
        layer = QgsVectorLayer(str(SAMPLES / "village.geojson"), "village", "ogr")
        self.assertTrue(layer.isValid())
        QgsProject.instance().addMapLayer(layer)
        self.addCleanup(QgsProject.instance().removeMapLayer, layer.id())
        return layer

    def packed(self, **parameters: object) -> int:
        output = WORK / "layer.farlod"
        return self.run_algorithm("pack", HEIGHT_FIELD="height", OVERWRITE=True, OUTPUT=output, **parameters)["BUILDINGS"]

    def test_what_a_layer_shows_is_packed(self) -> None:
        layer = self.footprints()
        self.assertEqual(self.packed(FOOTPRINTS=layer), 32)
        layer.setSubsetString("height > 15")
        tall = layer.featureCount()
        self.assertTrue(0 < tall < 32)
        self.assertEqual(self.packed(FOOTPRINTS=layer), tall)

    def test_selected_features_alone(self) -> None:
        layer = self.footprints()
        layer.selectByIds([feature.id() for feature in layer.getFeatures()][:5])
        self.assertEqual(self.packed(FOOTPRINTS=QgsProcessingFeatureSourceDefinition(layer.id(), True)), 5)

    def test_layers_in_memory(self) -> None:
        layer = self.footprints()
        copy = layer.materialize(QgsFeatureRequest().setLimit(7))
        self.assertEqual(self.packed(FOOTPRINTS=copy), 7)

    def test_a_map_has_the_colours_of_viridis_from_0_to_1(self) -> None:
        context = QgsProcessingContext()
        output = str(WORK / "styled.tif")
        details = QgsProcessingContext.LayerDetails("Sky view factor", QgsProject.instance(), "OUTPUT")
        context.setLayersToLoadOnCompletion({output: details})
        self.run_algorithm("raster", context=context, PACKAGE=WORK / "village.farlod", OUTPUT=output)
        layer = QgsRasterLayer(output, "map")
        context.layerToLoadOnCompletionDetails(output).postProcessor().postProcessLayer(layer, context, Feedback())
        colours = layer.renderer().shader().rasterShaderFunction()
        self.assertEqual((colours.minimumValue(), colours.maximumValue()), (0.0, 1.0))
        self.assertEqual([colours.shade(value)[1:4] for value in (0.0, 1.0)], [(68, 1, 84), (253, 231, 37)])


class Programs(ProcessingTest):
    def test_the_option_of_processing_comes_first(self) -> None:
        ProcessingConfig.setSettingValue(FOLDER_SETTING, str(WORK))
        self.addCleanup(ProcessingConfig.setSettingValue, FOLDER_SETTING, str(PROGRAMS))
        with self.assertRaisesRegex(QgsProcessingException, "farlod-pack is not in the folder .* which the Processing option"):
            self.run_algorithm("pack", INPUT=[str(SAMPLES / "village.gml")], OUTPUT=WORK / "a.farlod")

    def test_progress_is_told(self) -> None:
        feedback = Feedback()
        # Every 10 s: with fewer rays, a fast machine is ready before that
        self.run_algorithm("raster", feedback, PACKAGE=WORK / "town.farlod", ENGINE="exact", RAYS=60000, STEP=8,
                           OUTPUT=WORK / "p.tif")
        self.assertEqual(feedback.stages, ["sky view factors"])
        self.assertGreater(len(feedback.percents), 1)
        self.assertEqual(sorted(feedback.percents), feedback.percents)


class Refusals(ProcessingTest):
    def refused(self, name: str, text: str, **parameters: object) -> None:
        with self.assertRaisesRegex(QgsProcessingException, text):
            self.run_algorithm(name, **parameters)
        self.assertEqual(self.new_names(), [])

    def test_cities_that_cannot_be_packed(self) -> None:
        city, output = [str(SAMPLES / "village.gml")], WORK / "none.farlod"
        self.refused("pack", "There is nothing to pack: give city files", OUTPUT=output)
        self.refused("pack", "farlod-pack: lost.gml does not exist", INPUT=["lost.gml"], OUTPUT=output)
        self.refused("pack", "4 is even: a neighborhood has a cell in its middle", INPUT=city, NEIGHBORHOOD=4, OUTPUT=output)
        self.refused("pack", "give auto, none, or degrees", INPUT=city, ALIGN="streets", OUTPUT=output)
        odd = [str(ROOT / "datasets" / "broken" / "402_self_intersecting.city.json")]
        self.refused("pack", "--strict allows none", INPUT=odd, STRICT=True, OUTPUT=output)
        nowhere = "0,1,0,1 [EPSG:32632]"
        self.refused("pack", "meets no cell of the grid", INPUT=city, AREA_EXTENT=nowhere, OUTPUT=output)
        layer = str(SAMPLES / "village.geojson")
        self.refused("pack", "give one of the two", INPUT=city, AREA_EXTENT=nowhere, AREA_LAYER=layer, OUTPUT=output)
        self.refused("pack", "there is no folder .*lost; make it first", INPUT=city, OUTPUT=WORK / "lost" / "a.farlod")
        self.refused("pack", "village.farlod exists already", INPUT=city, OUTPUT=WORK / "village.farlod")

    def test_maps_that_cannot_be_made(self) -> None:
        package, output = WORK / "village.farlod", WORK / "none.tif"
        self.refused("raster", "farlod-svf: .*lost.farlod", PACKAGE=WORK / "lost.farlod", OUTPUT=output)
        self.refused("raster", "neither a day", PACKAGE=package, SUN="midsummer", OUTPUT=output)
        self.refused("raster", "sunlit needs a day or a year", PACKAGE=package, QUANTITIES=["sunlit"], OUTPUT=output)
        self.refused("raster", "no room for bounds", PACKAGE=package, BOUNDS=True, OUTPUT=WORK / "none.asc")
        self.refused("raster", "there is no folder", PACKAGE=package, OUTPUT=WORK / "lost" / "none.tif")

    def test_points_and_surfaces_that_cannot_be_answered(self) -> None:
        polygons = str(SAMPLES / "village.geojson")
        points = processing.run("native:centroids", {"INPUT": polygons, "OUTPUT": "TEMPORARY_OUTPUT"})["OUTPUT"]
        package, output = WORK / "village.farlod", WORK / "none.gpkg"
        self.refused("points", "A normal needs an azimuth and a tilt", PACKAGE=package, INPUT=points, AZIMUTH_FIELD="height",
                     OUTPUT=output)
        both = {"EXTENT": "0,1,0,1 [EPSG:32632]", "MASK": polygons}
        self.refused("surfaces", "with --mask it goes with --grid only", PACKAGE=package, RECEIVERS=output, **both)

    def test_a_damaged_package_is_told(self) -> None:
        broken = WORK / "broken.farlod"
        shutil.copytree(WORK / "village.farlod", broken)
        self.before.add(broken)
        for tiles in broken.glob("blocks/*/tiles.bin"):
            tiles.write_bytes(tiles.read_bytes()[:100])
        self.refused("raster", "farlod-svf: .*tiles.bin", PACKAGE=broken, OUTPUT=WORK / "none.tif")


class Cancelling(ProcessingTest):
    def test_a_map_leaves_nothing_and_keeps_the_older_one(self) -> None:
        (WORK / "old.tif").write_text("old")
        self.before.add(WORK / "old.tif")
        # The whole map would take hours, and outlast ctest's limit
        with self.assertRaisesRegex(QgsProcessingException, "cancelled"):
            self.run_algorithm("raster", Feedback("sky view factors"), PACKAGE=WORK / "town.farlod", ENGINE="exact", RAYS=100000,
                               STEP=0.5, OUTPUT=WORK / "old.tif")
        self.assertEqual(self.new_names(), [])
        self.assertEqual((WORK / "old.tif").read_text(), "old")

    def test_a_package_that_was_to_be_replaced_stays(self) -> None:
        kept = WORK / "kept.farlod"
        shutil.copytree(WORK / "village.farlod", kept)
        self.before.add(kept)
        with self.assertRaisesRegex(QgsProcessingException, "cancelled"):
            self.run_algorithm("pack", Feedback("far maps"), INPUT=[str(WORK / "town.gml")], CELL=10, OVERWRITE=True, OUTPUT=kept)
        self.assertEqual(self.new_names(), [])
        subprocess.run(["diff", "--recursive", WORK / "village.farlod", kept], check=True)

    def test_a_package_to_which_far_maps_were_to_be_added_stays(self) -> None:
        kept, part = WORK / "part.farlod", "550000,550020,5500000,5500020 [EPSG:32632]"
        self.run_algorithm("pack", INPUT=[str(WORK / "town.gml")], CELL=10, AREA_EXTENT=part, OUTPUT=kept)
        shutil.copytree(kept, WORK / "before.farlod")
        self.before |= {kept, WORK / "before.farlod"}
        with self.assertRaisesRegex(QgsProcessingException, "cancelled"):
            self.run_algorithm("pack", Feedback("far maps"), INPUT=[str(WORK / "town.gml")], CELL=10, OUTPUT=kept,
                               AREA_EXTENT="549000,551000,5499000,5501000 [EPSG:32632]")
        self.assertEqual(self.new_names(), [])
        subprocess.run(["diff", "--recursive", WORK / "before.farlod", kept], check=True)


def prepare() -> None:
    shutil.rmtree(WORK, ignore_errors=True)
    WORK.mkdir(parents=True)
    WORK.chmod(0o700)  # Qt wants it of a folder that is XDG_RUNTIME_DIR
    os.environ["XDG_RUNTIME_DIR"] = os.environ["HOME"] = os.environ["QGIS_CUSTOM_CONFIG_PATH"] = str(WORK)
    program("farlod-pack", SAMPLES / "village.gml", "-o", WORK / "village.farlod", "--cell", 40)
    program("farlod-city", "-o", WORK / "town.gml", "--size", 1500)
    program("farlod-pack", WORK / "town.gml", "-o", WORK / "town.farlod")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: tests/qgis/processing_test.py PROGRAMS FOLDER [TEST...]")
    PROGRAMS, WORK = (pathlib.Path(argument).absolute() for argument in sys.argv[1:3])
    prepare()
    application = QgsApplication([], False)
    application.initQgis()
    import processing
    from farlod import classFactory
    from farlod.program_folder import FOLDER_SETTING
    from processing.core.Processing import Processing
    from processing.core.ProcessingConfig import ProcessingConfig
    from qgis.core import QgsFeatureRequest

    Processing.initialize()
    plug_in = classFactory(None)
    plug_in.initProcessing()
    ProcessingConfig.setSettingValue(FOLDER_SETTING, str(PROGRAMS))
    tests = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False)
    plug_in.unload()
    QgsProject.instance().clear()
    application.exitQgis()
    sys.exit(0 if tests.result.wasSuccessful() else 1)
