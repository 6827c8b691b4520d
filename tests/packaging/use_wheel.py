# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Run by scripts/test-installation where the wheel is installed: packs the city that is named, as python.farlod, and evaluates it."""

import sys

import numpy

import farlod

city = farlod.pack(sys.argv[1], "python.farlod", report=False)
west, south, east, north = city.bounds
eastings, northings = numpy.meshgrid(numpy.linspace(west, east, 50), numpy.linspace(south, north, 50))
svf = city.svf(numpy.column_stack([eastings.ravel(), northings.ravel()]))
known = svf[numpy.isfinite(svf)]
assert len(known) > 100 and 0.2 < known.mean() < 1.0, known
# Formats of GDAL that need its data, and a CRS that needs PROJ's
heights = farlod.Heights(default=12.0)
assert farlod.pack("house.osm", "house.farlod", out_crs="EPSG:25832", heights=heights, report=False).info["buildings"] == 1
print(f"farlod {farlod.__version__} for Python: {len(known)} points, mean {known.mean():.6f}")
