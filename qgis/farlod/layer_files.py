# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of QGIS as files that the programs read."""
from __future__ import annotations

import pathlib

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransformContext,
    QgsFeature,
    QgsFeatureRequest,
    QgsFeatureSink,
    QgsFields,
    QgsGeometry,
    QgsProcessingException,
    QgsProcessingFeatureSource,
    QgsRasterLayer,
    QgsRectangle,
    QgsVectorFileWriter,
    QgsVectorLayer,
    QgsWkbTypes,
)

# Formats of a single layer; of the others, a program would read another layer than the one that was chosen
SINGLE_LAYER_ENDINGS = (".geojson", ".json", ".shp", ".fgb")
ROW_NUMBER = "farlod_row"


def vector_writer(
    path: pathlib.Path, fields: QgsFields, kind: QgsWkbTypes.Type, crs: QgsCoordinateReferenceSystem
) -> QgsVectorFileWriter:
    """A GeoPackage with one layer, which is whole when the writer goes out of scope.

    Its column of numbers has a name of its own: an attribute `fid` may hold anything.
    """
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = "GPKG"
    options.layerName = path.stem
    options.layerOptions = [f"FID={ROW_NUMBER}"]
    writer = QgsVectorFileWriter.create(str(path), fields, kind, crs, QgsCoordinateTransformContext(), options)
    if writer.hasError() != QgsVectorFileWriter.NoError:
        raise QgsProcessingException(f"{path} cannot be written: {writer.errorMessage()}")
    return writer


def save_source(source: QgsProcessingFeatureSource, path: pathlib.Path) -> str:
    """The features of the source, those that are selected where only these were asked for."""
    writer = vector_writer(path, source.fields(), source.wkbType(), source.sourceCrs())
    # Whether a building is valid is for farlod-pack to say: one that is not must not end the run
    every = source.getFeatures(QgsFeatureRequest(), QgsProcessingFeatureSource.FlagSkipGeometryValidityChecks)
    if not writer.addFeatures(every, QgsFeatureSink.FastInsert):
        raise QgsProcessingException(f"{path} cannot be written: {writer.errorMessage()}")
    return str(path)


def save_rectangle(rectangle: QgsRectangle, crs: QgsCoordinateReferenceSystem, path: pathlib.Path) -> str:
    writer = vector_writer(path, QgsFields(), QgsWkbTypes.Polygon, crs)
    feature = QgsFeature()
    feature.setGeometry(QgsGeometry.fromRect(rectangle))
    writer.addFeature(feature, QgsFeatureSink.FastInsert)
    return str(path)


def own_file(layer: QgsVectorLayer) -> str | None:
    """The file of a layer, where it holds just what the layer shows: no filter, no edits, no other CRS, no other layer."""
    path = layer.source()
    is_whole = layer.providerType() == "ogr" and not layer.subsetString() and not layer.isEditable()
    if not is_whole or not path.lower().endswith(SINGLE_LAYER_ENDINGS) or not pathlib.Path(path).is_file():
        return None
    return path if layer.crs() == layer.dataProvider().crs() else None


def raster_file(layer: QgsRasterLayer) -> str:
    """The file of a raster, which the programs read through GDAL as QGIS does."""
    if layer.providerType() != "gdal":
        raise QgsProcessingException(f"{layer.name()} is not a raster of a file: export it as a GeoTIFF first.")
    return layer.source()
