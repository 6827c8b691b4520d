# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders in which programs write, so that a run that is cancelled or fails leaves nothing behind. Needs no QGIS.

A program that is ended by force cannot remove its unfinished files. So it writes into a folder of its own beside the result,
and what it has written is moved to its place when it has succeeded.
"""
from __future__ import annotations

import os
import pathlib
import shutil
import tempfile
from types import TracebackType

# What a package consists of: docs/package_format.md
MANIFEST, BLOCKS = "manifest.json", "blocks"
PARTS = (MANIFEST, BLOCKS, "crowns.bin", "far_terrain.bin", "heights.bin", "sources.bin")


class OutputRefused(Exception):
    """Says why a result cannot be written there, and what to do."""


class Staging:
    """A temporary folder beside `destination`, on the same disk."""

    def __init__(self, destination: str) -> None:
        self.destination = pathlib.Path(destination).absolute()
        parent = self.destination.parent
        if not parent.is_dir():
            missing = f"there is no folder {parent}; make it first, or choose another"
            raise OutputRefused(f"{destination} cannot be written: {missing}.")
        try:
            self.folder = pathlib.Path(tempfile.mkdtemp(prefix=".farlod-", dir=parent))
        except OSError as reason:
            raise OutputRefused(f"{destination} cannot be written: {reason.strerror}.") from reason
        self.results = self.folder / "results"
        self.results.mkdir()
        self.result = self.results / self.destination.name

    def __enter__(self) -> Staging:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    def hand_over(self) -> None:
        """Moves all results to their places, the one of `destination` last."""
        companions = sorted(path for path in self.results.iterdir() if path != self.result)
        for path in [*companions, self.result]:
            os.replace(path, self.destination.parent / path.name)

    def hand_over_package(self) -> None:
        """Moves the package to its place; one that is there already goes away with the temporary folder."""
        if self.destination.exists():
            os.rename(self.destination, self.folder / "replaced")
        os.rename(self.result, self.destination)


def require_room_for_package(folder: pathlib.Path, overwrite: bool) -> None:
    """The rules of farlod-pack, which cannot apply them itself when it writes elsewhere."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise OutputRefused(f"{folder} is a file: choose another name for the package.")
    strangers = sorted(path.name for path in folder.iterdir() if path.name not in PARTS)
    if strangers:
        raise OutputRefused(f"{folder} holds {strangers[0]}, which is not part of a package: choose another folder.")
    if not overwrite and any(folder.iterdir()):
        raise OutputRefused(f"{folder} exists already: let it be replaced (Replace a package that is there), or choose another.")


class NothingUnfinished:
    """Far maps are added to a package beside it, in NAME.unfinished. When that fails, the folder goes away; but one that was there
    before stays, since it may be that of another process, or hold what an interrupted run has finished."""

    def __init__(self, package: pathlib.Path) -> None:
        self._folder = package.with_name(package.name + ".unfinished")
        self._was_there = False

    def __enter__(self) -> None:
        self._was_there = self._folder.exists()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is not None and not self._was_there:
            shutil.rmtree(self._folder, ignore_errors=True)
