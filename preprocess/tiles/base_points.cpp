// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/base_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "farlod/box.hpp"

namespace farlod {
namespace {

struct Base {
  Box2d outline;
  double height_m = std::numeric_limits<double>::infinity();
};

Base base_of(std::span<const Point3d> points) {
  Base base;
  for (const Point3d& p : points) {
    base.outline.add(horizontal(p));
    base.height_m = std::min(base.height_m, p.z);
  }
  return base;
}

double distance_m(const Box2d& a, const Box2d& b) {
  const double dx = std::max({0.0, a.low.x - b.high.x, b.low.x - a.high.x});
  const double dy = std::max({0.0, a.low.y - b.high.y, b.low.y - a.high.y});
  return std::hypot(dx, dy);
}

/// Buildings by the squares of a coarse net that their outlines touch.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<Base>& bases) : bases_(bases) {
    for (std::uint32_t n = 0; n < bases.size(); ++n)
      for_each_square(bases[n].outline, 0.0, [&](std::uint64_t square) { squares_[square].push_back(n); });
  }

  /// Whether a neighbour stands so much lower that this one must hang.
  [[nodiscard]] bool hangs(const Base& base) const {
    bool lower_found = false;
    for_each_square(base.outline, base_search_radius_m, [&](std::uint64_t square) {
      const auto found = squares_.find(square);
      if (lower_found || found == squares_.end()) return;
      for (const std::uint32_t n : found->second) {
        const double distance = distance_m(base.outline, bases_[n].outline);
        if (distance > base_search_radius_m) continue;
        lower_found |= base.height_m - bases_[n].height_m > steepest_ground * distance + least_clearance_m;
      }
    });
    return lower_found;
  }

 private:
  template <class Visit>
  static void for_each_square(const Box2d& outline, double margin, const Visit& visit) {
    const auto square_of = [](double x) { return static_cast<std::int64_t>(std::floor(x / base_search_radius_m)); };
    for (std::int64_t j = square_of(outline.low.y - margin); j <= square_of(outline.high.y + margin); ++j)
      for (std::int64_t i = square_of(outline.low.x - margin); i <= square_of(outline.high.x + margin); ++i)
        visit((static_cast<std::uint64_t>(j) << 32) ^ (static_cast<std::uint64_t>(i) & 0xFFFFFFFF));
  }

  const std::vector<Base>& bases_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
};

}  // namespace

std::vector<Point3d> base_points(const CityModel& city) {
  std::vector<Base> bases;
  bases.reserve(city.buildings().size());
  for (const Building& b : city.buildings()) bases.push_back(base_of(city.points_of(b)));
  const Neighbours neighbours(bases);
  std::vector<Point3d> result;
  for (std::size_t n = 0; n < bases.size(); ++n) {
    if (bases[n].outline.empty() || neighbours.hangs(bases[n])) continue;
    for (const Point3d& p : city.points_of(city.buildings()[n]))
      if (p.z <= bases[n].height_m + base_thickness_m) result.push_back(p);
  }
  return result;
}

}  // namespace farlod
