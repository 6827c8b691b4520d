# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""1 km² of Omiya as footprints and as a surface model of 1 m, and what programs take to answer it."""
import os
import subprocess
from pathlib import Path

import numpy as np
from osgeo import gdal

gdal.UseExceptions()
LOW, SIDE_M = (375300, 3973950), 1000  # EPSG:32654
FREE_M = 3.0  # from walls


def made(folder: Path, data: Path) -> tuple[Path, Path]:
    """The footprints (field TAKASA) and the surface model, of DATA/omiya/omiya.geojson."""
    whole, city, model = (folder / file for file in ("whole.gpkg", "city.gpkg", "dsm.tif"))
    box = [*LOW, LOW[0] + SIDE_M, LOW[1] + SIDE_M]
    gdal.VectorTranslate(str(whole), str(data / "omiya/omiya.geojson"), dstSRS="EPSG:32654", layerName="city",
                         SQLStatement="select * from HouseR03 order by TAKASA")  # the highest on top
    gdal.VectorTranslate(str(city), str(whole), options=["-clipsrc", *map(str, box), "-nlt", "MULTIPOLYGON"])
    gdal.Rasterize(str(model), str(whole), attribute="TAKASA", outputBounds=box, xRes=1, yRes=1, initValues=0,
                   outputType=gdal.GDT_Float32)
    return city, model


def processor_seconds(*command: object) -> float:
    """Runs a command without a word, and tells user and system time of it and of its children."""
    before = os.times()
    subprocess.run([*map(str, command)], check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


def values(file: Path | str) -> np.ndarray:
    return gdal.Open(str(file)).ReadAsArray().astype(float)


def far_from_walls(height_m: np.ndarray) -> np.ndarray:
    """Pixels all of whose neighbours within FREE_M are as high."""
    reach, far = int(FREE_M), np.ones_like(height_m, bool)
    padded = np.pad(height_m, reach, mode="edge")
    for y in range(-reach, reach + 1):
        for x in range(-reach, reach + 1):
            if x * x + y * y <= FREE_M * FREE_M:
                far &= padded[reach + y : reach + y + height_m.shape[0], reach + x : reach + x + height_m.shape[1]] == height_m
    return far
