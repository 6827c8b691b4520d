# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a folder of programs and modules independent of the system: with their libraries and data, found relative to themselves.

What stays the system's is glibc, which is one with the kernel's and the dynamic linker's ways, and is compatible upwards. README.md
says where everything lies.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2]
#: Within a prefix: a prefix of its own, so that nothing else finds these libraries, and PROJ finds its data by its own rule.
PRIVATE = Path("lib/farlod")
#: Data of libraries, and the Debian packages that they come from.
DATA = {
    "proj-data": (Path("/usr/share/proj"), Path("share/proj")),
    "gdal-data": (Path("/usr/share/gdal"), Path("share/farlod/gdal")),
    "fonts-dejavu-core": (Path("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"), Path("share/farlod/fonts/DejaVuSans.ttf")),
}
#: oneTBB looks for its allocator by this name, beside itself.
KEEPS_ITS_NAME = re.compile(r"libtbbmalloc\.so")


@dataclass(frozen=True)
class Library:
    """A library of the system, and the Debian package that brought it."""

    path: Path
    package: str


def output_of(*command: object, check: bool = True) -> str:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if check and done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def require_tools(*tools: str) -> None:
    missing = [tool for tool in tools if shutil.which(tool) is None]
    if missing:
        raise SystemExit(f"not installed: {', '.join(missing)} (scripts/install-dependencies packages)")


def version_of(build: Path) -> str:
    """The version that a build folder of CMake is of."""
    found = re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.+)$", (build / "CMakeCache.txt").read_text(encoding="utf-8"), re.MULTILINE)
    if found is None:
        raise SystemExit(f"{build} was not configured by CMake")
    return found[1]


def set_date_of_sources() -> None:
    """Same sources, same bytes: what has a date has that of the sources."""
    if "SOURCE_DATE_EPOCH" not in os.environ:
        os.environ["SOURCE_DATE_EPOCH"] = output_of("git", "-C", SOURCES, "log", "-1", "--format=%ct").strip()


def elf_files(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink():
            with path.open("rb") as file:
                if file.read(4) == b"\x7fELF":
                    yield path


def paths_of_libraries(files: Collection[Path]) -> dict[str, Path]:
    """All shared libraries that these files need, and those that they need in turn: path by the name that is asked for."""
    found = {}
    for file in files:
        for name, path in re.findall(r"^\s*(\S+) => (.+?)(?: \(0x[0-9a-f]+\))?$", output_of("ldd", file), re.MULTILINE):
            if path == "not found":
                raise SystemExit(f"{file} needs {name}, which is not installed here")
            found[name] = Path(path)
    return found


def packages_of(paths: Collection[Path]) -> dict[Path, str]:
    """The Debian package that each of these files is from."""
    # A package may name its file as it was before /lib became a link to /usr/lib
    spelt = {path: {str(path), str(path.resolve()), str(path.resolve()).removeprefix("/usr")} for path in paths}
    lines = output_of("dpkg-query", "--search", *sorted(set().union(*spelt.values())), check=False).splitlines()
    # A package that moves a file of another one is named for it, too, in a line of its own
    owned = (line.partition(": ") for line in lines if not line.startswith(("diversion by", "local diversion")))
    owners = {path: package.split(":")[0] for package, _, path in owned}
    found = {path: next((owners[name] for name in sorted(names) if name in owners), "") for path, names in spelt.items()}
    foreign = sorted(str(path) for path, package in found.items() if not package)
    if foreign:
        raise SystemExit(f"these libraries are from no Debian package, so that their licence is unknown: {', '.join(foreign)}")
    return found


def libraries_of(files: Collection[Path], of_system: Collection[str]) -> dict[str, Library]:
    """The libraries to bring along: all but those of the packages `of_system`."""
    paths = paths_of_libraries(files)
    packages = packages_of(set(paths.values()))
    return {name: Library(path.resolve(), packages[path]) for name, path in sorted(paths.items()) if packages[path] not in of_system}


def name_of_its_own(name: str, path: Path) -> str:
    """A name that no other copy of the library has: a process that has loaded one of the same name would take that for ours."""
    if KEEPS_ITS_NAME.match(name):
        return name
    stem, so, version = name.partition(".so")
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}{so}{version}"


def lead_to_libraries(file: Path, folder: Path, names: dict[str, str], own_name: str = "") -> None:
    """Lets a file find its libraries in `folder`, relative to itself, and by their new names."""
    needed = output_of("patchelf", "--print-needed", file).split()
    renamed = [word for name in needed if names.get(name, name) != name for word in ("--replace-needed", name, names[name])]
    # Without "/." for a neighbour, which PROJ would take for a folder when it counts upwards to its data
    origin = "$ORIGIN" if folder == file.parent else f"$ORIGIN/{os.path.relpath(folder, file.parent)}"
    # A run path of the old kind: it comes before LD_LIBRARY_PATH, which leads to other versions where modules or conda set it
    changes = [["--force-rpath", "--set-rpath", origin], renamed, ["--set-soname", own_name] if own_name else []]
    # One after another: patchelf 0.14 has one place for the values of all of them
    for change in filter(None, changes):
        output_of("patchelf", *change, file)


def bring_libraries(root: Path, prefix: Path, of_system: Collection[str], own_names: bool) -> set[str]:
    """Copies what the files below `root` need into `prefix`, and leads them there. Returns the packages of the libraries."""
    files = list(elf_files(root))
    libraries = libraries_of(files, of_system)
    folder = prefix / PRIVATE / "lib"
    folder.mkdir(parents=True)
    names = {name: name_of_its_own(name, library.path) if own_names else name for name, library in libraries.items()}
    for file in files:
        lead_to_libraries(file, folder, names)
    for name, library in libraries.items():
        copy = folder / names[name]
        shutil.copyfile(library.path, copy)
        lead_to_libraries(copy, folder, names, names[name])
    return {library.package for library in libraries.values()}


def bring_data(prefix: Path) -> set[str]:
    """Copies the data of libraries. Returns their packages."""
    for source, target in DATA.values():
        copy = prefix / PRIVATE / target
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy)
        else:
            shutil.copyfile(source, copy)
    shutil.copyfile(Path(__file__).parent / "fonts.conf", prefix / PRIVATE / "share/farlod/fonts.conf")
    return set(DATA)


def bring_licences(prefix: Path, packages: Collection[str]) -> None:
    """Ours, and those of the Debian packages that something is from, with their versions: Debian has their sources."""
    documents = prefix / "share/doc/farlod"
    licences = documents / "copyright"
    licences.mkdir(parents=True)
    for package in packages:
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", licences / package)
    # Which the licences of Debian refer to
    shutil.copytree("/usr/share/common-licenses", licences / "common-licenses")
    shutil.copyfile(SOURCES / "packaging/debian/copyright", licences / "farlod")
    shutil.copytree(SOURCES / "LICENSES", licences / "LICENSES")
    shutil.copyfile(Path(__file__).parent / "README.md", documents / "README.md")
    lines = output_of("dpkg-query", "--show", "--showformat=${Package} ${Version} (source: ${source:Package} ${source:Version})\n", *packages)
    (documents / "packages.txt").write_text("".join(sorted(set(lines.splitlines(keepends=True)))), encoding="utf-8")


def install_programs(build: Path, prefix: Path) -> None:
    output_of("cmake", "--install", build, "--component", "programs", "--prefix", prefix, "--strip")


def bundle(root: Path, prefix: Path, of_system: Collection[str], own_names: bool) -> None:
    """Brings libraries, data and licences into `prefix`, for all that is below `root`."""
    bring_licences(prefix, sorted(bring_libraries(root, prefix, of_system, own_names) | bring_data(prefix)))
    # Neither the build nor the user's umask is to be seen
    output_of("chmod", "-R", "u=rwX,go=rX", root)
