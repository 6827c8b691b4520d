# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Sky view factors of the pixels of a raster: farlod-svf --grid."""
from __future__ import annotations

from qgis.core import (
    QgsColorRampShader,
    QgsMapLayer,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsProcessingParameterNumber,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
    QgsRasterLayer,
    QgsRasterShader,
    QgsSingleBandPseudoColorRenderer,
    QgsStyle,
)

from .algorithm import Values
from .evaluation import EvaluationAlgorithm
from .layer_files import raster_file
from .staging import Staging


class SkyViewFactorStyle(QgsProcessingLayerPostProcessorInterface):
    """Viridis from 0 to 1, as in the pictures of farlod-svf: the same colour is the same value in every map."""

    # QGIS keeps no reference of its own to it
    _instance: SkyViewFactorStyle | None = None

    @classmethod
    def instance(cls) -> SkyViewFactorStyle:
        cls._instance = cls._instance or cls()
        return cls._instance

    def postProcessLayer(self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> None:
        if not isinstance(layer, QgsRasterLayer):
            return
        ramp = QgsStyle.defaultStyle().colorRamp("Viridis")
        colours = QgsColorRampShader(0.0, 1.0, ramp, QgsColorRampShader.Interpolated)
        colours.classifyColorRamp(11)
        shader = QgsRasterShader(0.0, 1.0)
        shader.setRasterShaderFunction(colours)
        renderer = QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1, shader)
        renderer.setClassificationMin(0.0)
        renderer.setClassificationMax(1.0)
        layer.setRenderer(renderer)
        layer.triggerRepaint()


class SkyViewFactorRaster(EvaluationAlgorithm):
    NAME = "raster"
    TITLE = "Sky view factor raster"
    HELP = (
        "A map of the sky view factor: the share of the sky that each place sees, from 0 to 1, weighted by the cosine to the "
        "vertical.\n\n"
        "A pixel's value is that of its centre, at a height above the ground. Pixels inside of buildings and outside of the city "
        "have no data. Band 1 is the sky view factor; bounds and further quantities are further bands."
    )

    def initAlgorithm(self, configuration: Values | None = None) -> None:
        self.add_package()
        double = QgsProcessingParameterNumber.Double
        step = QgsProcessingParameterNumber("STEP", "Pixel size (m)", double, 2.0, False, 0.01, 10000.0)
        self.add(step, "Pixels begin at multiples of it.")
        like = QgsProcessingParameterRasterLayer("LIKE", "Pixels of this raster instead", None, True)
        self.add(like, "Such as a surface model, for SOLWEIG. It has to be in the CRS of the package.", advanced=True)
        self.add_placing()
        self.add_region()
        self.add_sky()
        self.add_accuracy()
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Sky view factor"))
        self.add_statistics()

    def compute(self, parameters: Values, context: QgsProcessingContext, feedback: QgsProcessingFeedback) -> Values:
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        like = self.parameterAsRasterLayer(parameters, "LIKE", context)
        with Staging(output) as staging:
            step = self.number_argument(parameters, "STEP", "--grid", context)
            pixels = step if like is None else ["--grid-like", raster_file(like)]
            region = self.region_arguments(parameters, context, feedback, staging.folder)
            arguments = [*pixels, *self.placing_arguments(parameters, context), *region]
            numbers = self.evaluate(arguments, parameters, context, feedback, staging)
            staging.hand_over()
        if context.willLoadLayerOnCompletion(output):
            context.layerToLoadOnCompletionDetails(output).setPostProcessor(SkyViewFactorStyle.instance())
        return {"OUTPUT": output, **numbers}
