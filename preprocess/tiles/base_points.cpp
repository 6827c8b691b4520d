// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/base_points.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "city/plan_boxes.hpp"
#include "city/point_order.hpp"
#include "farlod/box.hpp"

namespace farlod::tiles {
namespace {

/// The bounding rectangle of a building in plan, and the height of its base.
struct Footprint {
  Box2d outline;
  double height_m = std::numeric_limits<double>::infinity();
};

Footprint footprint_of(std::span<const Point3d> points) {
  Footprint base;
  for (const Point3d& p : points) {
    base.outline.add(horizontal(p));
    base.height_m = std::min(base.height_m, p.z);
  }
  return base;
}

/// Finds the buildings near a building: buildings are listed by the squares of a coarse grid that their outlines touch. The grid
/// is rolled up: squares that lie a whole number of its sides apart share a list, so that it is as long as the buildings are
/// many, however far apart they are. Lists of neighboring squares lie close together in memory.
class Neighbors {
 public:
  explicit Neighbors(const PagedArray<Footprint>& bases)
      : bases_(bases), bits_(static_cast<int>(std::bit_width(bases.size())) / 2 + 1) {
    // Count the entries of each list, let the lists begin one behind the other, then fill them: each moves its beginning
    begin_of_list_.resize((std::size_t{1} << (2 * bits_)) + 1);
    const auto for_each_entry = [&](const auto& visit) {
      for (std::uint32_t n = 0; n < bases_.size(); ++n)
        if (!bases_[n].outline.empty()) for_each_list(bases_[n].outline, 0.0, [&](std::size_t list) { visit(list, n); });
    };
    for_each_entry([&](std::size_t list, std::uint32_t) { ++begin_of_list_[list]; });
    std::exclusive_scan(begin_of_list_.begin(), begin_of_list_.end(), begin_of_list_.begin(), std::uint64_t{0});
    numbers_.resize_for_overwrite(begin_of_list_.back());
    for_each_entry([&](std::size_t list, std::uint32_t n) { numbers_[begin_of_list_[list]++] = n; });
    // Each list begins by now where the next one did
    std::copy_backward(begin_of_list_.begin(), begin_of_list_.end() - 1, begin_of_list_.end());
    begin_of_list_[0] = 0;
  }

  /// Promise (2) of bases_of. A neighbor across a wide street may be neither higher nor on the same level.
  [[nodiscard]] bool is_below_ground(std::uint32_t number) const {
    const Footprint& here = bases_[number];
    int higher = 0, alike = 0;
    visit_near(number, [&](std::uint32_t n, double distance) {
      const double rise_m = bases_[n].height_m - here.height_m;
      higher += rise_m > steepest_rise_m(distance + depth_m(here)) ? 1 : 0;
      alike += std::abs(rise_m) <= gentle_ground * distance + kerb_m ? 1 : 0;
    });
    return higher >= 2 && higher > alike;
  }

  /// Promise (1) of bases_of. Neighbors that `bases` knows to be below the ground do not count.
  [[nodiscard]] bool is_above_ground(std::uint32_t number, std::span<const Base> bases) const {
    const Footprint& here = bases_[number];
    std::vector<Point2d> lower;  // directions to the neighbors that are lower by a clearance
    bool lower_than_slope = false;
    visit_near(number, [&](std::uint32_t n, double distance) {
      if (bases[n] == Base::below_ground) return;
      const double drop_m = here.height_m - bases_[n].height_m;
      if (drop_m > steepest_ground * distance + least_clearance_m) lower.push_back(towards(here, bases_[n]));
      lower_than_slope |= drop_m > steepest_rise_m(distance + depth_m(bases_[n]));
    });
    return lower_than_slope || lie_opposite(lower);
  }

 private:
  /// The largest difference of two bases at a distance of `run_m`.
  static double steepest_rise_m(double run_m) { return steepest_ground * run_m + kerb_m; }
  /// A house on a hill may have its base at its downhill end, so its own depth adds to the distance.
  static double depth_m(const Footprint& f) {
    return std::min(f.outline.high.x - f.outline.low.x, f.outline.high.y - f.outline.low.y);
  }
  /// Unit vector from the middle of one outline to the nearest point of another one.
  static Point2d towards(const Footprint& from, const Footprint& to) {
    const Point2d middle = 0.5 * (from.outline.low + from.outline.high);
    const Point2d nearest{std::clamp(middle.x, to.outline.low.x, to.outline.high.x),
                          std::clamp(middle.y, to.outline.low.y, to.outline.high.y)};
    const Point2d way = nearest - middle;
    const double length = norm(way);
    return length > 0.0 ? (1.0 / length) * way : Point2d{};
  }
  static bool lie_opposite(const std::vector<Point2d>& directions) {
    constexpr double cosine_of_opposite = -0.5;
    for (const Point2d a : directions)
      for (const Point2d b : directions)
        if (dot(a, b) < cosine_of_opposite) return true;
    return false;
  }

  /// Calls `visit` once for each building within the search radius, with its distance.
  template <class Visit>
  void visit_near(std::uint32_t number, const Visit& visit) const {
    std::vector<std::uint32_t> near;
    for_each_list(bases_[number].outline, base_search_radius_m, [&](std::size_t list) {
      for (std::uint64_t k = begin_of_list_[list]; k < begin_of_list_[list + 1]; ++k) near.push_back(numbers_[k]);
    });
    // A building may touch several squares
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t n : near) {
      const double distance = distance_m(bases_[number].outline, bases_[n].outline);
      if (n != number && distance <= base_search_radius_m) visit(n, distance);
    }
  }

  /// Calls `visit` for the list of each square that the outline touches; it may be the same for several squares.
  template <class Visit>
  void for_each_list(const Box2d& outline, double margin, const Visit& visit) const {
    const auto square_of = [](double x) { return static_cast<std::int64_t>(std::floor(x / base_search_radius_m)); };
    const auto rolled = [this](std::int64_t k) { return static_cast<std::size_t>(k) & ((std::size_t{1} << bits_) - 1); };
    for (std::int64_t j = square_of(outline.low.y - margin); j <= square_of(outline.high.y + margin); ++j)
      for (std::int64_t i = square_of(outline.low.x - margin); i <= square_of(outline.high.x + margin); ++i)
        visit(rolled(j) << bits_ | rolled(i));
  }

  const PagedArray<Footprint>& bases_;
  int bits_;  ///< the rolled grid has 2^bits_ rows and columns
  PagedArray<std::uint64_t> begin_of_list_;
  PagedArray<std::uint32_t> numbers_;
};

}  // namespace

std::vector<Base> bases_of(const CityModel& city) {
  PagedArray<Footprint> footprints;
  city.for_each_building([&](std::size_t, const Building& b) { footprints.push_back(footprint_of(city.points_of(b))); });
  const Neighbors neighbors(footprints);
  // Find the bases below the ground first: they must not make bridges of their neighbors
  std::vector<Base> without_bridges(footprints.size(), Base::on_ground);
  oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(footprints.size()), [&](std::uint32_t n) {
    if (!footprints[n].outline.empty() && neighbors.is_below_ground(n)) without_bridges[n] = Base::below_ground;
  });
  std::vector<Base> result = without_bridges;
  oneapi::tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(footprints.size()), [&](std::uint32_t n) {
    if (!footprints[n].outline.empty() && result[n] == Base::on_ground && neighbors.is_above_ground(n, without_bridges))
      result[n] = Base::above_ground;
  });
  return result;
}

PagedArray<Point3d> base_points(const CityModel& city, std::span<const Base> bases) {
  PagedArray<Point3d> result;
  std::vector<Point3d> of_building;
  city.for_each_building([&](std::size_t n, const Building& b) {
    if (bases[n] != Base::on_ground) return;
    const std::span<const Point3d> points = city.points_of(b);
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const Point3d& p : points) lowest_m = std::min(lowest_m, p.z);
    of_building.clear();
    for (const Point3d& p : points)
      if (p.z <= lowest_m + base_thickness_m) of_building.push_back(p);
    // The floor has each of them, and so have two walls
    std::sort(of_building.begin(), of_building.end(), comes_first);
    of_building.erase(std::unique(of_building.begin(), of_building.end()), of_building.end());
    result.append(of_building);
  });
  return result;
}

}  // namespace farlod::tiles
