# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""How values are computed, and how a run is carried out: the keyword arguments that all functions share."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Literal, TypedDict, Union, get_args

from farlod import _arguments
from farlod._modules import runtime as _runtime
from farlod.errors import InvalidArgument

Engine = Literal["auto", "horizon", "rays", "exact", "near"]
Directions = Literal["partition", "fibonacci"]
Metric = Literal["cosine", "solid"]
Above = Literal["ground", "surface", "sea"]
SkyPatches = Literal["tregenza", "reinhart"]
SkyModel = Literal["perez", "isotropic"]
Quantity = Literal[
    "svf_solid",
    "directional",
    "hidden",
    "shadow_patches",
    "irradiance",
    "illuminance",
    "shade",
    "sky_component",
    "view_factors",
    "view_factors_below",
    "view_cube",
    "view_sphere",
    "view_eye",
    "view_building",
    "svf_total",
    "svfaveg",
    "directional_vegetation",
    "shares",
]
CanopyRule = Literal["umep", "crowns", "beer"]
#: Called as ``progress(stage, done, all)`` some times a second, by the thread that called farlod; True prints a line.
ProgressListener = Callable[[str, int, int], None]
Progress = Union[bool, ProgressListener, None]


#: Options that are no settings of an evaluation by themselves.
OTHER_OPTIONS = (
    "wall_sectors",
    "eye_field",
    "sees",
    "canopy_rule",
    "leaf_off",
    "transmissivity",
    "extinction",
    "threads",
    "memory_limit",
    "progress",
)


class Options(TypedDict, total=False):
    """Keyword arguments that all evaluating functions take. Of them ``threads``, ``memory_limit`` and ``progress`` change no
    value.

    Attributes
    ----------
    engine : {"auto", "horizon", "rays", "exact", "near"}
        What answers: ``"auto"``, horizons, and rays where something overhangs; ``"horizon"`` alone; ``"rays"``, as in the
        paper; ``"exact"``, rays against the whole city: the reference; ``"near"``, the far city left out.
    azimuths : int
        Azimuths of a horizon, 4 to 1,000,000 (default: 320, or as many as ``max_error`` needs).
    rays : int
        Rays of a receiver, 1 to 10,000,000 (default: 1,000, or as many as ``max_error`` needs).
    directions : {"partition", "fibonacci"}
        Where rays go: one in each cell of the Beckers partition of the sky, or a spherical Fibonacci lattice.
    wall_sectors : {4, 8}
        Azimuths by which ``"view_factors"``, ``"view_cube"``, ``"view_sphere"`` and ``"view_eye"`` tell walls apart; 8 has
        ``view_wall_ne`` between ``view_wall_n`` and ``view_wall_e``, and so on.
    eye_field : float
        Degrees above and below the horizontal that ``"view_eye"`` looks at, 1 to 90 (default: 30); 90 is all around.
    sees : str
        The id of the building that ``"view_building"`` looks for, as ``City.surfaces`` names it.
    canopy_rule : {"umep", "crowns", "beer"}
        How light passes the crowns of trees: a share in each direction that meets any, that share of each one that is met,
        or by the length within them. Of the quantities ``"svf_total"``, ``"svfaveg"``, ``"directional_vegetation"`` and
        ``"shares"``, of light, and of hours of sunshine with ``trees``, as the next three.
    leaf_off : bool
        All crowns are bare but those that are known to be evergreen.
    transmissivity : float
        Share of light that passes a crown, 0 to 1 (default: .03, and with ``leaf_off`` .5).
    extinction : float
        Of crowns in leaf, per metre, with the rule ``"beer"`` (default: .6).
    threads : int
        0: as many as the machine has cores.
    memory_limit : int
        MiB. A run that would need more raises LimitReached before its long work (default: 1.2 times what the machine has).
    progress : bool or callable
        True prints a line; a function is called as ``progress(stage, done, all)`` some times a second. What it raises ends
        the run.
    """

    engine: Engine
    azimuths: int
    rays: int
    directions: Directions
    wall_sectors: int
    eye_field: float
    sees: str
    canopy_rule: CanopyRule
    leaf_off: bool
    transmissivity: float
    extinction: float
    threads: int
    memory_limit: int
    progress: Progress


def _print_line(stage: str, done: int, total: int) -> None:
    end = "\n" if done == total else "\r"
    print(f"{stage}: {done:,} of {total:,}", end=end, file=sys.stderr, flush=True)


def listener_of(progress: Any) -> ProgressListener | None:
    """The function that is told how far a run is. Raises InvalidArgument."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return _print_line
    if not callable(progress):
        raise InvalidArgument(f"progress is {_arguments.shown(progress)}: give True, or a function that takes (stage, done, all)")
    listener: ProgressListener = progress
    return listener


def caller_settings(module: Any, threads: Any = 0, memory_limit: Any = None, progress: Any = None) -> Any:
    """``CallerSettings`` of a compiled module. Raises InvalidArgument."""
    limit = None if memory_limit is None else _arguments.whole_number("memory_limit", memory_limit, 1, 2**40)
    return module.CallerSettings(_arguments.whole_number("threads", threads, 0, 4096), limit, listener_of(progress))


@dataclass(frozen=True)
class Evaluation:
    """What is computed at a receiver, and how exactly. Unset options are the library's."""

    metric: Metric = "cosine"
    height: float = 1.5
    above: Above = "ground"
    bounds: bool = False
    max_error: float | None = None
    quantities: Iterable[Quantity] = ()
    horizons: int = 0
    horizon_distances: bool = False
    sky_patches: str = "none"
    sun: tuple[Any, Any, Any] | None = None
    sunlit_total: bool = False
    light: Any = None  #: a farlod.Light
    region: Any = None
    within: float | None = None
    verify: int = 0
    options: Options = field(default_factory=lambda: Options())

    def placing(self) -> Any:
        """``Placing`` of the library."""
        return _runtime.Placing(
            _arguments.word("above", self.above, get_args(Above)), _arguments.number("height", self.height)
        )

    def further(self) -> Any:
        """``Quantities`` of the library."""
        asked = (self.quantities,) if isinstance(self.quantities, str) else tuple(self.quantities)
        further = _runtime.Quantities()
        for name in asked:
            further.ask(_arguments.word("quantities", name, get_args(Quantity)))
        further.svf_total_bounds = further.svf_total and _arguments.flag("bounds", self.bounds)
        further.horizons = self.horizons
        further.horizon_distances = self.horizon_distances
        further.set_sky_patches(self.sky_patches)
        self._set_views(further)
        self._set_canopy(further)
        if self.sun is not None:
            columns = [_arguments.floats("sun", values).ravel() for values in self.sun]
            if not any(column.size for column in columns):
                raise InvalidArgument("the sun's azimuths, elevations and hours are empty: give at least one position")
            further.set_sun(*columns)
        if _arguments.flag("trees", self.sunlit_total):
            further.ask("sunlit_total")
        if self.light is not None:
            self._ask_for_light(further)
        return further

    def _ask_for_light(self, further: Any) -> None:
        add_to = getattr(self.light, "_add_to", None)
        if add_to is None:
            raise InvalidArgument(f"light is a {type(self.light).__name__}: give a farlod.Light, as City.light() makes it")
        add_to(further)

    def _set_views(self, further: Any) -> None:
        if "wall_sectors" in self.options:
            further.wall_sectors = _arguments.whole_number("wall_sectors", self.options["wall_sectors"], 4, 8)
        if "eye_field" in self.options:
            further.eye_field_deg = _arguments.number("eye_field", self.options["eye_field"])
        if "sees" in self.options:
            if further.seen_building is None:
                raise InvalidArgument('sees is the building of the quantity "view_building": ask for that, too')
            if not isinstance(self.options["sees"], str):
                raise InvalidArgument(f"sees is {_arguments.shown(self.options['sees'])}: give the id of a building, as text")
            further.seen_building = self.options["sees"]

    def _set_canopy(self, further: Any) -> None:
        rule = self.options.get("canopy_rule", "umep")
        further.set_canopy_rule(_arguments.word("canopy_rule", rule, get_args(CanopyRule)))
        further.leaf_off = _arguments.flag("leaf_off", self.options.get("leaf_off", False))
        if "transmissivity" in self.options:
            further.transmissivity = _arguments.number("transmissivity", self.options["transmissivity"])
        if "extinction" in self.options:
            further.extinction = _arguments.number("extinction", self.options["extinction"])

    def settings(self) -> Any:
        """``EvaluationSettings`` of the library."""
        settings = _runtime.EvaluationSettings()
        settings.set_metric(_arguments.word("metric", self.metric, get_args(Metric)))
        settings.bounds = _arguments.flag("bounds", self.bounds)
        if self.max_error is not None:
            settings.max_error = _arguments.number("max_error", self.max_error)
        settings.further = self.further()
        settings.verify = _arguments.whole_number("verify", self.verify, 0, 10**10)
        settings.set_region(self.region)
        if self.within is not None:
            settings.within_m = _arguments.number("within", self.within)
        for name, value in self.options.items():
            if name in ("azimuths", "rays"):
                setattr(settings, name, _arguments.whole_number(name, value, 1, 10**10))
            elif name == "engine":
                settings.set_engine(_arguments.word(name, value, get_args(Engine)))
            elif name == "directions":
                settings.set_directions(_arguments.word(name, value, get_args(Directions)))
            elif name not in OTHER_OPTIONS:
                raise TypeError(f"{name!r} is no argument of this function: see farlod.Options for those that there are")
        return settings

    def caller(self) -> Any:
        """``CallerSettings`` of the library."""
        run = {name: self.options[name] for name in ("threads", "memory_limit", "progress") if name in self.options}  # type: ignore[literal-required]
        return caller_settings(_runtime, **run)
