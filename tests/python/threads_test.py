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
import time
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


def test_other_threads_run_meanwhile(village: farlod.City) -> None:
    points = points_of(village, 3000)
    turns, stop = 0, threading.Event()

    def count() -> None:
        nonlocal turns
        while not stop.is_set():
            turns += 1

    counter = threading.Thread(target=count)
    counter.start()
    before, begin = turns, time.perf_counter()
    village.svf(points, engine="exact", rays=3000, threads=1)
    seconds, meanwhile = time.perf_counter() - begin, turns - before
    stop.set()
    counter.join()
    # With the lock held, the other thread would not have had a turn
    assert seconds > 0.05 and meanwhile > 1000


def test_interrupt_ends_an_evaluation(village: farlod.City) -> None:
    points = points_of(village, 20000)
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        village.svf(points, engine="exact", rays=200_000)
    assert time.perf_counter() - begin < 3.0
    assert not np.isnan(village.svf(points)).all()


def test_closing_in_another_thread_leaves_runs_alone(village: farlod.City) -> None:
    points = points_of(village, 4000)
    expected = farlod.open(village.path).svf(points, engine="exact")
    with ThreadPoolExecutor(1) as pool:
        answer = pool.submit(village.svf, points, engine="exact")
        time.sleep(0.05)
        village.close()
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
    """What comes of some work in a forked process, within ten seconds."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(10)
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
