// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "far_terrain/far_terrain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>

#include "base/cancellation.hpp"
#include "city/geometry.hpp"
#include "far_terrain/cut_out.hpp"
#include "far_terrain/right_triangles.hpp"
#include "farlod/error.hpp"
#include "georeference/height_samples.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/raster_reader.hpp"
#include "package/tiles_writer.hpp"
#include "plausibility/border_step.hpp"
#include "tiles/horizon_edges.hpp"

namespace farlod::far_terrain {
namespace {

using georeference::HeightSamples;
using georeference::PixelLattice;

constexpr std::uint32_t side = 256;
constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// From here on, the whole curvature counts.
constexpr double curved_from_m = 5000.0;

double distance_m(const Box2d& box, Point2d p) {
  return std::hypot(std::max({box.low.x - p.x, p.x - box.high.x, 0.0}), std::max({box.low.y - p.y, p.y - box.high.y, 0.0}));
}

/// How the pixels of a square lie in the grid frame: 5 × 5 of them exactly, those between them bilinearly, to within metres.
class PlanOfSquare {
 public:
  PlanOfSquare(const HeightSamples& raster, const PixelLattice& l, const Grid& grid) {
    std::array<Point3d, points * points> pixels;
    const double apart = static_cast<double>(l.step) * side / (points - 1);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      const std::size_t column = n % points, row = n / points;
      pixels[n] = {static_cast<double>(l.column) + static_cast<double>(column) * apart,
                   static_cast<double>(l.row) + static_cast<double>(row) * apart, 0.0};
    }
    raster.move_to_city(pixels);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      places_[n] = grid.rotation.grid_from_city(horizontal(pixels[n]));
      if (std::isfinite(places_[n].x) && std::isfinite(places_[n].y)) box_.add(places_[n]);
    }
    for (std::size_t n = 0; n + 1 < points; ++n)
      widest_pixel_m_ = std::max({widest_pixel_m_, norm(places_[n + 1] - places_[n]) / apart,
                                  norm(places_[(n + 1) * points] - places_[n * points]) / apart});
  }

  /// Empty where no pixel has a place.
  [[nodiscard]] const Box2d& box() const { return box_; }
  [[nodiscard]] double widest_pixel_m() const { return widest_pixel_m_; }
  [[nodiscard]] Point2d place(std::uint32_t column, std::uint32_t row) const {
    constexpr std::uint32_t apart = side / (points - 1);
    const std::uint32_t i = std::min<std::uint32_t>(column / apart, points - 2),
                        j = std::min<std::uint32_t>(row / apart, points - 2);
    const double u = static_cast<double>(column) / apart - i, v = static_cast<double>(row) / apart - j;
    const Point2d* const p = &places_[j * points + i];
    return (1.0 - v) * ((1.0 - u) * p[0] + u * p[1]) + v * ((1.0 - u) * p[points] + u * p[points + 1]);
  }

 private:
  static constexpr std::size_t points = 5;
  std::array<Point2d, points * points> places_;
  Box2d box_;
  double widest_pixel_m_ = 0.0;
};

/// Where a raster has heights, by some of its pixels.
class Coverage {
 public:
  Coverage(const HeightSamples& raster, const Grid& grid) : raster_(raster) {
    const auto longest = static_cast<std::uint64_t>(std::max(raster.columns(), raster.rows()));
    const auto step = static_cast<std::uint32_t>(longest / side + 1);
    box_ = PlanOfSquare(raster, {0, 0, step, side + 1}, grid).box();
    lattice_.step = static_cast<std::uint32_t>(std::bit_ceil((longest + most - 1) / most));
    lattice_.column = lattice_.row = lattice_.step / 2;
    lattice_.nodes = most;
    height_m_.resize(std::size_t{most} * most);
    (void)raster.read(lattice_, height_m_);
  }

  /// Around the raster, in the grid frame.
  [[nodiscard]] const Box2d& box() const { return box_; }

  /// Empties the heights of nodes that lie where the raster has some.
  void take_out(std::span<const Point2d> places_city, std::span<float> height_m) const {
    std::vector<Point3d> pixels;
    for (const Point2d p : places_city) pixels.push_back({p.x, p.y, 0.0});
    raster_.move_to_pixels(pixels);
    for (std::size_t n = 0; n < pixels.size(); ++n)
      if (has_height(pixels[n])) height_m[n] = none;
  }

 private:
  static constexpr std::uint32_t most = 512;
  [[nodiscard]] bool has_height(const Point3d& pixel) const {
    const double column = std::round((pixel.x - static_cast<double>(lattice_.column)) / lattice_.step),
                 row = std::round((pixel.y - static_cast<double>(lattice_.row)) / lattice_.step);
    if (!(column >= 0.0 && row >= 0.0 && column < most && row < most)) return false;
    return !std::isnan(height_m_[static_cast<std::size_t>(row) * most + static_cast<std::size_t>(column)]);
  }

  const HeightSamples& raster_;
  Box2d box_;
  PixelLattice lattice_;
  std::vector<float> height_m_;
};

/// Makes the far terrain of one tolerance; gives up where it gets too many triangles.
class FarTerrainMaker {
 public:
  FarTerrainMaker(const CityGround& city, const FarTerrainSettings& settings, const std::stop_token& stop)
      : city_(city), settings_(settings), stop_(stop), rectangle_(city.grid.rectangle()) {}

  /// Adds what a raster has where those before it have nothing. Returns false where there are too many triangles.
  bool add(const HeightSamples& raster, double offset_m, std::span<const Coverage> earlier) {
    raster_ = &raster;
    offset_m_ = offset_m;
    earlier_ = earlier;
    found_ = {};
    const auto longest = static_cast<std::uint64_t>(std::max(raster.columns(), raster.rows()));
    const auto step = static_cast<std::uint32_t>(std::bit_ceil(std::max<std::uint64_t>(1, (longest + side - 1) / side)));
    return visit({step / 2, step / 2, step, side + 1});
  }

  /// What was found out about the raster that was added last.
  struct Found {
    bool is_around = false;              ///< a pixel of it is within reach
    std::vector<double> border_steps_m;  ///< how much higher it is than the city's ground, where the grid ends
    std::optional<double> stand_in;      ///< an undeclared number for no data
  };
  [[nodiscard]] const Found& found() const { return found_; }

  [[nodiscard]] FarTerrain take() {
    FarTerrain far_terrain{vertices_.vertices(), std::move(triangles_), {}};
    tiles::EdgeTable edges;
    const auto corner = [&](std::uint32_t v) {
      const Point3f& p = far_terrain.vertices[v];
      return Point3d{p.x, p.y, p.z};
    };
    for (const Triangle& t : far_terrain.triangles)
      edges.add_triangle(corner(t.a), corner(t.b), corner(t.c), tiles::FacetLook::up);
    const auto rounded = [](const Point3d& p) {
      return Point3f{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    };
    for (const tiles::HorizonSegment& e : edges.horizon_edges())
      far_terrain.horizon_edges.push_back({rounded(e.segment.a), rounded(e.segment.b), e.adjacent, e.role});
    return far_terrain;
  }

 private:
  /// From large squares to small ones, as far as their pixels are seen under more than the tolerance.
  bool visit(const PixelLattice& l) {
    throw_if_cancelled(stop_);
    if (l.column >= raster_->columns() || l.row >= raster_->rows()) return true;
    const PlanOfSquare plan(*raster_, l, city_.grid);
    if (plan.box().empty()) return true;
    const double nearest_m = std::max(farlod::distance_m(plan.box(), rectangle_), settings_.nearest_m);
    if (nearest_m > settings_.farthest_m) return true;
    found_.is_around = true;
    if (covers(rectangle_, plan.box())) return true;
    if (l.step == 1 || plan.widest_pixel_m() * l.step <= settings_.tolerance * nearest_m) return mesh(l, plan);
    const std::int64_t half = std::int64_t{l.step} * side / 2, shift = l.step / 2;
    for (const std::int64_t row : {l.row, l.row + half})
      for (const std::int64_t column : {l.column, l.column + half})
        if (!visit({column, row, static_cast<std::uint32_t>(shift), side + 1})) return false;
    return true;
  }

  static bool covers(const Box2d& outer, const Box2d& inner) { return outer.contains(inner.low) && outer.contains(inner.high); }

  bool mesh(const PixelLattice& l, const PlanOfSquare& plan) {
    std::vector<float> height_m(std::size_t{side + 1} * (side + 1)), tolerance_m;
    if (const auto stand_in = raster_->read(l, height_m)) found_.stand_in = stand_in;
    std::vector<Point2d> places_city;
    // Well within the grid the city has its own ground
    const double pixel_m = 2.0 * plan.widest_pixel_m() * l.step;
    const Box2d inner{rectangle_.low + Point2d{pixel_m, pixel_m}, rectangle_.high - Point2d{pixel_m, pixel_m}};
    for (std::uint32_t row = 0; row <= side; ++row)
      for (std::uint32_t column = 0; column <= side; ++column) {
        const Point2d p = plan.place(column, row);
        const double seen_from_m = inner.contains(p) ? std::numeric_limits<double>::infinity()
                                                     : std::max(distance_m(rectangle_, p), settings_.nearest_m);
        tolerance_m.push_back(static_cast<float>(settings_.tolerance * seen_from_m));
        if (!earlier_.empty()) places_city.push_back(city_.grid.rotation.city_from_grid(p));
      }
    compare_with_ground(l, plan, height_m);
    for (const Coverage& coverage : earlier_)
      if (boxes_meet(coverage.box(), plan.box())) coverage.take_out(places_city, height_m);
    add_triangles(l, height_m, triangulation_.triangulate({height_m, tolerance_m}));
    return triangles_.size() <= settings_.most_triangles;
  }

  /// At the nodes that lie next to the border.
  void compare_with_ground(const PixelLattice& l, const PlanOfSquare& plan, std::span<const float> height_m) {
    if (farlod::distance_m(plan.box(), rectangle_) > 0.0) return;
    const double pixel_m = plan.widest_pixel_m() * l.step;
    for (std::uint32_t n = 0; n < height_m.size(); ++n) {
      const Point2d p = plan.place(n % (side + 1), n / (side + 1));
      const Point2d on_border{std::clamp(p.x, rectangle_.low.x, rectangle_.high.x),
                              std::clamp(p.y, rectangle_.low.y, rectangle_.high.y)};
      const double apart_m = norm(p - on_border);
      if (std::isnan(height_m[n]) || apart_m == 0.0 || apart_m > pixel_m) continue;
      found_.border_steps_m.push_back(static_cast<double>(height_m[n]) + offset_m_ - city_.ground_m(on_border));
    }
  }

  void add_triangles(const PixelLattice& l, std::span<const float> height_m, const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> nodes;
    for (const Triangle& t : triangles) nodes.insert(nodes.end(), {t.a, t.b, t.c});
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const std::vector<Point3d> places = places_of(l, height_m, nodes);
    const auto place = [&](std::uint32_t node) {
      return places[static_cast<std::size_t>(std::ranges::lower_bound(nodes, node) - nodes.begin())];
    };
    for (const Triangle& t : triangles) add({place(t.a), place(t.b), place(t.c)});
  }

  /// In the grid frame, sunk by the Earth's curvature.
  [[nodiscard]] std::vector<Point3d> places_of(const PixelLattice& l, std::span<const float> height_m,
                                               std::span<const std::uint32_t> nodes) const {
    std::vector<Point3d> places;
    for (const std::uint32_t node : nodes) {
      const std::int64_t column = node % (side + 1), row = node / (side + 1);
      places.push_back({static_cast<double>(l.column + l.step * column), static_cast<double>(l.row + l.step * row),
                        static_cast<double>(height_m[node]) + offset_m_});
    }
    raster_->move_to_city(places);
    const Point2d middle = 0.5 * (rectangle_.low + rectangle_.high);
    for (Point3d& p : places) {
      p = city_.grid.rotation.grid_from_city(p);
      const double share = std::min(1.0, distance_m(rectangle_, horizontal(p)) / curved_from_m);
      p.z -= share * sinking_m(norm(horizontal(p) - middle));
    }
    return places;
  }

  void add(const std::array<Point3d, 3>& corners) {
    Box2d outline;
    double z_high_m = -std::numeric_limits<double>::infinity();
    for (const Point3d& p : corners) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
      outline.add(horizontal(p));
      z_high_m = std::max(z_high_m, p.z);
    }
    // What hardly rises over the level of the lowest ground hides nothing
    if (z_high_m - city_.lowest_m <= 0.5 * settings_.tolerance * farlod::distance_m(outline, rectangle_)) return;
    for (const std::array<Point3d, 3>& piece : outside_of(rectangle_, corners)) append(piece);
  }

  void append(const std::array<Point3d, 3>& corners) {
    const Point2d origin = city_.grid.middle_corner();
    std::array<std::uint32_t, 3> numbers{};
    std::array<Point3f, 3> rounded;
    for (std::size_t n = 0; n < 3; ++n)
      rounded[n] = {static_cast<float>(corners[n].x - origin.x), static_cast<float>(corners[n].y - origin.y),
                    static_cast<float>(corners[n].z - city_.height_origin_m)};
    const auto& [a, b, c] = rounded;
    const double area = (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
    if (area == 0.0) return;
    for (std::size_t n = 0; n < 3; ++n) numbers[n] = vertices_.number_of(rounded[n]);
    if (area < 0.0) std::swap(numbers[1], numbers[2]);
    triangles_.push_back({numbers[0], numbers[1], numbers[2]});
  }

  const CityGround& city_;
  FarTerrainSettings settings_;
  const std::stop_token& stop_;
  Box2d rectangle_;
  RightTriangles triangulation_{side};
  const HeightSamples* raster_ = nullptr;
  double offset_m_ = 0.0;
  std::span<const Coverage> earlier_;
  Found found_;
  SharedVertices vertices_;
  std::vector<Triangle> triangles_;
};

/// Throws InputError where it cannot be true, and reports what it hardly can be. Of the city's own ground all was told when that
/// was read.
void judge(const FarTerrainSource& source, const FarTerrainMaker::Found& found, const CityGround& city, Report& report) {
  if (source.is_ground) return;
  const std::string file = source.file.path.string();
  if (!found.is_around && !source.file.is_named) return;
  if (!found.is_around) throw InputError(file + ": lies more than 200 km away from the city: check its CRS.");
  const Point2d origin = city.georeference.origin_m;
  const Point3d middle{origin.x, origin.y, 0.0};
  if (found.stand_in) {
    std::ostringstream text;
    text << *found.stand_in << " is no height here, and counts as no data; gdal_edit.py -a_nodata " << *found.stand_in
         << " declares it";
    report.add({ProblemCode::undeclared_no_data, file, "the whole file", std::move(text).str(), middle});
  }
  const auto step = plausibility::border_step(found.border_steps_m);
  if (!step) return;
  const std::string what =
      fmt::format("where the grid ends, it is {:.1f} m {}", std::abs(step->median_m), step->median_m > 0.0 ? "above" : "below") +
      " the ground of the city: their heights count from different levels, or the city has none; give the "
      "ground with --terrain, or bring both into one vertical datum";
  if (step->is_everywhere) throw InputError(file + ": " + what + ".");
  report.add({ProblemCode::another_datum, file, "the whole file", what, middle});
}

/// Where the city does not say its vertical system, it is in that of its ground: of the first tile that says one, which lies
/// below the others.
Georeference with_heights_of_ground(Georeference place, std::span<const FarTerrainSource> sources) {
  for (auto source = sources.rbegin(); source != sources.rend() && place.heights_wkt.empty(); ++source)
    if (source->is_ground) place.heights_wkt = georeference::heights_of_terrain(source->file);
  return place;
}

/// The rasters around a city, and where they have heights.
struct RastersAround {
  std::span<const FarTerrainSource> sources;
  std::vector<HeightSamples> rasters = {};
  std::vector<Coverage> coverages = {};

  RastersAround(std::span<const FarTerrainSource> of, const std::string& fallback_crs, const CityGround& city, Report& report)
      : sources(of) {
    Report told;  // when the ground was read
    const Georeference place = with_heights_of_ground(city.georeference, of);
    for (const FarTerrainSource& source : sources)
      rasters.emplace_back(source.file, fallback_crs, place, source.is_ground ? told : report);
    for (std::size_t n = 0; n + 1 < rasters.size(); ++n) coverages.emplace_back(rasters[n], city.grid);
  }
};

/// Nothing where there are too many triangles.
std::optional<FarTerrain> far_terrain_within(const RastersAround& around, const CityGround& city,
                                             const FarTerrainSettings& settings, Report& report, const std::stop_token& stop) {
  FarTerrainMaker maker(city, settings, stop);
  Report found;
  const FarTerrainSource* beyond = nullptr;
  bool is_any_around = false;
  for (std::size_t n = 0; n < around.rasters.size(); ++n) {
    if (!maker.add(around.rasters[n], around.sources[n].offset_m, std::span(around.coverages).subspan(0, n))) return std::nullopt;
    judge(around.sources[n], maker.found(), city, found);
    if (around.sources[n].is_ground) continue;
    beyond = &around.sources[n];
    is_any_around = is_any_around || maker.found().is_around;
  }
  if (beyond != nullptr && !is_any_around)
    throw InputError(beyond->file.path.string() +
                     " and all others of its folder lie more than 200 km away from the city: check their CRS.");
  for (const Problem& problem : found.problems()) report.add(problem);
  return maker.take();
}

}  // namespace

double sinking_m(double distance_m) {
  constexpr double earth_radius_m = 6371008.8, refraction = 0.13;
  return (1.0 - refraction) * distance_m * distance_m / (2.0 * earth_radius_m);
}

FarTerrain far_terrain_around(std::span<const FarTerrainSource> sources, const std::string& fallback_crs, const CityGround& city,
                              const FarTerrainSettings& settings, Report& report, std::vector<std::string>& notes,
                              const std::stop_token& stop) {
  for (const FarTerrainSource& source : sources)
    if (!source.is_ground && fallback_crs.empty() && georeference::read_terrain_extent(source.file).crs_wkt.empty())
      notes.push_back(georeference::note_of_city_crs(source.file.path.string(), 1, city.georeference));
  const RastersAround around(sources, fallback_crs, city, report);
  FarTerrainSettings coarser = settings;
  for (;; coarser.tolerance *= 2.0) {
    auto far_terrain = far_terrain_within(around, city, coarser, report, stop);
    if (!far_terrain) continue;
    if (coarser.tolerance > settings.tolerance) {
      std::ostringstream text;
      text << "The terrain beyond the grid is rough: its heights are kept to within " << 100.0 * coarser.tolerance
           << " % of their distance, to keep it to " << settings.most_triangles << " triangles.";
      notes.push_back(std::move(text).str());
    }
    return std::move(*far_terrain);
  }
}

}  // namespace farlod::far_terrain
