// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tiles/building_bases.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "city/geometry.hpp"

namespace farlod::tiles {

using plausibility::KnownGroundHeightAt;

namespace {

/// A square: the number of doublings of its side, its column and its row.
using Square = std::tuple<int, std::int64_t, std::int64_t>;

/// The larger of the distances along x and y; 0 inside the rectangle.
double distance_from(const Box2d& rectangle, const Point3d& p) {
  return std::max({rectangle.low.x - p.x, p.x - rectangle.high.x, rectangle.low.y - p.y, p.y - rectangle.high.y, 0.0});
}

Square square_of(const Point3d& p, double distance_m, double side_m) {
  const int doublings = std::ilogb(distance_m / side_m);
  const double edge_m = 0.25 * std::ldexp(side_m, doublings);
  return {doublings, static_cast<std::int64_t>(std::floor(p.x / edge_m)), static_cast<std::int64_t>(std::floor(p.y / edge_m))};
}

}  // namespace

std::vector<Point3d> thinned_relief(std::vector<Point3d> points, const Box2d& rectangle) {
  const double side_m = std::max(rectangle.high.x - rectangle.low.x, rectangle.high.y - rectangle.low.y);
  std::sort(points.begin(), points.end(), comes_first);
  std::set<Square> taken;
  std::erase_if(points, [&](const Point3d& p) {
    const double distance_m = distance_from(rectangle, p);
    return distance_m > side_m && !taken.insert(square_of(p, distance_m, side_m)).second;
  });
  return points;
}

namespace {

PagedArray<Point3d> nodes_of(const TerrainRaster& terrain, const GridRotation& rotation) {
  PagedArray<Point3d> nodes;
  for (std::size_t row = 0; row < terrain.rows; ++row)
    for (std::size_t column = 0; column < terrain.columns; ++column)
      if (const auto& height = terrain.height_m[row * terrain.columns + column]) {
        const Point2d p_grid = rotation.grid_from_city(terrain.node(column, row));
        nodes.push_back({p_grid.x, p_grid.y, *height});
      }
  return nodes;
}

}  // namespace

std::optional<Ground> surveyed_ground(const std::optional<TerrainRaster>& terrain, std::span<const Point3d> relief_points_city,
                                      const Grid& grid, GroundExtent extent) {
  if (terrain && terrain->covers_pixels) return Ground(*terrain, PixelSteps(*terrain), grid.rotation);
  if (terrain) return Ground(nodes_of(*terrain, grid.rotation), grid.rectangle(), extent);
  if (relief_points_city.empty()) return std::nullopt;
  std::vector<Point3d> points_grid;
  points_grid.reserve(relief_points_city.size());
  for (const Point3d& p_city : relief_points_city) points_grid.push_back(grid.rotation.grid_from_city(p_city));
  PagedArray<Point3d> kept = thinned_relief(std::move(points_grid), grid.rectangle());
  return Ground(std::move(kept), grid.rectangle(), extent);
}

namespace {

/// The lowest ground under a building's outline.
std::optional<double> lowest_ground_m(std::span<const Point3d> points, const KnownGroundHeightAt& ground_height) {
  std::optional<double> lowest_m;
  for (const Point3d& p : points)
    if (const auto height_m = ground_height(horizontal(p)); height_m && (!lowest_m || *height_m < *lowest_m)) lowest_m = height_m;
  return lowest_m;
}

struct Refusal {
  ProblemCode code;
  std::string detail;
};

/// Moves the points that are nearer to the base than to the roof to the ground, or says why it cannot.
std::optional<Refusal> reach_down(std::span<Point3d> points, std::optional<double> ground_m) {
  const auto by_height = [](const Point3d& a, const Point3d& b) { return a.z < b.z; };
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end(), by_height);
  const double roof_m = highest->z, middle_m = 0.5 * (lowest->z + highest->z);
  std::ostringstream detail;
  detail << "its roof is at " << roof_m << " m, ";
  if (!ground_m) return Refusal{ProblemCode::no_height, detail.str() + "and the terrain does not say where the ground is"};
  detail << "the ground there at " << *ground_m << " m";
  if (roof_m <= *ground_m) return Refusal{ProblemCode::height_not_positive, detail.str()};
  if (roof_m - *ground_m > highest_building_m) return Refusal{ProblemCode::absurd_height, detail.str()};
  for (Point3d& p : points)
    if (p.z < middle_m) p.z = *ground_m;
  return std::nullopt;
}

Problem problem_of(const LocatedCity& located, const Building& b, Refusal refusal, const Point3d& p_city) {
  const Point2d origin_m = located.georeference.origin_m;
  return {refusal.code, b.source < located.sources.size() ? located.sources[b.source] : "", b.id, std::move(refusal.detail),
          p_city + Point3d{origin_m.x, origin_m.y, 0.0}};
}

}  // namespace

void lift_onto_terrain(LocatedCity& located, const KnownGroundHeightAt& ground_height, Report& report) {
  CityModel& city = located.city;
  std::vector<bool> is_lost(city.facets().size(), false);
  for (const Building& b : city.buildings()) {
    if (b.height_reference == HeightReference::elevation || b.facet_count == 0) continue;
    const std::span<Point3d> points = city.points_of(b);
    const std::optional<double> ground_m = lowest_ground_m(points, ground_height);
    if (b.height_reference == HeightReference::on_ground) {
      for (Point3d& p : points) p.z += ground_m.value_or(0.0);
    } else if (auto refusal = reach_down(points, ground_m)) {
      report.add(problem_of(located, b, std::move(*refusal), points.front()));
      const auto first = is_lost.begin() + static_cast<std::ptrdiff_t>(b.first_facet);
      std::fill_n(first, b.facet_count, true);
    }
  }
  city.drop_facets(is_lost);
}

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

constexpr double steepest_ground = 0.5;  ///< 27°: steeper streets are stairs

constexpr double gentle_ground = 0.2;  ///< 11°: streets are seldom steeper
constexpr double kerb_m = 1.5;         ///< steps, kerbs and plinths: difference of bases on level ground

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

namespace {

/// Promise (4) of bases_of.
void put_on_a_steep_ground(std::vector<Base>& bases) {
  constexpr std::ptrdiff_t enough_for_a_town = 20;
  const auto on_ground = std::count(bases.begin(), bases.end(), Base::on_ground), all = std::ssize(bases);
  if (all >= enough_for_a_town && 2 * on_ground < all) std::fill(bases.begin(), bases.end(), Base::on_ground);
}

void raise_as_files_say(const CityModel& city, std::vector<Base>& bases) {
  for (std::size_t n = 0; n < bases.size(); ++n)
    if (city.buildings()[n].foot == Foot::above_ground) bases[n] = Base::above_ground;
}

}  // namespace

std::vector<Base> bases_of(const CityModel& city) {
  PagedArray<Footprint> footprints;
  // What the file says to begin above the ground says nothing about it
  city.for_each_building([&](std::size_t, const Building& b) {
    footprints.push_back(b.foot == Foot::above_ground ? Footprint{} : footprint_of(city.points_of(b)));
  });
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
  put_on_a_steep_ground(result);
  raise_as_files_say(city, result);
  return result;
}

std::vector<Base> bases_on_survey(const CityModel& city) {
  std::vector<Base> bases(city.buildings().size(), Base::on_ground);
  raise_as_files_say(city, bases);
  return bases;
}

namespace {

constexpr double base_thickness_m = 0.01;  ///< bases are drawn to the centimetre

}  // namespace

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
