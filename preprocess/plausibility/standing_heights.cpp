// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/standing_heights.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "plausibility/doubtful_terrain.hpp"
#include "plausibility/elevations_as_heights.hpp"
#include "plausibility/ground_at_buildings.hpp"

namespace farlod::plausibility {
namespace {

/// What a base of a building and the ground below it may differ by: kerbs, plinths, and how exact both are.
constexpr double tolerance_m = 0.75;
/// An offset that is reported. Some surveys draw all walls down to the floors of cellars.
constexpr double least_above_m = 1.5, least_below_m = 3.2;
/// No town stands so high above its ground.
constexpr double impossible_above_m = 10.0;
/// Fewer buildings may all stand on piles, or in a pit.
constexpr std::size_t enough_buildings = 8;
/// The shares of buildings that stand on the ground as they are, at the most, and with the offset, at the least.
constexpr double most_on_ground = 0.2, least_on_ground_with_offset = 0.75;
/// A building that hangs above all ground below it, and how many of them are told: more than are on stilts or on bridges.
constexpr double least_hanging_m = 2.0, least_hanging_share = 0.2;
constexpr std::size_t fewest_hanging = 4;
/// A file may have several towns, and a terrain several sheets.
constexpr double square_m = 2000.0;
/// So many buildings of a square are compared with the ground, each at so many of its points.
constexpr std::size_t most_buildings = 256, most_points = 16;

/// The offsets, from `low_m` to `high_m`, with which a building stands on the ground.
struct Standing {
  double low_m = 0.0, high_m = 0.0;
  bool is_buried = false;  ///< its roof is below the ground, too

  /// From the highest ground below it to its base.
  [[nodiscard]] double gap_m() const { return low_m + tolerance_m; }
};

std::optional<Standing> standing_of(std::span<const Point3d> points, const KnownGroundHeightAt& ground_height) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double base_m = infinity, top_m = -infinity, lowest_ground_m = infinity, highest_ground_m = -infinity;
  const std::size_t stride = std::max<std::size_t>(points.size() / most_points, 1);
  for (std::size_t n = 0; n < points.size(); ++n) {
    base_m = std::min(base_m, points[n].z);
    top_m = std::max(top_m, points[n].z);
    if (n % stride != 0) continue;
    const auto ground_m = ground_height(horizontal(points[n]));
    if (!ground_m) continue;
    lowest_ground_m = std::min(lowest_ground_m, *ground_m);
    highest_ground_m = std::max(highest_ground_m, *ground_m);
  }
  if (lowest_ground_m > highest_ground_m) return std::nullopt;
  return Standing{base_m - highest_ground_m - tolerance_m, base_m - lowest_ground_m + tolerance_m, top_m <= lowest_ground_m};
}

std::size_t standing_with(double offset_m, const std::vector<Standing>& buildings) {
  return static_cast<std::size_t>(std::count_if(buildings.begin(), buildings.end(),
                                                [&](const Standing& s) { return s.low_m <= offset_m && offset_m <= s.high_m; }));
}

/// The offsets that most intervals share.
struct SharedOffsets {
  double low_m = 0.0, high_m = 0.0;
  std::size_t standing = 0;

  /// No offset outside of what the tolerance allows is nearer to 0.
  [[nodiscard]] bool are_far() const { return low_m + tolerance_m >= least_above_m || high_m - tolerance_m <= -least_below_m; }
};

SharedOffsets shared_offsets(const std::vector<Standing>& buildings) {
  std::vector<std::pair<double, int>> ends;  // at one place, intervals begin before others end
  for (const Standing& s : buildings) {
    ends.emplace_back(s.low_m, -1);
    ends.emplace_back(s.high_m, 1);
  }
  std::sort(ends.begin(), ends.end());
  SharedOffsets best;
  std::size_t open = 0;
  for (std::size_t n = 0; n < ends.size(); ++n) {
    open = ends[n].second < 0 ? open + 1 : open - 1;
    if (open > best.standing) best = {ends[n].first, ends[n + 1].first, open};
  }
  return best;
}

/// How far above the lowest ground under them the buildings begin, typically: most models are drawn down to it.
double typical_offset_m(std::vector<Standing> buildings) {
  const auto middle = buildings.begin() + static_cast<std::ptrdiff_t>(buildings.size() / 2);
  std::nth_element(buildings.begin(), middle, buildings.end(),
                   [](const Standing& a, const Standing& b) { return a.high_m < b.high_m; });
  return middle->high_m - tolerance_m;
}

/// Some buildings of a file.
struct Group {
  std::size_t count = 0;
  std::vector<Standing> compared;
  Point3d place;  ///< of the first one

  void add(const Standing& standing, const Point3d& p) {
    if (count++ == 0) place = p;
    if (compared.size() < most_buildings) compared.push_back(standing);
  }
  void add(const Group& group) {
    if (count == 0) place = group.place;
    count += group.count;
    compared.insert(compared.end(), group.compared.begin(), group.compared.end());
  }
  [[nodiscard]] bool is_buried() const {
    return 2 * std::count_if(compared.begin(), compared.end(), [](const Standing& s) { return s.is_buried; }) >
           static_cast<std::ptrdiff_t>(compared.size());
  }
  /// Rule (1) of report_standing.
  [[nodiscard]] std::optional<double> offset_m() const {
    const auto all = static_cast<double>(compared.size());
    const SharedOffsets shared = shared_offsets(compared);
    const double offset_m = typical_offset_m(compared);
    const bool is_certain = compared.size() >= enough_buildings || std::abs(offset_m) >= impossible_above_m;
    const bool is_told = shared.are_far() && is_certain &&
                         static_cast<double>(shared.standing) >= least_on_ground_with_offset * all &&
                         static_cast<double>(standing_with(0.0, compared)) <= most_on_ground * all;
    return is_told ? std::optional(offset_m) : std::nullopt;
  }
};

/// Buildings that hang above the ground, each by itself.
struct HangingBuildings {
  std::size_t compared = 0, count = 0;
  double most_m = 0.0;
  std::string first_id;
  Point3d place;  ///< of the first one

  void add(const Standing& standing, const std::string& id, const Point3d& p) {
    ++compared;
    if (standing.gap_m() < least_hanging_m) return;
    if (count++ == 0) {
      first_id = id;
      place = p;
    }
    most_m = std::max(most_m, standing.gap_m());
  }
  [[nodiscard]] bool are_told() const {
    return compared >= enough_buildings && count >= fewest_hanging &&
           static_cast<double>(count) >= least_hanging_share * static_cast<double>(compared);
  }
};

/// All that is to be said of a file.
struct FileStanding {
  std::map<std::pair<std::int64_t, std::int64_t>, Group> squares;
  std::size_t buildings = 0, beyond = 0;
  std::optional<Point3d> first_beyond;
  std::string first_id;  ///< of those beyond
  HangingBuildings hanging;

  void add(const std::string& id, std::span<const Point3d> points, const SurveyedGround& ground) {
    Box2d box;
    for (const Point3d& p : points) box.add(horizontal(p));
    const Point2d middle = 0.5 * (box.low + box.high);
    ++buildings;
    if (!ground.extent_city.contains(middle)) {
      ++beyond;
      if (first_beyond) return;
      first_beyond = points.front();
      first_id = id;
      return;
    }
    const auto number = [](double m) { return static_cast<std::int64_t>(std::floor(m / square_m)); };
    const auto standing = standing_of(points, ground.height_at);
    if (!standing) return;
    squares[{number(middle.x), number(middle.y)}].add(*standing, points.front());
    hanging.add(*standing, id, points.front());
  }
};

std::vector<FileStanding> standing_of_files(const LocatedCity& located, const SurveyedGround& ground) {
  std::vector<FileStanding> files(std::max<std::size_t>(located.sources.size(), 1));
  const CityModel& city = located.city;
  city.for_each_building([&](std::size_t, const Building& b) {
    if (b.height_reference != HeightReference::elevation || b.foot == Foot::above_ground || city.points_of(b).empty()) return;
    files[b.source].add(b.id, city.points_of(b), ground);
  });
  return files;
}

/// Buildings of a file that have one offset, or those of several squares that have one each.
struct OffsetOfFile {
  std::size_t buildings = 0, impossible = 0;
  double least_m = std::numeric_limits<double>::infinity(), most_m = -least_m;
  Point3d place;

  void add(const Group& group, double offset_m) {
    if (buildings == 0) place = group.place;
    buildings += group.count;
    impossible += offset_m >= impossible_above_m || group.is_buried() ? group.count : 0;
    least_m = std::min(least_m, offset_m);
    most_m = std::max(most_m, offset_m);
  }
};

/// The offset of the file as a whole, else those of its squares.
std::optional<OffsetOfFile> offset_of(const FileStanding& file) {
  OffsetOfFile all;
  Group whole;
  for (const auto& [square, group] : file.squares) whole.add(group);
  if (const auto offset_m = whole.compared.empty() ? std::nullopt : whole.offset_m()) {
    all.add(whole, *offset_m);
    return all;
  }
  for (const auto& [square, group] : file.squares)
    if (const auto offset_m = group.offset_m()) all.add(group, *offset_m);
  return all.buildings == 0 ? std::nullopt : std::optional(all);
}

std::string metres(double length_m) { return fmt::format("{:.1f}", length_m); }

/// The option counts from the raster, and not from the ground that it raised already.
std::string advice_for(double above_ground_m, const SurveyedGround& ground) {
  if (!ground.is_raster) return "Bring the relief and the buildings of the file to one datum";
  const double tenth_m = std::round(10.0 * (ground.offset_m + above_ground_m)) / 10.0;
  return "--terrain-offset " + metres(tenth_m == 0.0 ? 0.0 : tenth_m) +  // and not -0.0
         (ground.offset_m == 0.0 ? "" : " instead of " + fmt::format("{}", ground.offset_m)) + " would " +
         (above_ground_m > 0.0 ? "raise" : "lower") + " the terrain to them";
}

std::string detail_of(const OffsetOfFile& offset, std::size_t all, const SurveyedGround& ground) {
  const double middle_m = 0.5 * (offset.least_m + offset.most_m);
  const double near_m = std::min(std::abs(offset.least_m), std::abs(offset.most_m));
  const double far_m = std::max(std::abs(offset.least_m), std::abs(offset.most_m));
  const std::string height = far_m - near_m < 1.0 ? metres(std::abs(middle_m)) : metres(near_m) + " to " + metres(far_m);
  return std::to_string(offset.buildings) + " of " + std::to_string(all) + " buildings stand " + height + " m " +
         (middle_m > 0.0 ? "above" : "below") + " the ground, all alike: are both heights above the same datum? " +
         advice_for(middle_m, ground);
}

std::string detail_of(const HangingBuildings& hanging, std::size_t all, bool is_raster) {
  return std::to_string(hanging.count) + " of " + std::to_string(all) + " buildings hang " +
         fmt::format("{:g}", least_hanging_m) + " m or more above the " + (is_raster ? "terrain" : "relief") + ", up to " +
         metres(hanging.most_m) + " m, and not all alike, the first of them " + hanging.first_id +
         ": the sky is seen below them; is the terrain of another time or too coarse, or does the model begin at a storey?";
}

std::string detail_of(const FileStanding& file, bool is_raster) {
  const std::string survey = is_raster ? "terrain" : "relief";
  return std::to_string(file.beyond) + " of " + std::to_string(file.buildings) + " buildings lie beyond the " + survey +
         ", the first of them " + file.first_id + ": the ground below them is as high as the nearest of the " + survey +
         (is_raster ? "; give all of it with --terrain" : "; --terrain DEM gives all of it");
}

/// Whether the ground is in another unit. Then it may have bumps as high as roofs, and all comparisons would be in vain.
bool is_in_another_unit(const LocatedCity& located, const SurveyedGround& ground, Report& report) {
  const GroundBelowBuildings below = ground_below(located, ground);
  if (report_unit_of_terrain(below, located, ground, report)) return true;
  require_ground_without_roofs(located, ground);
  if (report_steep_terrain(below, located, ground, report)) return true;
  report_heights_above_ground(located, ground, report);
  report_roofs(located, ground, report);
  return false;
}

}  // namespace

Box2d extent_of_survey(const std::optional<TerrainRaster>& terrain, std::span<const Point3d> relief_points_city) {
  Box2d extent;
  for (const Point3d& p : relief_points_city) extent.add(horizontal(p));
  if (!terrain) return extent;
  for (std::size_t row = 0; row < terrain->rows; ++row)
    for (std::size_t column = 0; column < terrain->columns; ++column)
      if (terrain->height_m[row * terrain->columns + column]) extent.add(terrain->node(column, row));
  return extent;
}

void report_standing(const LocatedCity& located, const SurveyedGround& ground, Report& report) {
  const bool is_in_vain = is_in_another_unit(located, ground, report);
  const std::vector<FileStanding> files = standing_of_files(located, ground);
  std::size_t all = 0, impossible = 0;
  for (const FileStanding& file : files) all += file.buildings;
  const Point2d origin_m = located.georeference.origin_m;
  const auto tell = [&](ProblemCode code, std::size_t n, std::string detail, const Point3d& p_city) {
    const std::string source = n < located.sources.size() ? located.sources[n] : "";
    report.add({code, source, "the whole file", std::move(detail), p_city + Point3d{origin_m.x, origin_m.y, 0.0}});
  };
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (files[n].beyond > 0) tell(ProblemCode::beyond_terrain, n, detail_of(files[n], ground.is_raster), *files[n].first_beyond);
    const auto offset = is_in_vain ? std::nullopt : offset_of(files[n]);
    const HangingBuildings& hanging = files[n].hanging;
    if (!offset && !is_in_vain && hanging.are_told())
      tell(ProblemCode::another_datum, n, detail_of(hanging, files[n].buildings, ground.is_raster), hanging.place);
    if (!offset) continue;
    const std::string detail = detail_of(*offset, files[n].buildings, ground);
    tell(ProblemCode::another_datum, n, detail, offset->place);
    impossible += offset->impossible;
    if (2 * impossible > all) throw InputError((n < located.sources.size() ? located.sources[n] + ": " : "") + detail + ".");
  }
}

}  // namespace farlod::plausibility
