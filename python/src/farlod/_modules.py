# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Loads the compiled modules, and names the Debian packages where something is missing."""

from __future__ import annotations

import importlib
import re
from types import ModuleType
from typing import TYPE_CHECKING

__all__ = ["DEBIAN_PACKAGES", "advice_for", "load", "load_preprocess", "runtime"]

#: The Debian package that a shared library comes with, by the name that a module asks for, and the releases that have it.
DEBIAN_PACKAGES = {
    "libOpenEXR-3_1.so.30": ("libopenexr-3-1-30", "12 and 13"),
    "libOpenEXRCore-3_1.so.30": ("libopenexr-3-1-30", "12 and 13"),
    "libImath-3_1.so.29": ("libimath-3-1-29", "12 and 13"),
    "libembree3.so.3": ("libembree3-3", "12"),
    "libembree4.so.4": ("libembree4-4", "13"),
    "libexpat.so.1": ("libexpat1", "12 and 13"),
    "liberfa.so.1": ("liberfa1", "12 and 13"),
    "libfmt.so.9": ("libfmt9", "12"),
    "libfmt.so.10": ("libfmt10", "13"),
    "libgdal.so.32": ("libgdal32", "12"),
    "libgdal.so.36": ("libgdal36", "13"),
    "libGeographicLib.so.23": ("libgeographiclib23", "12"),
    "libGeographicLib.so.26": ("libgeographiclib26", "13"),
    "libgmp.so.10": ("libgmp10", "12 and 13"),
    "libproj.so.25": ("libproj25", "12 and 13"),
    "libtbb.so.12": ("libtbb12", "12 and 13"),
    "libxxhash.so.0": ("libxxhash0", "12 and 13"),
}


def advice_for(message: str) -> str:
    """What to install, from what the dynamic linker says of a library that is missing; empty where it says something else."""
    missing = re.search(r"(\S+\.so\S*): cannot open shared object file", message)
    if missing is None:
        return ""
    if missing[1] not in DEBIAN_PACKAGES:
        return f"The library {missing[1]} is missing: install the package of your system that has it."
    package, releases = DEBIAN_PACKAGES[missing[1]]
    return f"The library {missing[1]} is missing: on Debian {releases}, run apt-get install {package}."


def load(name: str) -> ModuleType:
    """The compiled module of this name. Raises ImportError, which says what is missing."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        advice = advice_for(str(error))
        if not advice:
            raise
        raise ImportError(f"{name} cannot be loaded. {advice}", name=name) from error


# What evaluates packages: each import of farlod needs it. Its types are in _runtime.pyi
if TYPE_CHECKING:
    from farlod import _runtime as runtime
else:
    runtime = load("farlod._runtime")


def load_preprocess() -> ModuleType:
    """The module that packs cities. Raises ImportError, which says how to get it."""
    try:
        importlib.import_module("farlod_preprocess")
    except ModuleNotFoundError as error:
        if error.name != "farlod_preprocess":
            raise
        raise ImportError(
            "farlod.pack() needs the package farlod-preprocess, which has a licence of its own (GPL-3.0-or-later): "
            "pip install it from python/preprocess of the sources. farlod-pack, the program, makes the same packages.",
            name="farlod_preprocess",
        ) from error
    return load("farlod_preprocess._preprocess")
