// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plausibility/described_twice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "city/geometry.hpp"
#include "farlod/box.hpp"

namespace farlod::plausibility {
namespace {

/// By area of the plan's box. Files outline the same building differently, or one divides it.
constexpr double least_times_larger = 0.5, most_times_larger = 25.0, least_shared_height = 0.5;
/// A mesh of a whole town is no building.
constexpr double largest_plan_m2 = 1e6;
constexpr double least_share_of_common = 0.25, least_share_of_all = 0.05;
constexpr std::size_t enough_twice = 3;
/// Buildings are found again by the squares that their plans touch, and a large city is looked at in some of its districts.
constexpr double plan_square_m = 50.0, district_m = 500.0;
constexpr std::size_t most_candidates = 200'000;

struct Extent {
  Box2d plan;
  double low_m = std::numeric_limits<double>::infinity(), high_m = -std::numeric_limits<double>::infinity();

  void add(const Point3d& p) {
    plan.add(horizontal(p));
    low_m = std::min(low_m, p.z);
    high_m = std::max(high_m, p.z);
  }
  [[nodiscard]] Point2d middle() const { return 0.5 * (plan.low + plan.high); }
  [[nodiscard]] double plan_m2() const { return (plan.high.x - plan.low.x) * (plan.high.y - plan.low.y); }
};

Extent extent_of(std::span<const Point3d> points) {
  Extent extent;
  for (const Point3d& p : points) extent.add(p);
  return extent;
}

bool share_heights(const Extent& a, const Extent& b) {
  const double shared_m = std::min(a.high_m, b.high_m) - std::max(a.low_m, b.low_m);
  return shared_m >= least_shared_height * std::min(a.high_m - a.low_m, b.high_m - b.low_m);
}

/// Whether a place lies in a ring, seen from above, by the even-odd rule.
bool lies_in(std::span<const Point3d> ring, Point2d p) {
  bool inside = false;
  for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
    const Point3d &a = ring[before], &b = ring[k];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

bool lies_in_plan(const CityModel& city, const Building& building, Point2d p) {
  const auto facets = city.facets_of(building);
  return std::any_of(facets.begin(), facets.end(), [&](const Facet& facet) {
    bool inside = false;
    for (std::uint32_t k = 0; k < facet.ring_count; ++k) inside = inside != lies_in(city.ring(facet, k), p);
    return inside;
  });
}

using Square = std::pair<std::int64_t, std::int64_t>;

Square square_of(Point2d p, double edge_m) {
  return {static_cast<std::int64_t>(std::floor(p.x / edge_m)), static_cast<std::int64_t>(std::floor(p.y / edge_m))};
}

/// Visits the squares that a box touches.
template <class Visit>
void for_each_square(const Box2d& box, const Visit& visit) {
  const Square low = square_of(box.low, plan_square_m), high = square_of(box.high, plan_square_m);
  for (std::int64_t x = low.first; x <= high.first; ++x)
    for (std::int64_t y = low.second; y <= high.second; ++y) visit(Square{x, y});
}

struct FileExtent {
  Box2d plan;
  std::size_t buildings = 0;
  std::vector<std::size_t> others;  ///< numbers of the files whose extents meet this one
};

std::vector<FileExtent> extents_of_files(const LocatedCity& located) {
  std::vector<FileExtent> files(located.sources.size());
  located.city.for_each_building([&](std::size_t, const Building& b) {
    for (const Point3d& p : located.city.points_of(b)) files[b.source].plan.add(horizontal(p));
    ++files[b.source].buildings;
  });
  for (std::size_t n = 0; n < files.size(); ++n)
    for (std::size_t other = 0; other < files.size(); ++other)
      if (other != n && boxes_meet(files[n].plan, files[other].plan)) files[n].others.push_back(other);
  return files;
}

/// A building that reaches into the extent of another file.
struct Candidate {
  const Building* building;
  Extent extent;
};

/// The candidates of a city; of a large one those of some districts, evenly spread.
std::vector<Candidate> candidates_of(const CityModel& city, const std::vector<FileExtent>& files) {
  std::size_t buildings = 0;
  for (const FileExtent& file : files) buildings += file.others.empty() ? 0 : file.buildings;
  const auto every = static_cast<std::int64_t>(buildings / most_candidates + 1);
  std::vector<Candidate> candidates;
  city.for_each_building([&](std::size_t, const Building& b) {
    const FileExtent& file = files[b.source];
    if (file.others.empty() || city.points_of(b).empty()) return;
    const Candidate candidate{&b, extent_of(city.points_of(b))};
    const Square district = square_of(candidate.extent.middle(), district_m);
    if ((district.first + 7 * district.second) % every != 0) return;
    const auto reaches_into = [&](std::size_t n) { return boxes_meet(files[n].plan, candidate.extent.plan); };
    if (std::any_of(file.others.begin(), file.others.end(), reaches_into)) candidates.push_back(candidate);
  });
  return candidates;
}

/// How many buildings of a file lie in the extent of another one, and how many of these the other has, too.
struct Common {
  std::size_t candidates = 0, twice = 0;
  Point3d first;  ///< a point of the first that is there twice

  [[nodiscard]] bool is_told(std::size_t all) const {
    const auto count = static_cast<double>(twice);
    return twice >= enough_twice && count >= least_share_of_common * static_cast<double>(candidates) &&
           count >= least_share_of_all * static_cast<double>(all);
  }
};

/// The numbers of two files: that of the buildings, and the one that may have them, too.
using FilePair = std::pair<std::size_t, std::size_t>;

class Comparison {
 public:
  Comparison(const CityModel& city, const std::vector<FileExtent>& files) : city_(city), files_(files) {}

  std::map<FilePair, Common> run() {
    const std::vector<Candidate> candidates = candidates_of(city_, files_);
    for (const Candidate& c : candidates)
      if (c.extent.plan_m2() < largest_plan_m2)
        for_each_square(c.extent.plan, [&](const Square& square) { squares_[square].push_back(&c); });
    for (const Candidate& c : candidates) compare(c);
    return std::move(common_);
  }

 private:
  void compare(const Candidate& candidate) {
    const std::size_t file = candidate.building->source;
    const Point2d middle = candidate.extent.middle();
    const auto near = squares_.find(square_of(middle, plan_square_m));
    for (const std::size_t other : files_[file].others) {
      if (!files_[other].plan.contains(middle)) continue;
      Common& common = common_[{file, other}];
      ++common.candidates;
      const bool is_twice =
          near != squares_.end() && std::any_of(near->second.begin(), near->second.end(), [&](const Candidate* larger) {
            return larger->building->source == other && are_one(candidate, *larger);
          });
      if (is_twice && common.twice++ == 0) common.first = city_.points_of(*candidate.building).front();
    }
  }

  [[nodiscard]] bool are_one(const Candidate& a, const Candidate& larger) const {
    const Point2d middle = a.extent.middle();
    const double times = larger.extent.plan_m2() / a.extent.plan_m2();
    if (!(least_times_larger <= times && times <= most_times_larger) || !larger.extent.plan.contains(middle)) return false;
    const auto is_elevation = [](const Candidate& c) { return c.building->height_reference == HeightReference::elevation; };
    if (is_elevation(a) && is_elevation(larger) && !share_heights(a.extent, larger.extent)) return false;
    return lies_in_plan(city_, *larger.building, middle);
  }

  const CityModel& city_;
  const std::vector<FileExtent>& files_;
  std::map<Square, std::vector<const Candidate*>> squares_;
  std::map<FilePair, Common> common_;
};

}  // namespace

void report_described_twice(const LocatedCity& located, Report& report) {
  if (located.sources.size() < 2) return;
  const std::vector<FileExtent> files = extents_of_files(located);
  const std::map<FilePair, Common> common = Comparison(located.city, files).run();
  const auto is_told = [&](const FilePair& pair) {
    const auto found = common.find(pair);
    return found != common.end() && found->second.is_told(files[pair.first].buildings);
  };
  for (const auto& [pair, of_pair] : common) {
    const auto [file, other] = pair;
    if (!is_told(pair) || (file < other && is_told({other, file}))) continue;
    report.add({ProblemCode::described_twice, located.sources[file], "the whole file",
                std::to_string(of_pair.twice) + " of the " + std::to_string(of_pair.candidates) + " buildings in the extent of " +
                    located.sources[other] + " are there, too: give one of the two files",
                of_pair.first});
  }
}

}  // namespace farlod::plausibility
