# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What farlod.pack() packs cities with. It has a licence of its own (GPL-3.0-or-later), as CGAL's packages have that it uses."""

from __future__ import annotations

from farlod import _modules

__all__ = ["__version__"]

__version__: str = _modules.load("farlod_preprocess._preprocess").version
