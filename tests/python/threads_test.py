# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Threads, processes, interrupts."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import threading
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from conftest import points_of

import farlod


def test_eight_threads_on_one_city_give_the_same_bits(bridges_path: str) -> None:
    city = farlod.open(bridges_path)
    points = points_of(city, 3000)
    expected = city.svf(points, threads=1)
    grid = city.svf_grid(2.0, threads=1).svf.values
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda _: city.svf(points), range(24)))
        grids = list(pool.map(lambda _: city.svf_grid(2.0).svf.values, range(8)))
    for answer in answers:
        np.testing.assert_array_equal(answer, expected)
    for other in grids:
        np.testing.assert_array_equal(other, grid)


class Counter(threading.Thread):
    """Counts turns of a loop, which needs the interpreter, and interrupts the process after a hundred thousand."""

    def __init__(self) -> None:
        super().__init__()
        self.turns = 0

    def run(self) -> None:
        while self.turns < 100_000:
            self.turns += 1
        os.kill(os.getpid(), signal.SIGINT)


def test_other_threads_run_meanwhile_and_an_interrupt_ends_an_evaluation(village: farlod.City) -> None:
    # It would take an hour: a run that kept the interpreter, or did not listen, would outlast ctest's limit
    points = np.tile(points_of(village, 20_000), (50, 1))
    counter = Counter()
    with pytest.raises(KeyboardInterrupt):
        counter.start()
        village.svf(points, engine="exact", rays=200_000)
    counter.join()
    assert not np.isnan(village.svf(points[:20_000])).all()


def test_closing_in_another_thread_leaves_runs_alone(village: farlod.City) -> None:
    points = points_of(village, 4000)
    expected = farlod.open(village.path).svf(points, engine="exact")
    begun, closed = threading.Event(), threading.Event()

    def wait_until_closed(*_: object) -> None:
        begun.set()
        closed.wait()

    with ThreadPoolExecutor(1) as pool:
        answer = pool.submit(village.svf, points, engine="exact", progress=wait_until_closed)
        begun.wait()
        village.close()
        closed.set()
        np.testing.assert_array_equal(answer.result(), expected)
    assert village.closed
    with pytest.raises(farlod.InvalidArgument, match="closed"):
        village.svf(points)


def test_pickled_city_opens_again(village: farlod.City) -> None:
    points = points_of(village, 100)
    again = pickle.loads(pickle.dumps(village))
    np.testing.assert_array_equal(again.svf(points), village.svf(points))
    village.close()
    assert not again.closed and again.info == village.info
    with pytest.raises(farlod.InvalidArgument):
        pickle.dumps(village)


def test_pickled_city_that_is_gone(village: farlod.City, tmp_path) -> None:  # type: ignore[no-untyped-def]
    import shutil

    shutil.copytree(village.path, tmp_path / "copy.farlod")
    data = pickle.dumps(farlod.open(tmp_path / "copy.farlod"))
    shutil.rmtree(tmp_path / "copy.farlod")
    with pytest.raises(farlod.PackageUnusable):
        pickle.loads(data)


def test_exceptions_survive_processes(village: farlod.City) -> None:
    points = np.array([[np.nan, 0.0]])
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        with pytest.raises(farlod.InvalidPoint) as raised:
            pool.submit(village.svf, points).result()
    assert raised.value.index == 0


def in_fork(work) -> str:  # type: ignore[no-untyped-def]
    """What comes of some work in a forked process, within ten minutes."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(600)
        try:
            message = str(work())
        except farlod.Error as error:
            message = f"refused: {error}"
        os.write(writer, message.encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as pipe:
        message = pipe.read()
    os.waitpid(child, 0)
    return message


FORK_BEFORE_USE = """
import sys, farlod
from threads_test import in_fork
city = farlod.open(sys.argv[1])
west, south, east, north = city.bounds
print(in_fork(lambda: city.svf([[(west + east) / 2, south + 3.0, 300.0]])[0]))
"""


def test_fork_after_opening_works(village_path: str) -> None:
    import subprocess

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")])}
    command = [sys.executable, "-c", FORK_BEFORE_USE, village_path]
    assert subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout == "1.0\n"


def test_fork_after_use_is_refused(village: farlod.City) -> None:
    points = points_of(village, 10)
    village.svf(points)
    assert in_fork(lambda: village.svf(points)).startswith("refused: this process was forked")
