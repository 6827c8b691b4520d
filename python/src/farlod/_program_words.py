# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What the library advises in words of the program, in those of Python."""

from __future__ import annotations

import re

#: Fields of farlod.Heights and farlod.Trees, the arguments of farlod.pack() that several options are.
_HEIGHTS = {
    "height-field": "height",
    "base-field": "base",
    "roof-field": "roof",
    "storeys-field": "storeys",
    "floor-height": "floor_height",
    "default-height": "default",
    "unknown-height": "unknown",
}
_TREES = {
    "tree-height-field": "height",
    "crown-field": "crown",
    "trunk-field": "trunk",
    "trees-layer": "layer",
    "canopy": "canopy",
    "trunk": "canopy_trunk",
    "canopy-absolute": "absolute",
    "trunk-ratio": "trunk_ratio",
}
_FLAGS = ("canopy-absolute",)
#: Arguments of farlod.pack() that are not called as the option of farlod-pack is.
_OTHER_NAMES = {"origin": "obj_origin"}
_SAME_NAMES = (
    "align area assign cell crs encoding far-map far-terrain ground-names layer lod max-error memory-limit neighborhood out-crs "
    "surface terrain terrain-offset threads trees up"
).split()

#: Words and numbers that an argument is set to.
_WORDS = r"(?:(?:EPSG|OGC):\w+|clip|whole|horizon|box|tin|[yz])\b"
_NUMBERS = r"-?\d+(?:\.\d+)?\b"

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


def _argument(option: str, value: str | None) -> str | None:
    """What a caller of farlod.pack() types for an option of farlod-pack."""
    for group, fields in (("heights=farlod.Heights", _HEIGHTS), ("trees=farlod.Trees", _TREES)):
        if option in fields:
            return f"{group}({fields[option]}={value or ('True' if option in _FLAGS else '...')})"
    name = _OTHER_NAMES.get(option) or (option.replace("-", "_") if option in _SAME_NAMES else None)
    return f"{name}={value}" if name and value else name


def words_of_python(message: str) -> str:
    """``message`` with the arguments of farlod.pack() in place of the options of farlod-pack."""

    def argument(match: re.Match[str]) -> str:
        word = match["word"] or match["field"]
        text = _argument(match["option"], f'"{word}"' if word else match["number"])
        return match[0] if text is None else ("farlod.pack with " if match["program"] else "") + text

    text = message.replace("--force", "overwrite=True").replace(" for -o", " for path")
    option = r"(?P<program>farlod-pack )?(?<![\w-])--(?P<option>[a-z]+(?:-[a-z]+)*)"
    value = rf"(?P<word>{_WORDS})|(?P<number>{_NUMBERS})|(?P<field>(?<=-field )(?!or\b)[^,;:]+?)(?= in place of )"
    return re.sub(rf"{option}(?: (?:{value}))?", argument, text)


def in_python(message: str, folder: str) -> str:
    """The same, and with what a caller gave in place of files in ``folder``."""
    return words_of_python(_with_what_was_given(message, folder))
