// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "farlod/point.hpp"
#include "ingest/model_builder/ring_cleaning.hpp"

// Private to the wrappers of GDAL: it names its classes.
class OGRGeometry;
class OGRSpatialReference;

namespace farlod::ingest {

/// The areas of a feature.
struct Areas {
  std::vector<Rings> polygons;
  bool holds_others = false;      ///< also geometries that are not areas
  bool is_made_of_faces = false;  ///< is a polyhedral surface or a TIN
  bool is_body = false;           ///< is a body in space, not an area on the ground
};

/// The areas of a geometry in a reference system, which may be null. Arcs become chords of the default length of GDAL.
[[nodiscard]] Areas areas_of(const OGRGeometry& geometry, const OGRSpatialReference* reference);

/// The position of a feature without rings, for the report.
[[nodiscard]] std::optional<Point3d> middle_of(const OGRGeometry& geometry);

/// The factors that bring plan coordinates to the unit of the elevations, exact enough to tell a wall from a floor.
[[nodiscard]] Point2d plan_scale(const OGRSpatialReference* reference, Point2d p);

}  // namespace farlod::ingest
