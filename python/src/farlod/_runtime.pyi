# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Types of the compiled module. Users call what farlod/__init__.py has."""

from collections.abc import Callable, Sequence
from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

_Floats32 = npt.NDArray[np.float32]
_Floats64 = npt.NDArray[np.float64]

answered_beyond_grid_m: float
version: str
words: dict[str, tuple[str, ...]]

class Package:
    def __init__(self, folder: str) -> None: ...
    @property
    def is_open(self) -> bool: ...
    def close(self) -> None: ...
    def description(self) -> dict[str, Any]: ...

class CallerSettings:
    def __init__(
        self, threads: int, memory_limit_mib: int | None, progress: Callable[[str, int, int], None] | None
    ) -> None: ...

class Placing:
    def __init__(self, above: str, height_m: float) -> None: ...

class Region:
    def __init__(self, rings_m: Sequence[Sequence[tuple[float, float]]]) -> None: ...

class Quantities:
    horizons: int
    horizon_distances: bool
    wall_sectors: int
    eye_field_deg: float
    seen_building: str | None
    svf_total: bool
    svf_total_bounds: bool
    leaf_off: bool
    transmissivity: float | None
    extinction: float
    def __init__(self) -> None: ...
    def set_sky_patches(self, patches: str) -> None: ...
    def set_canopy_rule(self, rule: str) -> None: ...
    def set_sun(self, azimuth_deg: _Floats64, elevation_deg: _Floats64, hours: _Floats64) -> None: ...
    def set_light(
        self,
        direct_normal_w_m2: _Floats64,
        diffuse_w_m2: _Floats64,
        direct_normal_lux: _Floats64,
        diffuse_lux: _Floats64,
        hours: _Floats64,
        extraterrestrial_w_m2: _Floats64,
        month: _Floats64,
        begin_s: _Floats64,
        sun_count: _Floats64,
        sun_azimuth_deg: _Floats64,
        sun_elevation_deg: _Floats64,
        sun_hours: _Floats64,
        sky_model: str,
        ground_albedo: float,
        facade_albedo: float,
        by_month: bool,
        by_step: bool,
    ) -> None: ...
    def ask(self, word: str) -> None: ...
    def columns(self) -> list[str]: ...
    def descriptions(self) -> list[tuple[str, str, str]]: ...

class EvaluationSettings:
    azimuths: int | None
    rays: int | None
    max_error: float | None
    bounds: bool
    verify: int
    dry_run: bool
    within_m: float | None
    further: Quantities
    def __init__(self) -> None: ...
    def set_engine(self, engine: str) -> None: ...
    def set_metric(self, metric: str) -> None: ...
    def set_directions(self, directions: str) -> None: ...
    def set_region(self, region: Region | None) -> None: ...

class PointColumns:
    def __init__(
        self,
        x_m: _Floats64,
        y_m: _Floats64,
        z_m: _Floats64 | None,
        azimuth_deg: _Floats64 | None,
        tilt_deg: _Floats64 | None,
    ) -> None: ...

class RasterPlan:
    def __init__(self, north_west_m: tuple[float, float], step_m: float, columns: int, rows: int) -> None: ...
    @property
    def north_west_m(self) -> tuple[float, float]: ...
    @property
    def step_m(self) -> float: ...
    @property
    def columns(self) -> int: ...
    @property
    def rows(self) -> int: ...

class _PointAnswers(TypedDict):
    svf: _Floats32
    low: _Floats32
    high: _Floats32
    height_m: _Floats64
    further: _Floats32
    summary: dict[str, Any]

class _Raster(TypedDict):
    svf: _Floats32
    low: _Floats32 | None
    high: _Floats32 | None
    further: list[_Floats32]
    summary: dict[str, Any]

class _Hemisphere(TypedDict):
    svf: float
    height_m: float
    parts: npt.NDArray[np.uint8]
    horizon_tangent: _Floats32

class _PeriodLight(TypedDict):
    intervals: dict[str, _Floats64]
    sun_count: _Floats64
    suns: dict[str, _Floats64]
    hours: float
    source: str
    remarks: list[str]

class _Surfaces(TypedDict):
    means: dict[str, Any]
    points: dict[str, Any]
    summary: dict[str, Any]

class _ViewFactorMatrix(TypedDict):
    data: _Floats32
    indices: npt.NDArray[np.int32]
    indptr: npt.NDArray[np.int64]
    building: list[str]
    surface: npt.NDArray[np.uint32]
    area_m2: _Floats64
    ground_cells: npt.NDArray[np.int32]
    ground_centres_m: _Floats64
    figures: dict[str, Any]

class _Cells(TypedDict):
    i: npt.NDArray[np.int32]
    j: npt.NDArray[np.int32]
    corners_m: _Floats64
    columns: dict[str, _Floats64]

def cells_of(
    package: Package, svf_spacing_m: float | None, settings: EvaluationSettings, caller: CallerSettings
) -> _Cells: ...
def zones_of(
    package: Package,
    zones_m: Sequence[Sequence[Sequence[tuple[float, float]]]],
    svf_spacing_m: float | None,
    settings: EvaluationSettings,
    caller: CallerSettings,
) -> dict[str, _Floats64]: ...
def evaluate_points(
    package: Package, points: PointColumns, placing: Placing, settings: EvaluationSettings, caller: CallerSettings
) -> _PointAnswers: ...
def plan_raster(package: Package, step_m: float, bbox_m: tuple[float, float, float, float] | None) -> RasterPlan: ...
def plan_of_surface_model(package: Package, bbox_m: tuple[float, float, float, float] | None) -> RasterPlan | None: ...
def evaluate_raster(
    package: Package, plan: RasterPlan, placing: Placing, settings: EvaluationSettings, caller: CallerSettings
) -> _Raster: ...
def evaluate_window(
    package: Package,
    plan: RasterPlan,
    window: tuple[int, int, int, int],
    placing: Placing,
    settings: EvaluationSettings,
    caller: CallerSettings,
) -> _Raster: ...
def look_up(
    package: Package,
    place_m: tuple[float, float],
    height_m: float | None,
    placing: Placing,
    settings: EvaluationSettings,
    caller: CallerSettings,
) -> _Hemisphere | None: ...
def evaluate_surfaces(
    package: Package,
    which: str,
    spacing_m: float,
    irradiation_threshold_kwh_m2: float | None,
    points: bool,
    settings: EvaluationSettings,
    caller: CallerSettings,
) -> _Surfaces: ...
def view_factor_matrix(
    package: Package,
    which: str,
    spacing_m: float,
    threshold: float,
    settings: EvaluationSettings,
    caller: CallerSettings,
) -> _ViewFactorMatrix: ...
def light_of_period(
    weather_file: str, period: str, step_minutes: int, linke_turbidity: float, longitude_deg: float, latitude_deg: float
) -> _PeriodLight: ...
def global_horizontal_kwh_m2(
    direct_normal_w_m2: _Floats64,
    diffuse_w_m2: _Floats64,
    direct_normal_lux: _Floats64,
    diffuse_lux: _Floats64,
    hours: _Floats64,
    extraterrestrial_w_m2: _Floats64,
    month: _Floats64,
    begin_s: _Floats64,
    sun_count: _Floats64,
    sun_azimuth_deg: _Floats64,
    sun_elevation_deg: _Floats64,
    sun_hours: _Floats64,
) -> float: ...
def check_package(package: Package, caller: CallerSettings) -> dict[str, Any]: ...
def ground_heights(package: Package, plan: RasterPlan, caller: CallerSettings) -> _Floats32: ...
def building_outlines(
    package: Package, bbox_m: tuple[float, float, float, float], caller: CallerSettings
) -> _Floats64: ...
def surface_polygons(package: Package, caller: CallerSettings) -> list[tuple[str, int, bytes]]: ...
