# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What QGIS loads and unloads."""
from __future__ import annotations

from qgis.core import QgsApplication

from .provider import FarlodProvider


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
