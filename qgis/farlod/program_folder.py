# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the programs of Far-LoD are. Needs no QGIS."""
from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

FOLDER_SETTING = "FARLOD_FOLDER_OF_PROGRAMS"
FOLDER_VARIABLE = "FARLOD_BIN"
#: Where people unpack an archive, and where programs are that the PATH of a desktop may leave out.
USUAL_PLACES = ("~/.local", "~/.local/farlod*", "~/.local/opt/farlod*", "~/farlod*", "/opt/farlod*", "/usr/local")


class ProgramMissing(Exception):
    """Says which program was not found, where it was looked for, and what to do."""


def _latest_first(folder: Path) -> list[int]:
    """Orders folders by the version in their name, the latest first; a name without comes last."""
    return [-int(number) for number in re.findall(r"\d+", folder.name)] or [1]


def _folders_of_wheel(places: Iterable[str]) -> Iterator[Path]:
    """Where the wheel of the Python package farlod has the programs. It is not imported: this plug-in has the same name."""
    return (Path(place) / "farlod" / "_prefix" / "bin" for place in places)


def _usual_folders(home: str) -> Iterator[Path]:
    for place in USUAL_PLACES:
        pattern = place.replace("~", home, 1).lstrip("/")
        yield from (folder / "bin" for folder in sorted(Path("/").glob(pattern), key=_latest_first))


def find_installed_program(name: str, environment: Mapping[str, str], python_path: Iterable[str]) -> str | None:
    """The path of a program that nobody named: along PATH, else in a wheel of this Python, else where archives are unpacked."""
    home = environment.get("HOME", os.path.expanduser("~"))
    folders = [*_folders_of_wheel(python_path), *_usual_folders(home)]
    path = os.pathsep.join([environment.get("PATH", os.defpath), *map(str, folders)])
    return shutil.which(name, path=path)


def find_program(name: str, folder_of_settings: str, environment: Mapping[str, str], python_path: Iterable[str] | None = None) -> str:
    """The path of a program: in the folder of the settings, else in that of FARLOD_BIN, else where it is installed.

    A folder that is named but does not hold the program is an error: the next place may hold another version of it.
    """
    named = {
        "the Processing option Far-LoD: Folder of the programs": folder_of_settings,
        f"the environment variable {FOLDER_VARIABLE}": environment.get(FOLDER_VARIABLE, ""),
    }
    for source, folder in named.items():
        if not folder:
            continue
        program = shutil.which(name, path=os.path.expanduser(folder))
        if program is None:
            raise ProgramMissing(f"{name} is not in the folder {folder}, which {source} names: give the folder that holds it.")
        return program
    program = find_installed_program(name, environment, sys.path if python_path is None else python_path)
    if program is None:
        raise ProgramMissing(
            f"{name} was not found. Install the programs of Far-LoD, for example by unpacking their archive in your home folder or "
            f"in /opt; or name the folder that holds them in Settings > Options > Processing > Providers > Far-LoD > Folder of the "
            f"programs, in the environment variable {FOLDER_VARIABLE}, or in PATH."
        )
    return program
