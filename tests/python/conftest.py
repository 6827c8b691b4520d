# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Cities that the tests share. FARLOD_BIN is the folder of the programs, which are what the module is compared with."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import hypothesis
import numpy as np
import pytest

import farlod

# The same calls each time, unless somebody looks for more: FARLOD_RANDOM_CALLS=1
hypothesis.settings.register_profile("same", derandomize=True, database=None)
hypothesis.settings.register_profile("random", print_blob=True)
hypothesis.settings.load_profile("random" if os.environ.get("FARLOD_RANDOM_CALLS") else "same")

SOURCES = Path(__file__).resolve().parents[2]
SAMPLES = SOURCES / "datasets" / "samples"
PROGRAMS = Path(os.environ.get("FARLOD_BIN", SOURCES / "build" / "bin"))


def box_mesh(west: float, south: float, east: float, north: float, low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    """A closed box as vertices and faces, whose normals point outwards."""
    corners = [(west, south), (east, south), (east, north), (west, north)]
    vertices = np.array([(x, y, z) for z in (low, high) for x, y in corners])
    quads = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    faces = np.array([tri for a, b, c, d in quads for tri in ((a, b, c), (a, c, d))])
    return vertices, faces


def joined(*meshes: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Several meshes as one."""
    vertices, faces, count = [], [], 0
    for points, corners in meshes:
        vertices.append(points)
        faces.append(corners + count)
        count += len(points)
    return np.concatenate(vertices), np.concatenate(faces)


def run_program(name: str, *arguments: object) -> str:
    """What a program prints."""
    done = subprocess.run([PROGRAMS / name, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def village_path(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = str(tmp_path_factory.mktemp("village") / "village.farlod")
    farlod.pack(SAMPLES / "village.gml", path, cell=50.0, report=False).close()
    return path


@pytest.fixture()
def village(village_path: str) -> farlod.City:
    return farlod.open(village_path)


@pytest.fixture(scope="session")
def bridges_path(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A town's centre with bridges, arcades, courts and a tower."""
    folder = tmp_path_factory.mktemp("bridges")
    run_program("farlod-city", "-o", folder / "bridges.city.json", *"--size 300 --seed 7 --rotation 29 --lod 2 --overhangs".split())
    farlod.pack(folder / "bridges.city.json", folder / "bridges.farlod", cell=40.0, report=False).close()
    return str(folder / "bridges.farlod")


#: Height and width of the street of `canyon`, whose axis runs from south to north at x = 690000, y = 5335000.
CANYON_HEIGHT, CANYON_WIDTH, CANYON_LENGTH = 10.0, 20.0, 4000.0


@pytest.fixture(scope="session")
def canyon_path(tmp_path_factory: pytest.TempPathFactory) -> str:
    x, y, half = 690000.0, 5335000.0, CANYON_LENGTH / 2
    blocks = joined(
        box_mesh(x - 40.0, y - half, x - CANYON_WIDTH / 2, y + half, 0.0, CANYON_HEIGHT),
        box_mesh(x + CANYON_WIDTH / 2, y - half, x + 40.0, y + half, 0.0, CANYON_HEIGHT),
    )
    path = str(tmp_path_factory.mktemp("canyon") / "canyon.farlod")
    farlod.pack(blocks, path, crs="EPSG:25832", report=False).close()
    return path


@pytest.fixture()
def canyon(canyon_path: str) -> farlod.City:
    return farlod.open(canyon_path)


def points_of(city: farlod.City, count: int, seed: int = 1) -> np.ndarray:
    """Random points within the bounds of a city, (count, 2)."""
    west, south, east, north = city.bounds
    return np.random.default_rng(seed).uniform((west, south), (east, north), (count, 2))
