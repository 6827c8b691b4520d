// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "package/far_map.hpp"

namespace farlod {

/// A far map of the kind `horizon`, made by hand: all edges matter everywhere, and the residual city hides nothing.
class FarHorizonByHand {
 public:
  static constexpr double cell_m = 20.0;

  explicit FarHorizonByHand(std::vector<HorizonEdge> edges, std::vector<float> levels_m = {0.0F, 10.0F})
      : edges_(std::move(edges)), map_{ReceiverPatches(cell_m, 1, std::move(levels_m)), AzimuthBins{8}, {}, {}, {}, {}, {}} {
    for (std::uint32_t n = 0; n < edges_.size(); ++n) occluders_.push_back({n, 0xFFFF, 0xFFFF});
    map_.low.resize(std::size_t{map_.patches.count()} * map_.bins.count, 0.0F);
    map_.estimate = map_.high = map_.overhang = map_.low;
    map_.occluders = {edges_, occluders_, {}};
  }
  FarHorizonByHand(const FarHorizonByHand&) = delete;
  FarHorizonByHand& operator=(const FarHorizonByHand&) = delete;

  [[nodiscard]] FarHorizon& map() { return map_; }
  [[nodiscard]] std::vector<package::ExplicitOccluder>& occluders() { return occluders_; }

  /// What the explicit edges hide in a direction, ray by ray: the greatest slope at which it meets one of them; 0 where it meets
  /// none.
  [[nodiscard]] double horizon(const Point3f& p_cell, const Point3d& direction) const {
    double highest = 0.0;
    for (const HorizonEdge& e : edges_) highest = std::max(highest, slope_met(e, p_cell, direction).value_or(0.0));
    return highest;
  }

 private:
  /// Where the vertical plane through the ray crosses the edge in front of the eye.
  static std::optional<double> slope_met(const HorizonEdge& e, const Point3f& p, const Point3d& d) {
    const auto seen = [&p](const Point3f& q) { return Point3d{double{q.x} - p.x, double{q.y} - p.y, double{q.z} - p.z}; };
    const Point3d a = seen(e.a), b = seen(e.b);
    const auto across = [&d](const Point3d& q) { return d.x * q.y - d.y * q.x; };
    if (across(a) * across(b) >= 0.0) return std::nullopt;
    const double t = across(a) / (across(a) - across(b));
    const Point3d met = (1.0 - t) * a + t * b;
    if (met.x * d.x + met.y * d.y <= 0.0) return std::nullopt;
    return met.z / norm(horizontal(met));
  }

  std::vector<HorizonEdge> edges_;
  std::vector<package::ExplicitOccluder> occluders_;
  FarHorizon map_;
};

}  // namespace farlod
