# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the page about the Python package: its docstring, its values, and its other public names by kind, each with a page.

    docs/site/python_pages.py FILE.rst    ends with 1, and the reason in a line, where the package cannot be imported

What `farlod.__all__` has is public, and nothing else is.
"""
import inspect
import pathlib
import sys

HEAD = """Python
======

.. automodule:: farlod
   :no-members:

.. currentmodule:: farlod
"""


def kind_of(value):
    if inspect.isclass(value):
        return "Exceptions" if issubclass(value, BaseException) else "Results" if issubclass(value, tuple) else "Classes"
    return "Functions" if callable(value) else "Values"


def names_by_kind(package):
    kinds = {kind: [] for kind in ("Functions", "Classes", "Results", "Values", "Exceptions")}
    for name in package.__all__:
        kinds[kind_of(getattr(package, name))].append(name)
    return {kind: names for kind, names in kinds.items() if names}


def value(package, name):
    """A value has no docstring of its own: what its type says of itself would be no news."""
    return f"\n.. py:data:: {name}\n   :value: {getattr(package, name)!r}\n"


def section(package, kind, names):
    head = f"\n.. rubric:: {kind}\n"
    if kind == "Values":
        return head + "".join(value(package, name) for name in names)
    rows = "".join(f"   {name}\n" for name in names)
    return f"{head}\n.. autosummary::\n   :toctree: .\n\n{rows}"


def main():
    try:
        import farlod
    except Exception as error:  # whatever it is, the site can be made without the package
        sys.exit(f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else 'no reason is given'}")
    page = HEAD + "".join(section(farlod, kind, names) for kind, names in names_by_kind(farlod).items())
    pathlib.Path(sys.argv[1]).write_text(page)


if __name__ == "__main__":
    main()
