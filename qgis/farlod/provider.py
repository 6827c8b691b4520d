# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What QGIS loads and unloads: the provider, and its setting in the options of Processing."""
from __future__ import annotations

import pathlib

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsApplication, QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .pack import PackCity
from .points import SkyViewFactorsOfPoints
from .program_folder import FOLDER_SETTING
from .raster import SkyViewFactorRaster
from .surfaces import SkyViewFactorsOfSurfaces

ICON = str(pathlib.Path(__file__).parent / "icon.svg")


class FarlodProvider(QgsProcessingProvider):
    """Four algorithms: pack a city, then look at the sky from a raster, from points, and from roofs and façades."""

    def id(self) -> str:
        return "farlod"

    def name(self) -> str:
        return "Far-LoD"

    def longName(self) -> str:
        return "Far-LoD: sky view factors of whole cities"

    def icon(self) -> QIcon:
        return QIcon(ICON)

    def svgIconPath(self) -> str:
        return ICON

    def load(self) -> bool:
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(Setting(self.name(), FOLDER_SETTING, "Folder of the programs", "", valuetype=Setting.FOLDER))
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self) -> None:
        ProcessingConfig.removeSetting(FOLDER_SETTING)

    def loadAlgorithms(self) -> None:
        for algorithm in (PackCity, SkyViewFactorRaster, SkyViewFactorsOfPoints, SkyViewFactorsOfSurfaces):
            self.addAlgorithm(algorithm())

    def supportedOutputRasterLayerExtensions(self) -> list[str]:
        """What farlod-svf writes and QGIS shows; the first one is the default."""
        return ["tif", "nc", "asc"]


class FarlodPlugin:
    """Registers the provider while the plug-in is loaded. Without a window (qgis_process), QGIS calls initProcessing alone."""

    def __init__(self) -> None:
        self.provider: FarlodProvider | None = None

    def initProcessing(self) -> None:
        self.provider = FarlodProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self) -> None:
        self.initProcessing()

    def unload(self) -> None:
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
