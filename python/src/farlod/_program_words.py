# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What the library advises in words of the program, in those of Python."""

from __future__ import annotations

import re

#: Arguments of farlod.pack() that are not called as the option of farlod-pack is.
_ARGUMENTS = {
    "origin": "obj_origin",
    "height-field": "heights.height",
    "base-field": "heights.base",
    "roof-field": "heights.roof",
    "storeys-field": "heights.storeys",
    "floor-height": "heights.floor_height",
    "default-height": "heights.default",
    "unknown-height": "heights.unknown",
    "tree-height-field": "trees.height",
    "crown-field": "trees.crown",
    "trunk-field": "trees.trunk",
    "trees-layer": "trees.layer",
    "canopy": "trees.canopy",
    "trunk": "trees.canopy_trunk",
    "canopy-absolute": "trees.absolute",
    "trunk-ratio": "trees.trunk_ratio",
}
_SAME_NAMES = (
    "align area assign cell crs encoding far-map far-terrain ground-names layer lod max-error memory-limit neighborhood out-crs "
    "surface terrain terrain-offset threads trees up"
).split()

#: Words that an argument is set to.
_WORDS = "clip|whole|horizon|box|tin"

#: What a file of this ending holds, where it was written of what a caller gave.
_GIVEN = {"gpkg": "the GeoDataFrame", "tif": "the DataArray", "obj": "the mesh"}


def _with_what_was_given(message: str, folder: str) -> str:
    """``message`` without files of a temporary folder: ``terrain_0.tif`` is the DataArray of terrain."""

    def given(match: re.Match[str]) -> str:
        number = int(match["number"] or 0)
        which = "" if match["role"] == "city" and number == 0 else f" of {match['role']}" + (f"[{number}]" if number else "")
        return _GIVEN[match["ending"]] + which

    file = r"[/\\](?P<role>[a-z_]+?)(?:_(?P<number>\d+))?\.(?P<ending>" + "|".join(_GIVEN) + r")\b"
    return re.sub(re.escape(folder) + file, given, message)


def words_of_python(message: str) -> str:
    """``message`` with the arguments of farlod.pack() in place of the options of farlod-pack."""
    names = {**{name: name.replace("-", "_") for name in _SAME_NAMES}, **_ARGUMENTS}

    def argument(match: re.Match[str]) -> str:
        name = names.get(match["option"])
        if name is None:
            return match[0]
        value = match["epsg"] or match["word"]
        return ("farlod.pack with " if match["program"] else "") + (f'{name}="{value}"' if value else name)

    text = message.replace("--force", "overwrite=True").replace(" for -o", " for path")
    option = r"(?P<program>farlod-pack )?(?<![\w-])--(?P<option>[a-z]+(?:-[a-z]+)*)"
    return re.sub(option + rf"(?: (?P<epsg>EPSG:\w+)|(?: (?P<word>{_WORDS})\b))?", argument, text)


def in_python(message: str, folder: str) -> str:
    """The same, and with what a caller gave in place of files in ``folder``."""
    return words_of_python(_with_what_was_given(message, folder))
