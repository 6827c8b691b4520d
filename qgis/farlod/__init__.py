# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A plug-in of QGIS: the programs of Far-LoD as algorithms of Processing."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from qgis.gui import QgisInterface

    from .provider import FarlodPlugin


def classFactory(iface: QgisInterface | None) -> FarlodPlugin:  # QGIS gives the name
    """What QGIS calls to load the plug-in. Nothing of QGIS is imported before."""
    from .provider import FarlodPlugin

    return FarlodPlugin()
