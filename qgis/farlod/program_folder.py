# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the programs of Far-LoD are. Needs no QGIS."""
from __future__ import annotations

import os
import shutil
from collections.abc import Mapping

FOLDER_SETTING = "FARLOD_FOLDER_OF_PROGRAMS"
FOLDER_VARIABLE = "FARLOD_BIN"


class ProgramMissing(Exception):
    """Says which program was not found, where it was looked for, and what to do."""


def find_program(name: str, folder_of_settings: str, environment: Mapping[str, str]) -> str:
    """The path of a program: in the folder of the settings, else in that of FARLOD_BIN, else along PATH.

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
    program = shutil.which(name, path=environment.get("PATH"))
    if program is None:
        raise ProgramMissing(
            f"{name} was not found. Install the programs of Far-LoD, or build them; then name the folder that holds them in "
            f"Settings > Options > Processing > Providers > Far-LoD > Folder of the programs, in the environment variable "
            f"{FOLDER_VARIABLE}, or in PATH."
        )
    return program
