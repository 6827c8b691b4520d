// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/solid_orientation.hpp"

#include <map>

namespace farlod::tiles {
namespace {

struct Part {
  Point3d weighted_middle;
  double area_m2 = 0.0;
  double volume_m3 = 0.0;
};

}  // namespace

std::vector<double> outward_signs(std::span<const OrientedArea> facets) {
  std::map<std::uint16_t, Part> parts;
  for (const OrientedArea& f : facets) {
    Part& part = parts[f.part];
    const double area = norm(f.area_vector_m2);
    part.weighted_middle = part.weighted_middle + area * f.point;
    part.area_m2 += area;
  }
  for (const OrientedArea& f : facets) {
    Part& part = parts[f.part];
    if (part.area_m2 == 0.0) continue;
    const Point3d middle = (1.0 / part.area_m2) * part.weighted_middle;
    part.volume_m3 += dot(f.point - middle, f.area_vector_m2) / 3.0;
  }
  std::vector<double> signs;
  signs.reserve(facets.size());
  for (const OrientedArea& f : facets) signs.push_back(parts[f.part].volume_m3 < 0.0 ? -1.0 : 1.0);
  return signs;
}

}  // namespace farlod::tiles
