# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""The programs that this wheel brings along, as commands. Not in the package farlod, which takes a while to import."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def run() -> None:
    """Becomes the program that the command is called after."""
    program = Path(__file__).parent / "farlod" / "_prefix" / "bin" / Path(sys.argv[0]).name
    os.execv(program, [str(program), *sys.argv[1:]])
