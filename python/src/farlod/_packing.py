# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Makes packages, from files or from what Python holds."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, Union

from farlod import _arguments, _modules
from farlod._city import City
from farlod._crs import crs_text
from farlod._models import is_path, saved_model
from farlod._program_words import in_python
from farlod._receivers import is_geo
from farlod._settings import Progress, caller_settings
from farlod.errors import Error, InvalidArgument

if TYPE_CHECKING:
    import pandas


class ProblemsWarning(UserWarning):
    """The city has problems: :attr:`City.report` lists them."""


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a city: docs/problems.md has a paragraph for each code.

    ``place`` is the id of the building, the number of the feature or the line; ``position`` is easting, northing and height, or
    as the file counts.
    """

    code: int
    problem: str
    effect: str
    file: str
    place: str
    detail: str
    position: tuple[float, float, float] | None
    ring: str


@dataclass(frozen=True)
class Report:
    """What :func:`farlod.pack` found out: the problems of the city, and the figures of the run.

    Attributes
    ----------
    problems : list of Problem
        In the order in which they were met.
    facts : mapping
        ``latitude`` and ``longitude`` of the middle (WGS 84), ``heights_m`` of buildings or of the walls of a surface model,
        the range ``ground_m`` of the ground (of a surface model, of all of it),
        ``street_bearing_deg``, ``alignment_strength``, ``skipped`` features, ``notes``, ``package_bytes``, ``seconds`` of each
        stage, ...
    """

    problems: list[Problem]
    facts: Mapping[str, Any]

    def to_frame(self) -> pandas.DataFrame:
        """The problems as a table."""
        import pandas

        return pandas.DataFrame([vars(problem) for problem in self.problems], columns=list(Problem.__dataclass_fields__))

    def __str__(self) -> str:
        """A line for each kind of problem, with what is wrong with the first of them, and what to do."""
        counts = Counter(p.code for p in self.problems)
        first = {p.code: p for p in reversed(self.problems)}
        return "\n".join(
            f"{counts[code]} x {code} {p.problem} ({p.effect}): {p.place}: {p.detail}" for code, p in sorted(first.items())
        )


@dataclass(frozen=True)
class Heights:
    """Where the heights of footprints come from: names of attributes (columns), and values for features without them.

    Attributes
    ----------
    height, base, roof, storeys : str, optional
        Attributes with the height above the base, the elevation of the base, the elevation of the roof (metres), and the number
        of storeys.
    floor_height : float, default 3.0
        Metres, 1 to 20: what a storey counts, as ``--floor-height`` of ``farlod-pack`` says.
    default : float, optional
        Metres, 0.01 to 1,000: for footprints without any height.
    unknown : sequence of float
        Numbers in these attributes that mean that a height is not known, such as 0, -1 and 999.
    storey_height : float, optional
        The former name of ``floor_height``, which it replaces where it is given.
    """

    height: str | None = None
    base: str | None = None
    roof: str | None = None
    storeys: str | None = None
    floor_height: float = 3.0
    default: float | None = None
    unknown: Sequence[float] = ()
    storey_height: float | None = None


@dataclass(frozen=True)
class Trees:
    """The trees of a city: inventories, each tree with a crown of its own, and a raster of canopies.

    Attributes
    ----------
    inventory : path, GeoDataFrame, or a list of these, optional
        Points of trees or outlines of crowns, with their sizes in attributes; a table with columns ``lon`` and ``lat``, or ``x``
        and ``y``.
    height, crown, trunk : str, optional
        Attributes with a tree's height, the diameter of its crown, and the height at which the crown begins (metres). Without
        them, names that are usual are looked for.
    canopy, canopy_trunk : path or xarray.DataArray, optional
        Heights of the tops of crowns above the ground, 0 where there is none, and the heights at which these crowns begin.
    absolute : bool, default False
        Whether the heights of these rasters are elevations.
    trunk_ratio : float, default 0.25
        Share of its height at which a crown begins, where nothing else says it, 0 to 0.95.
    layer : str, optional
        Layer of an inventory of several (GeoPackage) to read.
    """

    inventory: Any = None
    height: str | None = None
    crown: str | None = None
    trunk: str | None = None
    canopy: Any = None
    canopy_trunk: Any = None
    absolute: bool = False
    trunk_ratio: float = 0.25
    layer: str | None = None


Align = Union[Literal["auto", "none"], float]


def _footprints(heights: Heights, module: Any) -> Any:
    fields = module.FootprintSettings()
    for ours, theirs in (("height", "height_field"), ("base", "base_field"), ("roof", "roof_field"), ("storeys", "storeys_field")):
        name = getattr(heights, ours)
        if name is not None:
            setattr(fields, theirs, _arguments.path(f"heights.{ours}", name))
    word = "floor_height" if heights.storey_height is None else "storey_height"
    fields.floor_height_m = _arguments.number(f"heights.{word}", getattr(heights, word))
    if heights.default is not None:
        fields.default_height_m = _arguments.number("heights.default", heights.default)
    fields.unknown_heights = _arguments.floats("heights.unknown", heights.unknown).tolist()
    return fields


def _trees(trees: Trees, module: Any, folder: str, crs: str) -> Any:
    settings = module.TreeSettings()
    if trees.inventory is not None:
        inventories = trees.inventory if isinstance(trees.inventory, list) else [trees.inventory]
        settings.set_files([saved_model(one, folder, f"trees_{n}", crs=crs).path for n, one in enumerate(inventories)])
    for ours, theirs in (("height", "height_field"), ("crown", "crown_field"), ("trunk", "trunk_field"), ("layer", "layer")):
        name = getattr(trees, ours)
        if name is not None:
            setattr(settings, theirs, _arguments.path(f"trees.{ours}", name))
    if trees.canopy is not None:
        settings.set_canopy(saved_model(trees.canopy, folder, "canopy", crs=crs).path)
    if trees.canopy_trunk is not None:
        settings.set_trunks(saved_model(trees.canopy_trunk, folder, "trunk", crs=crs).path)
    if _arguments.flag("trees.absolute", trees.absolute):
        settings.set_elevations()
    settings.trunk_ratio = _arguments.number("trees.trunk_ratio", trees.trunk_ratio)
    return settings


def _set_grid(settings: Any, cell: Any, neighborhood: Any, max_error: Any, align: Any) -> None:
    if cell is not None:
        settings.cell_edge_m = _arguments.number("cell", cell)
    if neighborhood is not None:
        settings.neighborhood = _arguments.whole_number("neighborhood", neighborhood, 1, 999)
    if max_error is not None:
        settings.max_error = _arguments.number("max_error", max_error)
    if isinstance(align, str):
        settings.set_alignment(_arguments.word("align", align, ("auto", "none")))
    else:
        settings.set_bearing(_arguments.number("align", align))


def _ground_names(names: str | Sequence[str]) -> list[str]:
    listed = [names] if isinstance(names, str) else list(names)
    if not all(isinstance(name, str) and name for name in listed):
        raise InvalidArgument(f"ground_names is {_arguments.shown(names)}: give words")
    return listed


def _set_area(settings: Any, area: Any, folder: str) -> None:
    if area is None:
        return
    if is_geo(area):
        settings.set_area_file(saved_model(area, folder, "area").path)
    elif is_path(area):
        settings.set_area_file(_arguments.path("area", area))
    else:
        settings.set_area(_arguments.bbox("area", area))


def _warn_of(problems: list[Problem]) -> None:
    if problems:
        text = str(Report(problems, {}))
        warnings.warn(f"the city has problems, which city.report lists:\n{text}", ProblemsWarning, stacklevel=3)


def pack(
    city: Any,
    path: str | os.PathLike[str],
    *,
    cell: float | None = None,
    neighborhood: int | None = None,
    max_error: float | None = None,
    terrain: Any = None,
    terrain_offset: float = 0.0,
    surface: Literal["auto", "tin"] = "auto",
    far_terrain: Any = None,
    trees: Any = None,
    heights: Heights | str | None = None,
    crs: Any = None,
    out_crs: Any = None,
    area: Any = None,
    align: Align = "auto",
    lod: int | None = None,
    layer: str | None = None,
    encoding: str | None = None,
    up: Literal["auto", "z", "y"] = "auto",
    obj_origin: Any = None,
    ground_names: str | Sequence[str] = (),
    assign: Literal["clip", "whole"] = "clip",
    far_map: Literal["horizon", "box"] = "horizon",
    overwrite: bool = False,
    problems: Literal["pack", "refuse"] = "pack",
    report: bool = True,
    threads: int = 0,
    memory_limit: int | None = None,
    progress: Progress = None,
) -> City:
    """Makes a package of a city, and opens it.

    Parameters
    ----------
    city : path, model in memory, or a list of these
        Files, folders and archives of CityGML, CityJSON, OBJ, STL, PLY, GLB, footprints of any vector format, or rasters of a
        surface model; a geopandas.GeoDataFrame of footprints, with heights in columns; a mesh as (vertices, faces), or with
        these attributes as trimesh has; an xarray.DataArray of surface heights on (y, x), in metres. All are put together.
    path : str or path-like
        The folder to make.
    cell : float, optional
        Edge of a cell in metres, 0.5 to 10,000 (default: 150, or what ``max_error`` needs).
    neighborhood : int, optional
        Cells along the edge of the near field, odd (default: 3, or what ``max_error`` needs).
    max_error : float, optional
        Chooses cells and neighborhood so that sky view factors keep this error, 0.0001 to 1.
    terrain : path, xarray.DataArray, or a list of them, optional
        Elevations of the ground, in metres; not with a surface model, which is all ground. Of several tiles, later ones lie on
        top; a path may be a folder of tiles.
    terrain_offset : float, default 0
        Metres added to them, where they count from another datum than the buildings.
    surface : {"auto", "tin"}, default "auto"
        Between pixels of a surface model stand walls where they are a step apart and slopes elsewhere, or slopes alone.
    far_terrain : path, xarray.DataArray, or a list of them, optional
        Elevations around the city, of any resolution: mountains beyond what `terrain` covers hide the sky. A path may be a
        folder of tiles.
    trees : Trees, path, GeoDataFrame, or a list of paths and GeoDataFrames, optional
        The trees of the city; anything but :class:`Trees` is an inventory.
    heights : Heights or str, optional
        Where the heights of footprints come from; a str is the attribute with the height above the base. Without it, names that
        are usual (``height``, ``measuredHeight``, ``building:levels``, ...) are looked for.
    crs, out_crs : anything that pyproj takes, optional
        Of inputs that do not say theirs, and of the package: projected, in metres (default: the input's, or UTM for degrees).
    area : (west, south, east, north), path or GeoDataFrame, optional
        Makes far maps for this part only, or adds them to the package that is there.
    align : {"auto", "none"} or float
        The grid lies along the streets, to grid north, or along a bearing in degrees clockwise from grid north.
    lod : int, optional
        Level of detail to read, 0 to 3 (default: the best from 1 to 3).
    layer : str, optional
        Layer of a file of several (GeoPackage, File Geodatabase, netCDF) to read: features or a raster.
    encoding : str, optional
        What the names and texts of Shapefiles without .cpg are in, such as ``"GBK"`` or ``"CP1252"``.
    up, obj_origin
        Which axis of meshes is up (auto: y in GLB, z in others), and (x, y, z) that is added to their coordinates.
    ground_names : str or sequence of str
        Words by which objects, groups or materials of meshes are ground, besides ``Terrain``, ``Road``, ``Water`` and others.
    assign, far_map
        ``"whole"`` and ``"box"`` are the paper's ways, to compare with.
    overwrite : bool, default False
        Whether to replace a package that is there.
    problems : {"pack", "refuse"}
        Whether a city with problems is packed.
    report : bool, default True
        Whether to keep a :class:`Report` as ``city.report``, and to warn (:class:`ProblemsWarning`) of problems.
    threads, memory_limit, progress
        As for all runs: :class:`farlod.Options`.

    Returns
    -------
    City

    Raises
    ------
    InputError
        A file cannot be read; ProblemsRefused with ``problems="refuse"``.
    OutputError
        The folder cannot be written, or is there already.
    InvalidArgument, LimitReached
        See :mod:`farlod.errors`. Ctrl-C raises KeyboardInterrupt, and leaves no package.
    ImportError
        The package farlod-preprocess is not installed.

    Examples
    --------
    >>> import tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> city = farlod.pack(village_file, folder.name + "/village.farlod")
    >>> city.info["buildings"]
    32

    Footprints in a GeoDataFrame, with their heights in a column:

    >>> import geopandas, shapely.geometry
    >>> squares = [shapely.geometry.box(x, 5.3e6, x + 20, 5.3e6 + 20) for x in (690000, 690040)]
    >>> blocks = geopandas.GeoDataFrame({"metres": [12.0, 20.0]}, geometry=squares, crs="EPSG:25832")
    >>> city = farlod.pack(blocks, folder.name + "/blocks.farlod", heights="metres")
    >>> city.info["buildings"], city.crs.to_epsg()
    (2, 25832)
    """
    module = _modules.load_preprocess()
    settings = module.PackSettings(_arguments.path("path", path))
    settings.set_words(
        _arguments.word("up", up, ("auto", "z", "y")),
        _arguments.word("assign", assign, ("clip", "whole")),
        _arguments.word("far_map", far_map, ("horizon", "box")),
        _arguments.word("surface", surface, ("auto", "tin")),
        _arguments.word("problems", problems, ("pack", "refuse")),
    )
    if _arguments.flag("overwrite", overwrite):
        settings.set_overwrite()
    _set_grid(settings, cell, neighborhood, max_error, align)
    if lod is not None:
        settings.lod = _arguments.whole_number("lod", lod, 0, 3)
    if obj_origin is not None:
        origin = _arguments.floats("obj_origin", obj_origin)
        if origin.shape != (3,):
            raise InvalidArgument(f"obj_origin is {_arguments.shown(obj_origin)}: give x, y and z")
        settings.set_obj_origin(origin.tolist())
    settings.ground_names = _ground_names(ground_names)
    settings.crs, settings.out_crs = crs_text("crs", crs), crs_text("out_crs", out_crs)
    if heights is not None and not isinstance(heights, (str, Heights)):
        raise InvalidArgument(f"heights is {_arguments.shown(heights)}: give a farlod.Heights, or the name of an attribute")
    settings.footprints = _footprints(Heights(height=heights) if isinstance(heights, str) else heights or Heights(), module)
    for name, value in (("layer", layer), ("encoding", encoding)):
        if value is not None:
            setattr(settings.footprints, name, _arguments.path(name, value))
    caller = caller_settings(module, threads, memory_limit, progress)
    rows: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory(prefix="farlod-") as folder:
        models = city if isinstance(city, list) else [city]
        for name, given, take in (
            ("city", models, settings.set_inputs),
            ("terrain", terrain, settings.set_terrain),
            ("far_terrain", far_terrain, settings.set_far_terrains),
        ):
            if given is not None:
                files = given if isinstance(given, (list, tuple)) else [given]
                take([saved_model(file, folder, f"{name}_{n}", crs=settings.crs).path for n, file in enumerate(files)])
        settings.terrain_offset_m = _arguments.number("terrain_offset", terrain_offset)
        if trees is not None:
            trees = trees if isinstance(trees, Trees) else Trees(inventory=trees)
            described = _trees(trees, module, folder, settings.crs)
            described.encoding = settings.footprints.encoding
            settings.trees = described
        _set_area(settings, area, folder)
        try:
            facts = module.pack(settings, rows, caller)
        except Error as error:
            error.args = (in_python(str(error), folder), *error.args[1:])
            raise
        finally:
            found = [replace(problem, detail=in_python(problem.detail, folder)) for problem in (Problem(**r) for r in rows)]
            if report:
                _warn_of(found)
    opened = City(path)
    opened._features_crs = next((model.geometry.crs for model in models if is_geo(model)), None)
    if report:
        notes = [in_python(note, folder) for note in facts["notes"]]
        opened._report = Report(found, {**facts, "notes": notes})
    return opened
