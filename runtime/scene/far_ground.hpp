// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/grid.hpp"
#include "package/package_reader.hpp"
#include "scene/plan_index.hpp"

namespace farlod {

/// The ground in a cell outside of the grid, where the package has a far terrain there.
class FarGround {
 public:
  FarGround(const PackageReader& package, Cell cell);

  /// The height of the highest far terrain at a place in the frame of the cell; none where there is none.
  [[nodiscard]] std::optional<float> height_at(float x_cell, float y_cell) const;

 private:
  PlanIndex index_;
};

}  // namespace farlod
