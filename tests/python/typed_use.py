# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""What users write, for mypy: it is never run."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import farlod


def street(path: str) -> npt.NDArray[np.float32]:
    with farlod.pack("town.gml", path, cell=100.0, heights=farlod.Heights(storeys="floors")) as city:
        svf = city.svf(np.zeros((3, 2)), height=2.0, engine="exact", threads=2)
        return np.asarray(svf)


def interval(city: farlod.City) -> float:
    answers = city.svf([[1.0, 2.0]], bounds=True, max_error=0.01)
    return float(np.asarray(answers.high)[0] - np.asarray(answers.low)[0])


def walls(city: farlod.City) -> object:
    def listen(stage: str, done: int, total: int) -> None:
        print(stage, done / total)

    grid = city.svf_grid(2.0, bbox=(0.0, 0.0, 10.0, 10.0), chunks=512, quantities=["hidden"])
    frame = city.surfaces("walls", spacing=1.0, progress=listen)
    print(city.cells(2.0, threads=1, progress=listen))
    print(city.view_factor_matrix("walls", spacing=1.0, rays=500).seen("sky").mean())
    print(city.evaluate([[1.0, 2.0]], quantities=["view_cube", "view_eye"], wall_sectors=8, eye_field=20.0).quantities)
    print(city.evaluate([[1.0, 2.0]], quantities=["view_building"], sees="town hall").quantities)
    try:
        city.look_up((0.0, 0.0))
    except farlod.InvalidPoint as error:
        return error.index
    return grid, frame
