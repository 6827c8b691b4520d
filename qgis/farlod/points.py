# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sky view factors of the points of a layer: farlod-svf --points."""
from __future__ import annotations

import csv
import pathlib
from collections.abc import Iterator

from qgis.core import (
    NULL,
    QgsFeature,
    QgsFeatureSink,
    QgsField,
    QgsFields,
    QgsGeometry,
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeatureSource,
    QgsProcessingFeedback,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterField,
    QgsProcessingUtils,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

from .algorithm import Values
from .evaluation import EvaluationAlgorithm
from .layer_files import ROW_NUMBER, vector_writer
from .staging import Staging

# Columns of the answers that say what the layer says already
KNOWN_COLUMNS = ("id", ROW_NUMBER, "x_m", "y_m", "azimuth_deg", "tilt_deg")
NORMAL_HELP = (
    "In degrees: the azimuth of the normal clockwise from true north, its tilt from straight up (a window 90). Give both fields, "
    "or none: then points look straight up."
)


class SkyViewFactorsOfPoints(EvaluationAlgorithm):
    NAME = "points"
    TITLE = "Sky view factor of points"
    HELP = (
        "The sky view factor at each point of a layer, in any CRS: weather stations, panels, windows, trees.\n\n"
        "The result has the points with all their attributes, and beside them the answers and z_m, the height at which the sky "
        "was looked at. A point inside of a building or outside of the city has NULL. A feature of several points comes back as one "
        "feature for each of them."
    )

    def initAlgorithm(self, configuration: Values | None = None) -> None:
        self.add_package()
        points = QgsProcessingParameterFeatureSource("INPUT", "Points", [QgsProcessing.TypeVectorPoint])
        self.add(points, "A layer that has no CRS is taken to be in that of the package.")
        use_z = QgsProcessingParameterBoolean("USE_Z", "The z of a point is its height", True)
        self.add(use_z, "As an elevation in metres. Otherwise, and for points without a z, the height counts from the ground.")
        self.add_placing()
        for name, title in (("AZIMUTH_FIELD", "Field: azimuth of the normal"), ("TILT_FIELD", "Field: tilt of the normal")):
            field = QgsProcessingParameterField(name, title, None, "INPUT", QgsProcessingParameterField.Numeric, False, True)
            self.add(field, NORMAL_HELP)
        self.add_sky()
        self.add_accuracy()
        sink = QgsProcessingParameterFeatureSink("OUTPUT", "Points with sky view factors", QgsProcessing.TypeVectorPoint)
        self.addParameter(sink)
        self.add_statistics()

    def compute(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        source = self.parameterAsSource(parameters, "INPUT", context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "INPUT"))
        answers = pathlib.Path(QgsProcessingUtils.generateTempFilename("answers.csv"))
        with Staging(str(answers)) as staging:
            use_z = self.parameterAsBoolean(parameters, "USE_Z", context)
            points = save_points(source, self._normal_fields(parameters, context), use_z, staging.folder / "points.gpkg")
            arguments = ["--points", points, *self.placing_arguments(parameters, context)]
            numbers = self.evaluate(arguments, parameters, context, feedback, staging)
            with staging.result.open(newline="", encoding="utf-8") as table:
                output = self._join(source, csv.DictReader(table), parameters, context)
        return {"OUTPUT": output, **numbers}

    def _normal_fields(self, parameters: Values, context: QgsProcessingContext) -> dict[str, str]:
        """The columns of a normal, and the fields that they come from."""
        names = {"azimuth": "AZIMUTH_FIELD", "tilt": "TILT_FIELD"}
        fields = {column: self.parameterAsString(parameters, name, context) for column, name in names.items()}
        if any(fields.values()) and not all(fields.values()):
            raise QgsProcessingException("A normal needs an azimuth and a tilt: give both fields, or none.")
        return fields if all(fields.values()) else {}

    def _join(
        self, source: QgsProcessingFeatureSource, answers: csv.DictReader, parameters: Values, context: QgsProcessingContext
    ) -> str:
        columns = [name for name in answers.fieldnames or [] if name not in KNOWN_COLUMNS]
        added = QgsFields()
        for name in columns:
            added.append(QgsField(name, QVariant.Double))
        fields = QgsProcessingUtils.combineFields(source.fields(), added)
        kind = QgsWkbTypes.singleType(source.wkbType())
        # A feature of several points comes back several times, and its `fid` with it
        flags = QgsFeatureSink.RegeneratePrimaryKey
        sink, output = self.parameterAsSink(parameters, "OUTPUT", context, fields, kind, source.sourceCrs(), flags)
        if sink is None:
            raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
        for feature in points_of(source):
            row = next(answers) if feature.hasGeometry() else {}
            values = [float(row[name]) if row.get(name) else NULL for name in columns]
            feature.setAttributes(feature.attributes() + values)
            if not sink.addFeature(feature, QgsFeatureSink.FastInsert):
                raise QgsProcessingException(self.writeFeatureError(sink, parameters, "OUTPUT"))
        return output


def points_of(source: QgsProcessingFeatureSource) -> Iterator[QgsFeature]:
    """A feature for each point, in the order of the source; without a geometry where there is no point."""
    for feature in source.getFeatures():
        geometry = feature.geometry()  # outlives its parts
        places = [] if geometry.isEmpty() else [QgsGeometry(part.clone()) for part in geometry.constParts()]
        for place in places or [QgsGeometry()]:
            point = QgsFeature(feature)
            point.setGeometry(place)
            yield point


def save_points(source: QgsProcessingFeatureSource, normals: dict[str, str], use_z: bool, path: pathlib.Path) -> str:
    """Places and normals alone: the attributes stay with the layer, where they keep their types."""
    fields = QgsFields()
    for name in normals:
        fields.append(QgsField(name, QVariant.Double))
    has_z = use_z and QgsWkbTypes.hasZ(source.wkbType())
    writer = vector_writer(path, fields, QgsWkbTypes.PointZ if has_z else QgsWkbTypes.Point, source.sourceCrs())
    for feature in points_of(source):
        if not feature.hasGeometry():
            continue
        point = feature.geometry()
        point.get().dropMValue()
        if not has_z:
            point.get().dropZValue()
        place = QgsFeature(fields)
        place.setAttributes([feature[field] for field in normals.values()])
        place.setGeometry(point)
        if not writer.addFeature(place, QgsFeatureSink.FastInsert):
            raise QgsProcessingException(f"{path} cannot be written: {writer.errorMessage()}")
    return str(path)
