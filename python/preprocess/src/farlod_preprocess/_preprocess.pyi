# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of the compiled module. Users call farlod.pack()."""

from collections.abc import Callable, Sequence
from typing import Any

version: str

class CallerSettings:
    def __init__(
        self, threads: int, memory_limit_mib: int | None, progress: Callable[[str, int, int], None] | None
    ) -> None: ...

class FootprintSettings:
    height_field: str | None
    base_field: str | None
    storeys_field: str | None
    roof_field: str | None
    floor_height_m: float
    default_height_m: float | None
    unknown_heights: list[float]
    layer: str | None
    encoding: str | None
    def __init__(self) -> None: ...

class TreeSettings:
    height_field: str | None
    crown_field: str | None
    trunk_field: str | None
    trunk_ratio: float
    def __init__(self) -> None: ...
    def set_files(self, files: Sequence[str]) -> None: ...
    def set_canopy(self, file: str) -> None: ...
    def set_trunks(self, file: str) -> None: ...
    def set_elevations(self) -> None: ...

class PackSettings:
    terrain_offset_m: float
    crs: str
    out_crs: str
    lod: int | None
    ground_names: Sequence[str]
    footprints: FootprintSettings
    trees: TreeSettings
    cell_edge_m: float | None
    neighborhood: int | None
    max_error: float | None
    def __init__(self, output: str) -> None: ...
    def set_inputs(self, inputs: Sequence[str]) -> None: ...
    def set_terrain(self, terrain: str) -> None: ...
    def set_obj_origin(self, origin_m: Sequence[float]) -> None: ...
    def set_bearing(self, bearing_deg: float) -> None: ...
    def set_alignment(self, word: str) -> None: ...
    def set_area(self, bbox_m: Sequence[float]) -> None: ...
    def set_area_file(self, file: str) -> None: ...
    def set_words(self, up: str, assign: str, far_map: str, problems: str) -> None: ...
    def set_overwrite(self) -> None: ...

def pack(settings: PackSettings, problems: list[dict[str, Any]], caller: CallerSettings) -> dict[str, Any]: ...
