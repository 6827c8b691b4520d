# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a map of sky view factors is shown."""
from __future__ import annotations

from qgis.core import (
    QgsColorRampShader,
    QgsMapLayer,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsRasterLayer,
    QgsRasterShader,
    QgsSingleBandPseudoColorRenderer,
    QgsStyle,
)


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
