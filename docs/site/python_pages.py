# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the pages about the Python package: one with its docstring and all its names, and one for each name.

    docs/site/python_pages.py FOLDER    ends with 1, and the reason in a line, where the package cannot be imported

What `farlod.__all__` has is public, and so are the methods and properties of its classes and the modules of the package whose
names do not begin with an underscore. Sphinx fills the pages from the docstrings.
"""
import inspect
import pathlib
import sys
import types

DIRECTIVES = {"Functions": "autofunction", "Classes": "autoclass", "Results": "autoclass", "Exceptions": "autoexception",
              "Modules": "automodule"}


def kind_of(value):
    if inspect.isclass(value):
        return "Exceptions" if issubclass(value, BaseException) else "Results" if issubclass(value, tuple) else "Classes"
    return "Modules" if inspect.ismodule(value) else "Functions" if callable(value) else "Values"


def modules_of(package):
    return [name for name, value in vars(package).items()
            if isinstance(value, types.ModuleType) and value.__name__ == f"{package.__name__}.{name}" and not name.startswith("_")]


def names_by_kind(package):
    kinds = {kind: [] for kind in ("Functions", "Classes", "Results", "Values", "Exceptions", "Modules")}
    for name in dict.fromkeys([*package.__all__, *modules_of(package)]):
        kinds[kind_of(getattr(package, name))].append(name)
    return {kind: names for kind, names in kinds.items() if names}


def members_of(cls, package):
    """Names and values of what a class has of its own, in the order of the source: nothing of a tuple or an exception."""
    ours = [base for base in reversed(cls.__mro__) if base.__module__.split(".")[0] == package.__name__]
    members = {name: value for base in ours for name, value in vars(base).items()}
    return {name: value for name, value in members.items() if not name.startswith("_")}


def methods_of(cls, package):
    kinds = (types.FunctionType, staticmethod, classmethod)
    return [name for name, value in members_of(cls, package).items() if isinstance(value, kinds) or inspect.isroutine(value)]


def properties_of(cls, package):
    return [name for name, value in members_of(cls, package).items() if isinstance(value, property)]


def title(text):
    return f"{text}\n{'=' * len(text)}\n"


def table(head, names):
    rows = "".join(f"   {name}\n" for name in names)
    return f"\n.. rubric:: {head}\n\n.. autosummary::\n   :toctree: .\n\n{rows}" if names else ""


def class_page(cls, name, package):
    methods = table("Methods", [f"~{name}.{method}" for method in methods_of(cls, package)])
    properties = "".join(f"\n.. autoproperty:: {name}.{one}\n" for one in properties_of(cls, package))
    return methods + properties


def write_page(folder, package, name, directive):
    value = getattr(package, name.split(".")[0])
    full_name = f"{package.__name__}.{name}"
    options = "" if directive in ("autofunction", "automethod") else "   :no-members:\n"
    page = title(full_name) + f"\n.. currentmodule:: {package.__name__}\n\n.. {directive}:: {full_name}\n{options}"
    if directive == "autoclass":
        page += class_page(value, name, package)
        for method in methods_of(value, package):
            write_page(folder, package, f"{name}.{method}", "automethod")
    (folder / f"{full_name}.rst").write_text(page)


def value(package, name):
    """A value has no docstring of its own: what its type says of itself would be no news."""
    return f"\n.. py:data:: {name}\n   :value: {getattr(package, name)!r}\n"


def section(package, kind, names):
    if kind == "Values":
        return f"\n.. rubric:: {kind}\n" + "".join(value(package, name) for name in names)
    return table(kind, names)


def index(folder, package):
    page = title("Python") + f"\n.. automodule:: {package.__name__}\n   :no-members:\n\n.. currentmodule:: {package.__name__}\n"
    if (folder / "README.md").exists():
        page += "\n.. toctree::\n   :hidden:\n\n   README\n"
    return page + "".join(section(package, kind, names) for kind, names in names_by_kind(package).items())


def main():
    try:
        import farlod
    except Exception as error:  # whatever it is, the site can be made without the package
        sys.exit(f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else 'no reason is given'}")
    folder = pathlib.Path(sys.argv[1])
    (folder / "index.rst").write_text(index(folder, farlod))
    for kind, names in names_by_kind(farlod).items():
        for name in names if kind in DIRECTIVES else ():
            write_page(folder, farlod, name, DIRECTIVES[kind])


if __name__ == "__main__":
    main()
