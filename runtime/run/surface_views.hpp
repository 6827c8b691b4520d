// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "evaluate/sky_directions.hpp"
#include "farlod/point.hpp"
#include "occlusion/crown_occluder.hpp"
#include "occlusion/occluder.hpp"
#include "run/seen_columns.hpp"

namespace farlod {

/// A receiver of a surface, in the frame of the scene of the whole city.
struct ReceiverInScene {
  Point3f p_scene;
  Point3f normal;  ///< grid frame
  float area_m2 = 0.0F;
};

/// What rays from surfaces meet.
struct SceneOfColumns {
  const Occluder& solid;
  const CrownOccluder* crowns = nullptr;  ///< null where there are none
  const SeenColumns& seen;
  MatrixColumns columns;
};

/// An entry of a row: the share of the view that a column fills.
struct ViewShare {
  std::uint32_t column = 0;
  float share = 0.0F;
};

/// Adds up what rays meet, column by column. One serves a thread, surface by surface.
class ColumnSums {
 public:
  explicit ColumnSums(std::size_t columns) : sums_(columns, 0.0) {}
  void add(std::uint32_t column, double amount) {
    double& sum = sums_[column];
    if (sum == 0.0) touched_.push_back(column);
    sum += amount;
  }
  /// The shares of all that was added, in the order of their columns; nothing is added thereafter.
  [[nodiscard]] std::vector<ViewShare> shares_and_clear();

 private:
  std::vector<double> sums_;
  std::vector<std::uint32_t> touched_;
};

/// What the receivers of a surface see, by their areas: nothing where there are none. Throws Cancelled when `stop` is asked for.
[[nodiscard]] std::vector<ViewShare> views_of(std::span<const ReceiverInScene> receivers, const SceneOfColumns& scene,
                                              const SkyDirections& directions, ColumnSums& sums, const std::stop_token& stop);

}  // namespace farlod
