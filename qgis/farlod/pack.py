# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A city model becomes a package: farlod-pack."""
from __future__ import annotations

import json
import pathlib
import shutil

from qgis.core import (
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeatureSourceDefinition,
    QgsProcessingFeedback,
    QgsProcessingOutputNumber,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
)

from .algorithm import FarlodAlgorithm, Values
from .layer_files import own_file, raster_file, save_rectangle, save_source
from .staging import MANIFEST, NothingUnfinished, Staging, require_room_for_package

# Of one run; the report has all
MOST_WARNINGS = 20
# Outputs, which are keys of the summary in small letters
COUNTS = {"BUILDINGS": "Buildings", "POLYGONS": "Polygons", "PROBLEMS": "Problems of the input"}
# Parameter, option, title and help of the fields of footprints
FIELDS = (
    ("HEIGHT_FIELD", "--height-field", "Field: height", "Height above the base, in metres. A field with a usual name is found."),
    ("BASE_FIELD", "--base-field", "Field: elevation of the base", "In metres; without it, bases lie on the ground."),
    ("ROOF_FIELD", "--roof-field", "Field: elevation of the roof", "In metres; needs the elevation of the base, or a terrain."),
    ("STOREYS_FIELD", "--storeys-field", "Field: number of storeys", "Used where no height is known."),
)
# The same of trees
TREE_FIELDS = (
    ("TREE_HEIGHT_FIELD", "--tree-height-field", "Field: height of a tree", "In metres. A field with a usual name is found."),
    ("CROWN_FIELD", "--crown-field", "Field: diameter of the crown", "In metres; without it, half the height."),
    ("TRUNK_FIELD", "--trunk-field", "Field: height at which the crown begins", "In metres; without it, a share of the height."),
)


class PackCity(FarlodAlgorithm):
    NAME = "pack"
    TITLE = "Pack a city"
    HELP = (
        "Cuts a city model into a package, from which the other algorithms compute sky view factors.\n\n"
        "City files are CityGML, CityJSON, OBJ, STL, PLY, GLB, and footprints with heights; also folders of them, .zip and .gz. Footprints may "
        "also be a layer of the project. All inputs become one city.\n\n"
        "A package is made once for a city. One bad building never ends the run: it is reported as a warning, and left out or "
        "repaired."
    )

    def initAlgorithm(self, configuration: Values | None = None) -> None:
        self._add_inputs()
        self._add_footprints()
        self._add_trees()
        self._add_grid()
        self._add_outputs()

    def _add_inputs(self) -> None:
        files = QgsProcessingParameterMultipleLayers("INPUT", "City files", QgsProcessing.TypeFile, None, True)
        self.add(files, "CityGML, CityJSON, OBJ, STL, PLY, GLB, footprints in a vector format of GDAL, .zip or .gz.")
        kind = QgsProcessingParameterFile.Folder
        folder = QgsProcessingParameterFile("INPUT_FOLDER", "Folder with city files", kind, "", None, True)
        self.add(folder, "All city files in it, and in the folders below it.")
        terrain = QgsProcessingParameterMultipleLayers("TERRAIN", "Terrain", QgsProcessing.TypeRaster, None, True)
        ground = "Elevations of the ground in metres, also in tiles. Without it, the ground passes through the bases of buildings."
        self.add(terrain, ground)
        far = QgsProcessingParameterMultipleLayers("FAR_TERRAIN", "Far terrain", QgsProcessing.TypeRaster, None, True)
        self.add(far, "Elevations around the city, of any resolution: mountains beyond what the terrain covers hide the sky.")
        crs = QgsProcessingParameterCrs("CRS", "CRS of inputs that do not say theirs", None, True)
        self.add(crs, "Meshes (OBJ, STL, PLY, GLB), and some others, do not say it.")
        out = QgsProcessingParameterCrs("OUT_CRS", "CRS of the package", None, True)
        self.add(out, "In metres. Default: that of the input, or UTM for degrees.", advanced=True)
        origin = QgsProcessingParameterString("ORIGIN", "Origin of meshes", None, False, True)
        self.add(origin, "X,Y or X,Y,Z, added to their coordinates.", advanced=True)
        self.add_choice("UP", "Axis that points up in meshes", "auto: y in GLB, z in others.", ["auto", "z", "y"], advanced=True)
        lods = ["best", "0", "1", "2", "3"]
        self.add_choice("LOD", "Level of detail to read", "best: the most detailed one of each building.", lods, advanced=True)

    def _add_footprints(self) -> None:
        layer = QgsProcessingParameterFeatureSource("FOOTPRINTS", "Footprints", [QgsProcessing.TypeVectorPolygon], None, True)
        self.add(layer, "A layer of polygons, with heights in one of its fields.")
        self._add_fields(FIELDS, "FOOTPRINTS")
        self.add_optional_number("FLOOR_HEIGHT", "Height of a storey (m)", "Default: 3.", 1.0, 20.0, advanced=True)
        default = "Height of footprints that have none (m)"
        self.add_optional_number("DEFAULT_HEIGHT", default, "Without it, they are left out.", 0.01, 1000.0)

    def _add_fields(self, fields: tuple[tuple[str, str, str, str], ...], layer: str) -> None:
        for name, _, title, help_text in fields:
            field = QgsProcessingParameterField(name, title, None, layer, QgsProcessingParameterField.Any, False, True)
            self.add(field, help_text)

    def _add_trees(self) -> None:
        layer = QgsProcessingParameterFeatureSource("TREES", "Trees", [QgsProcessing.TypeVector], None, True)
        self.add(layer, "Points, outlines of crowns, or a table with columns lon, lat or x, y.")
        self._add_fields(TREE_FIELDS, "TREES")
        files = QgsProcessingParameterMultipleLayers("TREE_FILES", "Files with trees", QgsProcessing.TypeFile, None, True)
        self.add(files, "Inventories, or city models (CityGML, CityJSON) with vegetation.")
        canopy = QgsProcessingParameterRasterLayer("CANOPY", "Canopy", None, True)
        self.add(canopy, "Heights of crowns above the ground, in metres; 0: none.")
        trunk = QgsProcessingParameterRasterLayer("TRUNK", "Canopy: where crowns begin", None, True)
        self.add(trunk, "Heights above the ground, in metres. Needs a canopy.", advanced=True)
        absolute = QgsProcessingParameterBoolean("CANOPY_ABSOLUTE", "Canopy: the rasters hold elevations", False)
        self.add(absolute, "Of the canopy, and of the raster of where crowns begin.", advanced=True)
        ratio = "Where nothing else says where a crown begins. Default: 0.25."
        self.add_optional_number("TRUNK_RATIO", "Share of its height at which a crown begins", ratio, 0.0, 0.95, advanced=True)

    def _add_grid(self) -> None:
        self.add_optional_number("CELL", "Edge of a cell (m)", "Default: 150, or what the largest error needs.", 0.5, 10000.0)
        neighborhood = "Odd: the cells along the edge of the near field. Default: 3, or what the largest error needs."
        self.add_optional_number("NEIGHBORHOOD", "Neighbourhood (cells)", neighborhood, 1, 999, whole=True)
        error = "Chooses cells and neighbourhood so that sky view factors keep this error. Give the other algorithms the same."
        self.add_optional_number("MAX_ERROR", "Largest error allowed", error, 0.0001, 1.0)
        align = QgsProcessingParameterString("ALIGN", "Direction of the grid", "auto")
        self.add(align, "auto: along the streets; none: grid north; or degrees clockwise from grid north.", advanced=True)
        extent = QgsProcessingParameterExtent("AREA_EXTENT", "Far maps only in this extent", None, True)
        self.add(extent, "Far maps are most of the work. Receivers elsewhere are traced against the whole city.")
        area = QgsProcessingParameterFeatureSource(
            "AREA_LAYER", "Far maps only where this layer lies", [QgsProcessing.TypeVectorAnyGeometry], None, True
        )
        self.add(area, "Points, lines or polygons, such as stations or a quarter. Far maps are added to a package that is there.")

    def _add_outputs(self) -> None:
        strict = QgsProcessingParameterBoolean("STRICT", "Write no package when the input has any problem", False)
        self.add(strict, "For those who publish a city.", advanced=True)
        memory = "The run packs within so much memory, with more on disk."
        self.add_optional_number("MEMORY_LIMIT", "Memory limit (MiB)", memory, 1, 2**30, whole=True, advanced=True)
        overwrite = QgsProcessingParameterBoolean("OVERWRITE", "Replace a package that is there", False)
        self.add(overwrite, "A folder that holds anything but a package is never replaced.")
        report = QgsProcessingParameterFileDestination(
            "REPORT", "Report of problems", "GeoJSON (*.geojson);;JSON (*.json)", None, True, False
        )
        self.add(report, "Each problem of the input: as points for a map (GeoJSON), or as a list (JSON).")
        self.add(QgsProcessingParameterFolderDestination("OUTPUT", "Package"), "A folder, usually called NAME.farlod.")
        for name, title in COUNTS.items():
            self.addOutput(QgsProcessingOutputNumber(name, title))

    def compute(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        output = pathlib.Path(self.parameterAsString(parameters, "OUTPUT", context)).absolute()
        overwrite = self.parameterAsBoolean(parameters, "OVERWRITE", context)
        has_area = self.is_given(parameters, "AREA_EXTENT") or self.is_given(parameters, "AREA_LAYER")
        adds = has_area and not overwrite and (output / MANIFEST).is_file()
        if not adds:
            require_room_for_package(output, overwrite)
        with Staging(str(output)) as staging:
            arguments = self._arguments(parameters, context, staging.folder)
            if adds:
                with NothingUnfinished(output):
                    results = self._pack(arguments, output, staging, parameters, context, feedback)
            else:
                results = self._pack(arguments, staging.result, staging, parameters, context, feedback)
                staging.hand_over_package()
        return {"OUTPUT": str(output), **results}

    def _pack(
        self,
        arguments: list[str],
        package: pathlib.Path,
        staging: Staging,
        parameters: Values,
        context: QgsProcessingContext,
        feedback: QgsProcessingFeedback,
    ) -> Values:
        wanted = self.parameterAsFileOutput(parameters, "REPORT", context)
        report = staging.folder / ("report" + (pathlib.Path(wanted).suffix.lower() or ".json"))
        summary = staging.folder / "summary.json"
        try:
            arguments += ["-o", str(package), "--report", str(report), "--summary", str(summary)]
            said = self.call("farlod-pack", arguments, feedback)
        finally:
            # Of a run that fails, the problems are wanted most
            self._tell_problems(report, feedback)
            if wanted and report.exists():
                shutil.copyfile(report, wanted)
        for line in said:
            feedback.pushInfo(line.replace(str(package), str(staging.destination)))
        numbers = json.loads(summary.read_text(encoding="utf-8"))
        results = {name: numbers[name.lower()] for name in COUNTS}
        return {**results, "REPORT": wanted} if wanted else results

    # Arguments

    def _arguments(self, parameters: Values, context: QgsProcessingContext, folder: pathlib.Path) -> list[str]:
        """What to pack, and how; layers are saved in the folder."""
        return [
            *self._inputs(parameters, context, folder),
            *self._trees(parameters, context, folder),
            *self._settings(parameters, context),
            *self._area(parameters, context, folder),
        ]

    def _inputs(self, parameters: Values, context: QgsProcessingContext, folder: pathlib.Path) -> list[str]:
        inputs = list(self.parameterAsFileList(parameters, "INPUT", context)) if self.is_given(parameters, "INPUT") else []
        if self.is_given(parameters, "INPUT_FOLDER"):
            inputs.append(self.parameterAsFile(parameters, "INPUT_FOLDER", context))
        if self.is_given(parameters, "FOOTPRINTS"):
            inputs.append(self._layer_file("FOOTPRINTS", folder, parameters, context))
        terrain = self._rasters("TERRAIN", "--terrain", parameters, context)
        if not inputs and not terrain:
            raise QgsProcessingException("There is nothing to pack: give city files, a folder of them, footprints or a terrain.")
        return [*inputs, *terrain, *self._rasters("FAR_TERRAIN", "--far-terrain", parameters, context)]

    def _rasters(self, name: str, option: str, parameters: Values, context: QgsProcessingContext) -> list[str]:
        """The option, once for each raster."""
        layers = self.parameterAsLayerList(parameters, name, context) if self.is_given(parameters, name) else []
        return [f"{option}={raster_file(layer)}" for layer in layers]

    def _layer_file(self, name: str, folder: pathlib.Path, parameters: Values, context: QgsProcessingContext) -> str:
        """The file of a layer, or one in the folder that holds what of it is wanted."""
        value = parameters[name]
        layer = self.parameterAsVectorLayer(parameters, name, context)
        is_part = isinstance(value, QgsProcessingFeatureSourceDefinition) and value.selectedFeaturesOnly
        file = own_file(layer) if layer is not None and not is_part else None
        if file is not None:
            return file
        source = self.parameterAsSource(parameters, name, context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, name))
        return save_source(source, folder / f"{name.lower()}.gpkg")

    def _trees(self, parameters: Values, context: QgsProcessingContext, folder: pathlib.Path) -> list[str]:
        has_files = self.is_given(parameters, "TREE_FILES")
        files = list(self.parameterAsFileList(parameters, "TREE_FILES", context)) if has_files else []
        if self.is_given(parameters, "TREES"):
            files.append(self._layer_file("TREES", folder, parameters, context))
        arguments = [f"--trees={file}" for file in files]
        for name, option, _, _ in TREE_FIELDS:
            arguments += self.text_argument(parameters, name, option, context)
        for name, option in (("CANOPY", "--canopy"), ("TRUNK", "--trunk")):
            raster = self.parameterAsRasterLayer(parameters, name, context)
            arguments += [f"{option}={raster_file(raster)}"] if raster is not None else []
        arguments += self.flag_argument(parameters, "CANOPY_ABSOLUTE", "--canopy-absolute", context)
        return arguments + self.number_argument(parameters, "TRUNK_RATIO", "--trunk-ratio", context)

    def _settings(self, parameters: Values, context: QgsProcessingContext) -> list[str]:
        arguments = []
        for name, option in (("CRS", "--crs"), ("OUT_CRS", "--out-crs")):
            crs = self.parameterAsCrs(parameters, name, context)
            if crs.isValid():
                arguments.append(f"{option}={crs.authid()}")
        fields = [(name, option) for name, option, _, _ in FIELDS]
        for name, option in [("ORIGIN", "--origin"), ("ALIGN", "--align"), *fields]:
            arguments += self.text_argument(parameters, name, option, context)
        for name in ("UP", "LOD"):
            arguments += self.choice_argument(parameters, name, f"--{name.lower()}", context)
        for name in ("FLOOR_HEIGHT", "DEFAULT_HEIGHT", "CELL", "NEIGHBORHOOD", "MAX_ERROR", "MEMORY_LIMIT"):
            arguments += self.number_argument(parameters, name, "--" + name.lower().replace("_", "-"), context)
        return arguments + self.flag_argument(parameters, "STRICT", "--strict", context)

    def _area(self, parameters: Values, context: QgsProcessingContext, folder: pathlib.Path) -> list[str]:
        """As a file, which has a CRS: before the run nobody knows that of the package."""
        extent = self.parameterAsExtent(parameters, "AREA_EXTENT", context)
        source = self.parameterAsSource(parameters, "AREA_LAYER", context)
        if source is not None and not extent.isNull():
            raise QgsProcessingException("Far maps are asked for in an extent and where a layer lies: give one of the two.")
        if source is not None:
            return ["--area", save_source(source, folder / "area.gpkg")]
        if not extent.isNull():
            crs = self.parameterAsExtentCrs(parameters, "AREA_EXTENT", context)
            return ["--area", save_rectangle(extent, crs, folder / "area.gpkg")]
        return []

    # Problems of the input

    def _tell_problems(self, report: pathlib.Path, feedback: QgsProcessingFeedback) -> None:
        if not report.exists():
            return
        entries = json.loads(report.read_text(encoding="utf-8"))
        if isinstance(entries, dict):  # GeoJSON
            entries = [feature["properties"] for feature in entries["features"]]
        for entry in entries[:MOST_WARNINGS]:
            place = ", ".join(entry[key] for key in ("source", "place", "ring") if entry[key])
            feedback.pushWarning(f"{entry['code']} {entry['problem']} ({entry['effect']}): {place}: {entry['detail']}")
        if len(entries) > MOST_WARNINGS:
            feedback.pushWarning(f"… and {len(entries) - MOST_WARNINGS} other problems: the report lists each of them.")
