# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What the functions of farlod raise: :class:`Error`, or what derives from it.

The message says what is wrong, where, and what to do. The classes are those of the C++ library (``farlod/error.hpp``), and
derive from the built-in exception of the same meaning, too, where there is one.
"""

from __future__ import annotations

__all__ = [
    "Cancelled",
    "Error",
    "InputError",
    "InvalidArgument",
    "InvalidPoint",
    "LimitReached",
    "OutputError",
    "PackageDamaged",
    "PackageUnusable",
    "ProblemsRefused",
]


class Error(Exception):
    """Base class of all exceptions of farlod."""


class InvalidArgument(Error, ValueError):
    """A function was called with what it cannot take. Nothing was done."""


class InvalidPoint(InvalidArgument):
    """One of the points that were given cannot be one. ``index`` counts from 0."""

    def __init__(self, message: str, index: int) -> None:
        super().__init__(message)
        self.index = index

    def __reduce__(self) -> tuple[type[InvalidPoint], tuple[str, int]]:
        return type(self), (str(self), self.index)


class Cancelled(Error):
    """The run was asked to stop. What was computed is lost; no file is left half written."""


class InputError(Error):
    """A file of the user's cannot be read or used."""


class ProblemsRefused(InputError):
    """The city has problems, and ``problems="refuse"`` was asked for."""


class OutputError(Error, OSError):
    """A file cannot be written."""


class PackageUnusable(Error):
    """A package that cannot be opened or used at all: it is not there, not a package, of another version of the format, or has
    not what the settings ask for."""


class PackageDamaged(Error):
    """A package that contradicts itself: truncated, altered, or written by a faulty program."""


class LimitReached(Error, MemoryError):
    """The work needs more memory than ``memory_limit`` gives it."""
