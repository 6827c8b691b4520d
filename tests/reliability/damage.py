#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Damages packages at random: `farlod-info --check` must tell each damage and name a file, and `farlod-svf` must answer as before or
end with an error. Neither may hang.

  damage.py BIN [--count 60] [--seed 1]        2,000 take some minutes

Prints a table of what was done; ends with 1 where one of the two failed, and says how to repeat it.
"""

import argparse
import collections
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator

TESTS = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(TESTS / "golden"))
import golden  # noqa: E402

NAMES = ("manifest.json", "tiles.bin", "far.exr", "crowns.bin", "sources.bin")
ENGINES = ("auto", "rays", "exact")
EXIT_UNUSABLE, EXIT_DAMAGED = 3, 4
SECONDS = 600


class Trial:
    """A copy of a package that is about to be damaged."""

    def __init__(self, folder: pathlib.Path, sources: list[pathlib.Path], dice: random.Random) -> None:
        self.dice, self.folder = dice, folder
        self.source = dice.choice(sources)
        self.others = [source for source in sources if source != self.source]
        self.package = folder / "city.farlod"
        shutil.copytree(self.source, self.package)

    def files(self, name: str = "*") -> list[pathlib.Path]:
        return sorted(path for path in self.package.rglob(name) if path.is_file())

    def a_file(self) -> pathlib.Path:
        return self.dice.choice(self.files())

    def change(self, how: Callable[[bytearray], object]) -> None:
        path = self.a_file()
        data = bytearray(path.read_bytes())
        how(data)
        path.write_bytes(data)

    def is_damaged(self) -> bool:
        """A swap of equal files, or zeros in the place of zeros, is none."""
        now = {p.relative_to(self.package): p for p in self.package.rglob("*")}
        then = {p.relative_to(self.source): p for p in self.source.rglob("*")}
        return now.keys() != then.keys() or any(differ(now[name], then[name]) for name in then)


def differ(now: pathlib.Path, then: pathlib.Path) -> bool:
    if now.is_symlink() or now.is_file() != then.is_file() or now.is_dir() != then.is_dir():
        return True
    return then.is_file() and now.read_bytes() != then.read_bytes()


def bit_flips(t: Trial) -> None:
    def flip(data: bytearray) -> None:
        for _ in range(t.dice.choice([1, 1, 2, 8])):
            data[t.dice.randrange(len(data))] ^= 1 << t.dice.randrange(8)

    t.change(flip)


def bytes_changed(t: Trial) -> None:
    def write(data: bytearray) -> None:
        for _ in range(t.dice.choice([1, 4, 64])):
            data[t.dice.randrange(len(data))] = t.dice.randrange(256)

    t.change(write)


def cut_short(t: Trial) -> None:
    def cut(data: bytearray) -> None:
        del data[t.dice.choice([0, 1, t.dice.randrange(len(data)), len(data) - 1]) :]

    t.change(cut)


def zeroed(t: Trial) -> None:
    def zero(data: bytearray) -> None:
        begin = t.dice.randrange(len(data))
        end = min(len(data), begin + t.dice.choice([1, 16, 512, 4096]))
        data[begin:end] = bytes(end - begin)

    t.change(zero)


def bytes_appended(t: Trial) -> None:
    t.change(lambda data: data.extend(t.dice.choice([b"\n", b"\0" * 16, t.dice.randbytes(t.dice.randint(1, 4096))])))


def bytes_lost_or_moved(t: Trial) -> None:
    def move(data: bytearray) -> None:
        begin = t.dice.randrange(len(data))
        part = data[begin : begin + t.dice.choice([1, 4, 64])]
        del data[begin : begin + len(part)]
        if t.dice.random() < 0.5:
            at = t.dice.randrange(len(data) + 1)
            data[at:at] = part

    t.change(move)


def file_deleted(t: Trial) -> None:
    t.a_file().unlink()


def folder_deleted(t: Trial) -> None:
    shutil.rmtree(t.dice.choice([p for p in t.package.rglob("*") if p.is_dir()]))


def swapped_between_blocks(t: Trial) -> None:
    files = t.files(t.dice.choice(NAMES[1:]))
    a, b = t.dice.choice(files), t.dice.choice(files)
    data = a.read_bytes()
    a.write_bytes(b.read_bytes())
    b.write_bytes(data)


def from_another_package(t: Trial) -> None:
    path = t.a_file()
    shutil.copyfile(t.dice.choice(sorted(t.dice.choice(t.others).rglob(path.name))), path)


def manifest_of_another_package(t: Trial) -> None:
    shutil.copyfile(t.dice.choice(t.others) / "manifest.json", t.package / "manifest.json")


def mixed_names(t: Trial) -> None:
    a, b = t.a_file(), t.a_file()
    shutil.copyfile(a, b) if a != b else None


def something_else(t: Trial) -> None:
    """A folder, a pipe or a link in the place of a file, or of a folder on the way to it."""
    path = t.dice.choice(sorted(p for p in t.package.rglob("*")))
    outside = t.folder / "outside"
    path.rename(outside)
    t.dice.choice(
        [
            lambda: path.mkdir(),
            lambda: os.mkfifo(path),
            lambda: path.symlink_to(outside),
            lambda: path.symlink_to("/dev/zero"),
            lambda: path.symlink_to("nowhere"),
            lambda: path.symlink_to(path.name),
            lambda: path.write_bytes(b""),
        ]
    )()


DAMAGES = [bit_flips, bit_flips, bytes_changed, cut_short, zeroed, bytes_appended, bytes_lost_or_moved, file_deleted, folder_deleted,
           swapped_between_blocks, from_another_package, manifest_of_another_package, mixed_names, something_else, something_else]


def run(*command: object) -> tuple[int, str]:
    try:
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=SECONDS, check=False, errors="replace")
    except subprocess.TimeoutExpired:
        return -1, f"no end after {SECONDS} s"
    return done.returncode, done.stdout + done.stderr


class Judge:
    def __init__(self, binaries: pathlib.Path, sources: list[pathlib.Path]) -> None:
        self.binaries = binaries
        self.undamaged: dict[tuple[str, str], bytes] = {}
        with tempfile.TemporaryDirectory() as folder:
            for source in sources:
                for engine in ENGINES:
                    code, said, table = self.evaluate(source, source, pathlib.Path(folder), engine)
                    if code != 0:
                        raise SystemExit(f"{source.name} cannot be evaluated before it is damaged: {said}")
                    self.undamaged[source.name, engine] = table

    def evaluate(self, source: pathlib.Path, package: pathlib.Path, folder: pathlib.Path, engine: str) -> tuple[int, str, bytes]:
        table = folder / "values.csv"
        table.unlink(missing_ok=True)
        code, said = run(self.binaries / "farlod-svf", package, "-o", table, "--points", golden.HERE / "points.csv", "--engine", engine,
                         "--quantity", ",".join(golden.quantities_of(source)), "--threads", "1", "--quiet")
        return code, said, table.read_bytes() if table.exists() else b""

    def findings(self, t: Trial) -> Iterator[str]:
        code, said = run(self.binaries / "farlod-info", t.package, "--check")
        # Without its manifest, it is the package of a run that was interrupted
        unfinished = code == EXIT_UNUSABLE and not os.path.lexists(t.package / "manifest.json")
        if code != EXIT_DAMAGED and not unfinished:
            yield f"farlod-info --check ends with {code}: {said}"
        if not any(name in said for name in NAMES) and "blocks" not in said:
            yield f"farlod-info --check names no file: {said}"
        engine = t.dice.choice(ENGINES)
        self.code, said, table = self.evaluate(t.source, t.package, t.folder, engine)
        if self.code == 0 and table != self.undamaged[t.source.name, engine]:
            yield f"farlod-svf --engine {engine} gives other values and no error"
        if self.code not in (0, EXIT_UNUSABLE, EXIT_DAMAGED):
            yield f"farlod-svf --engine {engine} ends with {self.code}: {said}"
        if self.code != 0 and table:
            yield f"farlod-svf --engine {engine} refuses the package, and leaves a table"


def damaged(seed: int, folder: pathlib.Path, sources: list[pathlib.Path]) -> tuple[str, Trial]:
    dice = random.Random(seed)
    for attempt in range(100):
        trial = Trial(folder / str(attempt), sources, dice)
        damage = dice.choice(DAMAGES)
        damage(trial)
        if trial.is_damaged():
            return damage.__name__.replace("_", " "), trial
    raise SystemExit(f"seed {seed} damages nothing")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path, metavar="BIN")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1, help="of the first damage; each other has the next")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        ends_well = damage_all(given, packages_to_damage(given.binaries, pathlib.Path(folder)))
    raise SystemExit(0 if ends_well else 1)


def packages_to_damage(binaries: pathlib.Path, folder: pathlib.Path) -> list[pathlib.Path]:
    """The newest version, with trees and without, and a city whose file says where its surfaces come from."""
    village = folder / "village.farlod"
    subprocess.run([binaries / "farlod-pack", TESTS.parent / "datasets/samples/village.city.json", "-o", village, "--quiet"], check=True)
    return [*golden.unpack(golden.version_of("format_version"), folder), village]


def damage_all(given: argparse.Namespace, sources: list[pathlib.Path]) -> bool:
    judge = Judge(given.binaries, sources)
    outcomes: dict[str, collections.Counter[str]] = collections.defaultdict(collections.Counter)
    failed = 0
    for seed in range(given.seed, given.seed + given.count):
        with tempfile.TemporaryDirectory() as folder:
            name, trial = damaged(seed, pathlib.Path(folder), sources)
            findings = list(judge.findings(trial))
            outcomes[name]["all"] += 1
            outcomes[name]["same" if judge.code == 0 else "refused"] += 1
            for finding in findings:
                print(f"{name} (damage.py {given.binaries} --count 1 --seed {seed}): {finding}", flush=True)
            failed += 1 if findings else 0
    print(f"{'damage':30} {'times':>6} {'refused':>8} {'not met, same values':>22}")
    for name, counts in sorted(outcomes.items()):
        print(f"{name:30} {counts['all']:6} {counts['refused']:8} {counts['same']:22}")
    print(f"{given.count} damages: {given.count - failed} told and without a wrong value, {failed} not")
    return failed == 0


if __name__ == "__main__":
    main()
