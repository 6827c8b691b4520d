// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/footprints/feature_areas_ogr.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "city/city_model.hpp"
#include "farlod/angle.hpp"
#include "gdal/vector_file_gdal.hpp"

namespace farlod::ingest {
namespace {

Ring ring_from(const OGRLinearRing& line) {
  Ring ring;
  for (int k = 0; k < line.getNumPoints(); ++k) ring.push_back({line.getX(k), line.getY(k), line.getZ(k)});
  return ring;
}

/// Whether a polygon is steeper than 45°, as walls are. No footprint that follows the terrain is as steep.
bool is_steep(const Ring& ring, const OGRSpatialReference* reference) {
  if (ring.empty()) return false;
  const Point2d scale = plan_scale(reference, horizontal(ring.front()));
  const auto from_first = [&](const Point3d& p) {
    const Point3d d = p - ring.front();
    return Point3d{scale.x * d.x, scale.y * d.y, d.z};
  };
  Point3d sum;
  for (std::size_t k = 2; k < ring.size(); ++k) sum = sum + cross(from_first(ring[k - 1]), from_first(ring[k]));
  return std::hypot(sum.x, sum.y) > std::abs(sum.z);
}

}  // namespace

std::optional<Point3d> middle_of(const OGRGeometry& geometry) {
  OGREnvelope box;
  geometry.getEnvelope(&box);
  const Ring middle{{0.5 * (box.MinX + box.MaxX), 0.5 * (box.MinY + box.MaxY), 0.0}};
  return first_readable({&middle, 1});
}

Point2d plan_scale(const OGRSpatialReference* reference, Point2d p) {
  if (reference == nullptr || reference->IsGeographic() == 0) return {1.0, 1.0};
  return {metres_in_a_degree * std::cos(Angle::degrees(p.y).radians()), metres_in_a_degree};
}

Areas areas_of(const OGRGeometry& geometry, const OGRSpatialReference* reference) {
  const std::unique_ptr<OGRGeometry> straight(geometry.getLinearGeometry());
  Areas areas;
  const auto take = [&areas](const OGRPolygon& polygon, bool is_face) {
    Rings& rings = areas.polygons.emplace_back();
    for (const OGRLinearRing* ring : polygon) rings.push_back(ring_from(*ring));
    areas.is_made_of_faces = areas.is_made_of_faces || is_face;
  };
  areas.holds_others = !straight || !for_each_polygon(*straight, take);
  const auto steep = [reference](const Rings& rings) { return !rings.empty() && is_steep(rings.front(), reference); };
  const bool is_surface =
      areas.is_made_of_faces || (areas.polygons.size() > 1 && std::any_of(areas.polygons.begin(), areas.polygons.end(), steep));
  areas.is_body = geometry.Is3D() != 0 && is_surface;
  return areas;
}

}  // namespace farlod::ingest
