// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/azimuth.hpp"
#include "base/expects.hpp"
#include "farlod/point.hpp"
#include "package/far_map.hpp"
#include "package/horizon_edge.hpp"
#include "package/layout.hpp"
#include "tests/oracles/distance_to_segment.hpp"

namespace farlod {

/// Directions in the order of their azimuths, so that those between two azimuths are a row. All point above the horizontal.
class AzimuthFan {
 public:
  explicit AzimuthFan(std::span<const Point3d> directions);

  [[nodiscard]] std::size_t size() const { return slope_.size(); }
  /// Of the n-th direction: its place among those given, cosine and sine of its azimuth, the tangent of its elevation, and its
  /// pseudo-angle.
  [[nodiscard]] std::span<const std::uint32_t> place() const { return place_; }
  [[nodiscard]] std::span<const float> cosine() const { return cosine_; }
  [[nodiscard]] std::span<const float> sine() const { return sine_; }
  [[nodiscard]] std::span<const float> slope() const { return slope_; }
  [[nodiscard]] std::span<const double> pseudo_angles() const { return pseudo_angles_; }
  /// For each direction the bin of its azimuth.
  [[nodiscard]] std::vector<std::uint32_t> bins(const AzimuthBins& bins) const;
  /// The first direction whose pseudo-angle is at least this; size() when there is none. Any pseudo-angle from 0 to 1.
  [[nodiscard]] std::size_t first_from(double angle) const;

 private:
  /// A direction straight up has no azimuth; any will do, since no horizon is as steep.
  [[nodiscard]] static double pseudo_angle_of(const Point3d& d) {
    return d.x == 0.0 && d.y == 0.0 ? 0.0 : pseudo_angle({d.x, d.y});
  }

  std::vector<std::uint32_t> place_, first_of_slot_;
  std::vector<double> pseudo_angles_;
  std::vector<float> cosine_, sine_, slope_;
};

inline AzimuthFan::AzimuthFan(std::span<const Point3d> directions) : place_(directions.size()) {
  std::iota(place_.begin(), place_.end(), 0U);
  std::stable_sort(place_.begin(), place_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return pseudo_angle_of(directions[a]) < pseudo_angle_of(directions[b]);
  });
  for (const std::uint32_t n : place_) {
    const Point3d& d = directions[n];
    const double across = std::hypot(d.x, d.y);
    pseudo_angles_.push_back(pseudo_angle_of(d));
    cosine_.push_back(static_cast<float>(across > 0.0 ? d.x / across : 1.0));
    sine_.push_back(static_cast<float>(across > 0.0 ? d.y / across : 0.0));
    slope_.push_back(static_cast<float>(d.z / across));
  }
  // A slot for each direction on average: a look-up finds its place within a step or two
  first_of_slot_.resize(directions.size() + 2);
  for (std::size_t slot = 0; slot < first_of_slot_.size(); ++slot) {
    const double from = static_cast<double>(slot) / static_cast<double>(directions.size() + 1);
    first_of_slot_[slot] =
        static_cast<std::uint32_t>(std::lower_bound(pseudo_angles_.begin(), pseudo_angles_.end(), from) - pseudo_angles_.begin());
  }
}

inline std::vector<std::uint32_t> AzimuthFan::bins(const AzimuthBins& bins) const {
  std::vector<std::uint32_t> result;
  for (std::size_t n = 0; n < size(); ++n) result.push_back(bins.bin_of({cosine_[n], sine_[n]}));
  return result;
}

inline std::size_t AzimuthFan::first_from(double angle) const {
  const auto slot = static_cast<std::size_t>(angle * static_cast<double>(size() + 1));
  std::size_t n = first_of_slot_[std::min(slot, first_of_slot_.size() - 1)];
  while (n > 0 && pseudo_angles_[n - 1] >= angle) --n;
  while (n < pseudo_angles_.size() && pseudo_angles_[n] < angle) ++n;
  return n;
}

/// Whether a far map stores an occluder as explicit for a patch (docs/package_format.md, "ExplicitOccluder").
[[nodiscard]] inline bool is_explicit_in(const package::ExplicitOccluder& occluder, const ReceiverPatches& patches,
                                         std::uint32_t patch) {
  const std::uint32_t square = patch % patches.squares(), layer = patch / patches.squares();
  return ((occluder.squares >> square) & 1U) != 0 && ((occluder.layers >> layer) & 1U) != 0;
}

/// What the far city does to a direction, as far as its map knows.
enum class FarVerdict : std::uint8_t {
  free,               ///< hides nothing there, for certain
  estimated_free,     ///< may hide the sky there, and likely does not
  estimated_blocked,  ///< may leave the sky open there, and likely does not
  blocked             ///< hides the sky there, for certain
};

/// Classifies the directions of a fan for receivers of one cell, from its far map of the kind `horizon`, as if all of the far
/// city were grounded.
class FarView {
 public:
  /// Fan and map must outlive it.
  FarView(const AzimuthFan& fan, const FarHorizon& map);

  /// `verdicts[n]` for the n-th direction of the fan, seen from a receiver (cell frame).
  void classify(const Point3f& p_cell, std::span<FarVerdict> verdicts);

 private:
  /// How far a corner may lie from where the exact engine sees it: both round to floats, in frames whose origins are a city apart
  /// (0.25 mm at 4 km each). What is certain gives way by this.
  static constexpr double rounding_m = 0.0005;
  /// Directions round to floats too.
  static constexpr double rounding = 1e-6;
  /// Nearer than this, rounding decides where an edge stands: it may hide anything.
  static constexpr double too_close_m = 0.01;

  /// Without std::hypot's care for numbers that no city has: a tenth of the whole time went into it.
  [[nodiscard]] static double length(Point2d v) { return std::sqrt(dot(v, v)); }
  void draw_explicit(const Point3f& p_cell, std::optional<std::uint32_t> patch);
  void draw(const EdgeView& given);
  /// The directions that an edge covers, by pseudo-angle, and how far its ends may lie from there.
  struct Span {
    double from, to, before, after;
    /// Covered even if both ends move inwards.
    [[nodiscard]] bool surely_covers(double angle) const;
  };
  static constexpr double full_turn = 1.0;
  void raise(const SlopePlane& plane, double give, const Span& span, bool hides);
  void raise_row(const SlopePlane& plane, double give, const Span& span, bool hides, std::size_t first, std::size_t end);

  const AzimuthFan& fan_;
  const FarHorizon& map_;
  std::vector<std::uint32_t> bins_;
  std::vector<EdgeView> edges_cell_;  ///< the explicit edges, cell frame
  std::vector<float> low_, high_;     ///< of the explicit edges, for each direction
};

inline FarView::FarView(const AzimuthFan& fan, const FarHorizon& map)
    : fan_(fan), map_(map), bins_(fan.bins(map.bins)), low_(fan.size()), high_(fan.size()) {
  const Point3d shift{map.occluders.cell_from_block_m.x, map.occluders.cell_from_block_m.y, 0.0};
  const auto placed = [&shift](const Point3f& p) { return shift + Point3d{p.x, p.y, p.z}; };
  for (const package::ExplicitOccluder& occluder : map.occluders.explicit_edges) {
    const HorizonEdge& edge = map.occluders.edges[occluder.row];
    edges_cell_.push_back({placed(edge.a), placed(edge.b)});
  }
}

inline void FarView::classify(const Point3f& p_cell, std::span<FarVerdict> verdicts) {
  FARLOD_EXPECTS(verdicts.size() == fan_.size());
  const std::optional<std::uint32_t> patch = map_.patches.patch_of(p_cell);
  draw_explicit(p_cell, patch);
  const std::size_t bins = map_.bins.count, row = patch.value_or(0) * bins;
  const auto [next_row, share] = map_.floor_above(patch.value_or(0), p_cell.z);
  for (std::size_t n = 0; n < fan_.size(); ++n) {
    const std::size_t bin = bins_[n];
    const float here = map_.estimate[row + bin], above = map_.estimate[next_row * bins + bin];
    // Below the lowest level nothing is certain of the residual city
    const float low = patch ? map_.low[row + bin] : 0.0F;
    const float high = patch ? map_.high[row + bin] : std::numeric_limits<float>::infinity();
    const float estimate = std::clamp(here + share * (above - here), low, high), slope = fan_.slope()[n];
    verdicts[n] = slope < std::max(low_[n], low)         ? FarVerdict::blocked
                  : slope > std::max(high_[n], high)     ? FarVerdict::free
                  : slope > std::max(high_[n], estimate) ? FarVerdict::estimated_free
                                                         : FarVerdict::estimated_blocked;
  }
}

inline void FarView::draw_explicit(const Point3f& p_cell, std::optional<std::uint32_t> patch) {
  std::fill(low_.begin(), low_.end(), 0.0F);
  std::fill(high_.begin(), high_.end(), 0.0F);
  const Point3d eye{p_cell.x, p_cell.y, p_cell.z};
  for (std::size_t n = 0; n < edges_cell_.size(); ++n) {
    const package::ExplicitOccluder& occluder = map_.occluders.explicit_edges[n];
    if (map_.occluders.edges[occluder.row].role == EdgeRole::underside) continue;
    if (!patch || is_explicit_in(occluder, map_.patches, *patch)) draw({edges_cell_[n].a - eye, edges_cell_[n].b - eye});
  }
}

inline void FarView::draw(const EdgeView& given) {
  if (given.a.z <= -rounding_m && given.b.z <= -rounding_m) return;
  EdgeView edge = given;
  if (edge.turn() < 0.0) std::swap(edge.a, edge.b);
  const Point2d a = horizontal(edge.a), b = horizontal(edge.b);
  const double nearest_m = distance_to_segment(a, b);
  if (nearest_m < too_close_m) {
    std::fill(high_.begin(), high_.end(), std::numeric_limits<float>::infinity());
    return;
  }
  const double steepest = std::max({edge.a.z, edge.b.z, 0.0}) / nearest_m;
  // A pseudo-angle grows by a quarter of a turn per radian at the most
  const double turn_a = 0.25 * (rounding_m / length(a) + rounding), turn_b = 0.25 * (rounding_m / length(b) + rounding);
  const double from = pseudo_angle(a), to = pseudo_angle(b);
  // What moves by the rounding rises so much at the distance, and shows another place of its plane, as much steeper as that is
  const auto give = [&](double gradient) { return (rounding_m / nearest_m + rounding) * (1.0 + steepest + gradient); };
  const Span span{from, to, turn_a, turn_b};
  // Looked along, an edge shows no more than its ends
  if (edge.turn() <= rounding_m * length(b - a)) return raise({}, steepest + give(0.0), span, false);
  const SlopePlane plane = edge.plane();
  raise(plane, give(length({plane.along_x, plane.along_y})), span, true);
}

inline bool FarView::Span::surely_covers(double angle) const {
  const auto turn = [](double difference) {
    return difference < -0.5 * full_turn  ? difference + full_turn
           : difference > 0.5 * full_turn ? difference - full_turn
                                          : difference;
  };
  return turn(angle - from) >= before && turn(to - angle) >= after;
}

inline void FarView::raise(const SlopePlane& plane, double give, const Span& span, bool hides) {
  double from = span.from - span.before, to = span.to + span.after;
  if (to < from) to += full_turn;  // the row passes the x axis
  if (from >= full_turn) {
    from -= full_turn;
    to -= full_turn;
  }
  if (from < 0.0) {
    raise_row(plane, give, span, hides, fan_.first_from(from + full_turn), fan_.size());
    from = 0.0;
  }
  if (to > full_turn) {
    raise_row(plane, give, span, hides, 0, fan_.first_from(to - full_turn));
    to = full_turn;
  }
  raise_row(plane, give, span, hides, fan_.first_from(from), fan_.first_from(to));
}

inline void FarView::raise_row(const SlopePlane& plane, double give, const Span& span, bool hides, std::size_t first,
                               std::size_t end) {
  const auto x = static_cast<float>(plane.along_x), y = static_cast<float>(plane.along_y), g = static_cast<float>(give);
  const float *cosine = fan_.cosine().data(), *sine = fan_.sine().data();
  float *const high = high_.data(), *const low = low_.data();
  for (std::size_t n = first; n < end; ++n) high[n] = std::max(high[n], x * cosine[n] + y * sine[n] + g);
  if (!hides) return;
  // Only at its ends is a row in doubt
  while (first < end && !span.surely_covers(fan_.pseudo_angles()[first])) ++first;
  while (end > first && !span.surely_covers(fan_.pseudo_angles()[end - 1])) --end;
  for (std::size_t n = first; n < end; ++n) low[n] = std::max(low[n], x * cosine[n] + y * sine[n] - g);
}

}  // namespace farlod
