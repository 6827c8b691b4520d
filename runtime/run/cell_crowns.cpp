// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/cell_crowns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene/canopy_around.hpp"
#include "scene/convex_piece.hpp"

namespace farlod {
namespace {

/// A part of a line along x.
struct LinePart {
  double begin_m, end_m;
};

/// Where a line lies between two others that are parallel: |slope · x + offset| ≤ half_width.
LinePart between(double slope, double offset_m, double half_width_m) {
  constexpr double everywhere_m = 1e9;
  if (std::abs(slope) < 1e-9)
    return std::abs(offset_m) <= half_width_m ? LinePart{-everywhere_m, everywhere_m} : LinePart{everywhere_m, -everywhere_m};
  const double a = (-half_width_m - offset_m) / slope, b = (half_width_m - offset_m) / slope;
  return {std::min(a, b), std::max(a, b)};
}

/// What a crown covers of the line that lies `y_m` north of its axis, which is at x = 0. It ends before it begins where that is
/// nothing.
LinePart covered_by(const Crown& crown, double y_m) {
  const double r = crown.half_width_m;
  if (crown.shape != CrownShape::prism) {
    const double half_m = std::sqrt(std::max(0.0, r * r - y_m * y_m));
    return {-half_m, half_m};
  }
  const double cosine = std::cos(crown.turn_rad()), sine = std::sin(crown.turn_rad());
  const LinePart a = between(cosine, sine * y_m, r), b = between(-sine, cosine * y_m, r);
  return {std::max(a.begin_m, b.begin_m), std::min(a.end_m, b.end_m)};
}

/// The length of all parts together, where overlaps count once, from one place to another.
double length_of_union(const std::vector<LinePart>& sorted, double from_m, double to_m) {
  double length_m = 0.0, done_m = from_m;
  for (const LinePart& part : sorted) {
    const double end_m = std::min(part.end_m, to_m);
    length_m += std::max(0.0, end_m - std::max(part.begin_m, done_m));
    done_m = std::max(done_m, end_m);
  }
  return length_m;
}

/// The same in a cell, or in the zone.
double length_within(std::vector<LinePart>& parts, double edge_m, double y_m, const std::vector<ZoneTrapezoid>* within) {
  std::ranges::sort(parts, {}, &LinePart::begin_m);
  if (within == nullptr) return length_of_union(parts, 0.0, edge_m);
  double length_m = 0.0;
  for (const ZoneTrapezoid& trapezoid : *within) {
    const auto [west_m, east_m] = trapezoid.span_at(y_m);
    length_m += length_of_union(parts, std::max(0.0, west_m), std::min(edge_m, east_m));
  }
  return length_m;
}

double plan_area_m2(const std::vector<Crown>& crowns, double edge_m, const std::vector<ZoneTrapezoid>* within) {
  constexpr double line_spacing_m = 0.1;
  std::vector<std::vector<LinePart>> lines(static_cast<std::size_t>(std::ceil(edge_m / line_spacing_m)));
  const double step_m = edge_m / static_cast<double>(lines.size());
  const auto line_from = [&](double y_m) {
    return static_cast<std::size_t>(std::clamp(std::ceil(y_m / step_m - 0.5), 0.0, static_cast<double>(lines.size())));
  };
  for (const Crown& crown : crowns)
    for (std::size_t k = line_from(crown.y_m - reach_m(crown)); k < line_from(crown.y_m + reach_m(crown)); ++k) {
      const LinePart part = covered_by(crown, (static_cast<double>(k) + 0.5) * step_m - crown.y_m);
      if (part.begin_m < part.end_m) lines[k].push_back({crown.x_m + part.begin_m, crown.x_m + part.end_m});
    }
  double area_m2 = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k)
    area_m2 += length_within(lines[k], edge_m, (static_cast<double>(k) + 0.5) * step_m, within) * step_m;
  return area_m2;
}

/// The highest ground below a place.
std::optional<double> ground_below(Point2d p, const CellFaces& faces) {
  std::optional<double> height_m;
  for (const CellFace& face : faces.ground) {
    if (face.normal.z <= 0.0 || p.x < face.low.x || p.x > face.high.x || p.y < face.low.y || p.y > face.high.y) continue;
    const Point3d place{p.x, p.y, 0.0};
    const Column column(face.corners, {0.0, 0.0, 1.0});
    if (std::ranges::any_of(column.sides, [&](const HalfSpace& side) { return side.signed_distance(place) < 0.0; })) continue;
    const double z = HalfSpace{face.corners[0], face.normal}.signed_distance(place) / -face.normal.z;
    height_m = std::max(height_m.value_or(z), z);
  }
  return height_m;
}

}  // namespace

std::optional<CellVegetation> vegetation_of(const PackageReader& package, Cell cell, const CellFaces& faces,
                                            const std::vector<ZoneTrapezoid>* within) {
  if (!package.has_crowns()) return std::nullopt;
  CellVegetation result;
  result.plan_area_m2 = plan_area_m2(crowns_near(package, cell, 0.0), package.grid().cell_edge_m, within);
  double sum_m = 0.0;
  std::size_t above_ground = 0;
  for (const Crown& crown : package.crowns().crowns_of(cell)) {
    const Point2d axis{crown.x_m, crown.y_m};
    if (within != nullptr && std::ranges::none_of(*within, [&](const ZoneTrapezoid& t) { return t.contains(axis); })) continue;
    ++result.count;
    const auto ground_m = ground_below(axis, faces);
    if (!ground_m) continue;
    sum_m += static_cast<double>(crown.top_m) - *ground_m;
    ++above_ground;
  }
  if (above_ground > 0) result.height_mean_m = sum_m / static_cast<double>(above_ground);
  return result;
}

}  // namespace farlod
