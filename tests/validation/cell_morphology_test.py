#!/usr/bin/python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Compares farlod-info --cells on the footprints of Omiya with what GDAL and OGR say of them.

Plan areas and volumes are those of OGR's unions and differences. Walls are the sides of the footprints, up to the height,
less what stands back to back with a side of another one within two centimetres. Usage: cell_morphology_test.py BIN
"""
from __future__ import annotations

import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
from collections import defaultdict

try:
    import numpy as np
    from osgeo import ogr, osr
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ogr.UseExceptions()
osr.UseExceptions()

PARTY_WALL_M = 0.02  # farlod::party_wall_m
ALIKE = 0.9998  # as party walls are parallel
BUCKET_M = 20.0


def crs(epsg: int) -> osr.SpatialReference:
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(epsg)
    reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    return reference


def polygons_of(shape: ogr.Geometry) -> list[ogr.Geometry]:
    if shape.GetGeometryName() == "POLYGON":
        return [shape.Clone()]
    return [p for k in range(shape.GetGeometryCount()) for p in polygons_of(shape.GetGeometryRef(k))]


def footprints(path: pathlib.Path, epsg: int) -> list[tuple[ogr.Geometry, float]]:
    transformation = osr.CoordinateTransformation(crs(4326), crs(epsg))
    result = []
    dataset = ogr.Open(str(path))
    for feature in dataset.GetLayer():
        shape = feature.GetGeometryRef().Clone()
        shape.Transform(transformation)
        valid = shape if shape.IsValid() else shape.MakeValid()
        result += [(p, feature.GetField("TAKASA")) for p in polygons_of(valid)]
    return result


def plan_and_volume(buildings: list[tuple[ogr.Geometry, float]]) -> tuple[float, float]:
    """From the highest building to the lowest, what none before it covers."""
    buildings = sorted(buildings, key=lambda b: -b[1])
    boxes = np.array([p.GetEnvelope() for p, _ in buildings])
    area = volume = 0.0
    for n, (seen, height) in enumerate(buildings):
        w, e, s, north = boxes[n]
        before = boxes[:n]
        near = (before[:, 0] <= e) & (before[:, 1] >= w) & (before[:, 2] <= north) & (before[:, 3] >= s)
        for k in np.nonzero(near)[0]:
            seen = seen.Difference(buildings[k][0])
        area += seen.Area()
        volume += seen.Area() * height
    return area, volume


class Sides:
    """The sides of all footprints, whose outer side is to the right."""

    def __init__(self, buildings: list[tuple[ogr.Geometry, float]]) -> None:
        rows = []
        for polygon, height in buildings:
            for k in range(polygon.GetGeometryCount()):
                ring = np.array(polygon.GetGeometryRef(k).GetPoints())[:, :2]
                x, y = (ring - ring[0]).T
                counter_clockwise = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) > 0.0
                if counter_clockwise != (k == 0):
                    ring = ring[::-1]
                rows += [(*a, *b, height) for a, b in zip(ring[:-1], ring[1:]) if not np.array_equal(a, b)]
        table = np.array(rows)
        self.a, self.b, self.height = table[:, :2], table[:, 2:4], table[:, 4]
        self.length = np.hypot(*(self.b - self.a).T)
        self.along = (self.b - self.a) / self.length[:, None]
        self.outward = np.stack([self.along[:, 1], -self.along[:, 0]], 1)
        self.buckets: dict[tuple[int, int], list[int]] = defaultdict(list)
        for n in range(len(rows)):
            for key in self.keys_of(n):
                self.buckets[key].append(n)

    def keys_of(self, n: int) -> list[tuple[int, int]]:
        low = np.floor((np.minimum(self.a[n], self.b[n]) - PARTY_WALL_M) / BUCKET_M).astype(int)
        high = np.floor((np.maximum(self.a[n], self.b[n]) + PARTY_WALL_M) / BUCKET_M).astype(int)
        return [(i, j) for i in range(low[0], high[0] + 1) for j in range(low[1], high[1] + 1)]

    def span_of(self, n: int, other: int) -> tuple[float, float]:
        """Where along a side another one is as close as a party wall; empty where the second number is not larger."""
        ends = np.stack([self.a[other], self.b[other]]) - self.a[n]
        off = ends @ self.outward[n]
        begin, end = 0.0, 1.0
        for inside in (PARTY_WALL_M - off, PARTY_WALL_M + off):
            if inside.max() < 0.0:
                return 0.0, 0.0
            if inside[0] < 0.0:
                begin = max(begin, inside[0] / (inside[0] - inside[1]))
            if inside[1] < 0.0:
                end = min(end, inside[0] / (inside[0] - inside[1]))
        if begin >= end:
            return 0.0, 0.0
        first, last = ends @ self.along[n]
        places = sorted(first + share * (last - first) for share in (begin, end))
        return max(0.0, places[0]), min(self.length[n], places[1])

    def party_area(self, n: int) -> float:
        others = np.array(sorted({k for key in self.keys_of(n) for k in self.buckets[key]}))
        others = others[self.outward[others] @ self.outward[n] <= -ALIKE]
        spans = [(*self.span_of(n, k), min(self.height[n], self.height[k])) for k in others]
        spans = [s for s in spans if s[1] > s[0]]
        ends = sorted({x for s in spans for x in s[:2]})
        return sum(
            (v - u) * max((s[2] for s in spans if s[0] <= 0.5 * (u + v) <= s[1]), default=0.0)
            for u, v in zip(ends[:-1], ends[1:])
        )

    def areas(self) -> np.ndarray:
        return self.length * self.height - np.array([self.party_area(n) for n in range(len(self.length))])


def table_of(bin_folder: pathlib.Path, city: pathlib.Path, folder: pathlib.Path, cell_m: int) -> tuple[dict, dict]:
    """Sums over cells, and what the package says of itself."""
    package, table = folder / f"city{cell_m}.farlod", folder / f"cells{cell_m}.csv"
    subprocess.run([bin_folder / "farlod-pack", city, "--height-field", "TAKASA", "--cell", str(cell_m), "--quiet", "-o", package],
                   check=True)
    said = subprocess.run([bin_folder / "farlod-info", package, "--cells", table, "--json"], check=True, capture_output=True)
    rows = list(csv.DictReader(table.open()))
    sums = {name: sum(float(row[name]) for row in rows)
            for name in ("building_plan_area_m2", "building_volume_m3", "wall_area_m2")}
    for name in ("lambda_f_000", "lambda_f_045", "lambda_f_090"):
        sums[name] = sum(float(row[name]) * float(row["area_m2"]) for row in rows)
    return sums, json.loads(said.stdout)


def expected_of(city: pathlib.Path, facts: dict) -> dict[str, float]:
    buildings = footprints(city, facts["crs"]["epsg"])
    sides = Sides(buildings)
    walls = sides.areas()
    expected = dict(zip(("building_plan_area_m2", "building_volume_m3"), plan_and_volume(buildings)))
    expected["wall_area_m2"] = float(walls.sum())
    for degrees in (0, 45, 90):
        azimuth = math.radians(degrees - facts["grid"]["convergence_deg"])
        faced = sides.outward @ np.array([math.sin(azimuth), math.cos(azimuth)])
        expected[f"lambda_f_{degrees:03d}"] = float(np.sum(walls * np.maximum(0.0, faced)))
    return expected


def main() -> int:
    default = pathlib.Path(__file__).resolve().parents[2].parent / "shared" / "data"
    city = pathlib.Path(os.environ.get("FARLOD_TEST_DATA", default)) / "omiya" / "omiya.geojson"
    if not city.is_file():
        print(f"skipped: {city} is not there")
        return 77
    failures = 0
    expected: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        for cell_m in (50, 200):
            sums, facts = table_of(pathlib.Path(sys.argv[1]), city, pathlib.Path(folder), cell_m)
            expected = expected or expected_of(city, facts)
            for name, value in expected.items():
                # Tables have six digits of a share and millimetres of an area
                difference = abs(sums[name] - value) / value
                is_right = difference <= 1e-6
                failures += not is_right
                print(f"cells of {cell_m} m: {name} {sums[name]:.2f}, OGR {value:.2f}, {difference:.1e}{'' if is_right else ' WRONG'}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
