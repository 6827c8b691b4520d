# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sky view factors of roofs and façades: farlod-svf --surfaces."""
from __future__ import annotations

import pathlib

from qgis.core import (
    QgsFeatureSink,
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterNumber,
    QgsProcessingUtils,
    QgsVectorLayer,
)

from .algorithm import Values
from .evaluation import EvaluationAlgorithm
from .staging import Staging

# Output, layer of the GeoPackage that farlod-svf writes, title and type
TABLES = (
    ("RECEIVERS", "receivers", "Receivers", QgsProcessing.TypeVectorPoint),
    ("SURFACES", "surfaces", "Surfaces", QgsProcessing.TypeVector),
    ("BUILDINGS", "buildings", "Buildings", QgsProcessing.TypeVector),
)


class SkyViewFactorsOfSurfaces(EvaluationAlgorithm):
    NAME = "surfaces"
    TITLE = "Sky view factor of façades and roofs"
    HELP = (
        "How much of the sky the façades and roofs of all buildings see, each along its own normal. A façade in the open has "
        "0.5, since the lower half of what it faces is ground.\n\n"
        "Three layers: the receivers, which are points spread over the surfaces; the surfaces, as polygons with averages; a table "
        "with averages of each building. Join the tables to footprints by “building”. Parts that a neighbour covers have NULL, "
        "and do not count."
    )

    def initAlgorithm(self, configuration: Values | None = None) -> None:
        self.add_package()
        self.add_choice("WHICH", "Surfaces", "walls: façades; roofs; or all of both.", ["walls", "roofs", "all"])
        spacing = QgsProcessingParameterNumber(
            "SPACING", "Spacing (m)", QgsProcessingParameterNumber.Double, 2.0, False, 0.05, 1000.0
        )
        self.add(spacing, "A receiver for each square of this edge, and at least one for each triangle of a surface.")
        self.add_region()
        self.add_sky()
        self.add_accuracy()
        for name, _, title, kind in TABLES:
            self.addParameter(QgsProcessingParameterFeatureSink(name, title, kind, None, True))
        self.add_statistics()

    def compute(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        tables = pathlib.Path(QgsProcessingUtils.generateTempFilename("surfaces.gpkg"))
        with Staging(str(tables)) as staging:
            which = self.choice_argument(parameters, "WHICH", "--surfaces", context)
            spacing = self.number_argument(parameters, "SPACING", "--spacing", context)
            region = self.region_arguments(parameters, context, feedback, staging.folder)
            numbers = self.evaluate([*which, *spacing, *region], parameters, context, feedback, staging)
            outputs = {name: self._copy(name, staging.result, layer, parameters, context) for name, layer, _, _ in TABLES}
        return {**{name: output for name, output in outputs.items() if output is not None}, **numbers}

    def _copy(self, name: str, file: pathlib.Path, layer: str, parameters: Values, context: QgsProcessingContext) -> str | None:
        """A table, in the format that the user has chosen; nothing where the user wants none."""
        table = QgsVectorLayer(f"{file}|layername={layer}", layer, "ogr")
        sink, output = self.parameterAsSink(parameters, name, context, table.fields(), table.wkbType(), table.crs())
        if sink is None:
            if self.is_given(parameters, name):
                raise QgsProcessingException(self.invalidSinkError(parameters, name))
            return None
        if not sink.addFeatures(table.getFeatures(), QgsFeatureSink.FastInsert):
            raise QgsProcessingException(self.writeFeatureError(sink, parameters, name))
        return output
