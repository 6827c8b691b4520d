// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "generator/building_plan.hpp"

namespace farlod {

/// The walls of the buildings of a block in plan, to find where those of two buildings coincide. The answer is exact, since plans
/// have whole centimetres.
class TouchingWalls {
 public:
  explicit TouchingWalls(std::span<const BuildingPlan> plans);

  /// Whether a wall of another building than `building` overlaps the axis-parallel segment from a to b (plan frame).
  [[nodiscard]] bool touches(std::size_t building, Point2d a, Point2d b) const;
  /// Whether a wall of another building touches any wall of this one.
  [[nodiscard]] bool touches_any(std::size_t building) const;

 private:
  struct Line {
    std::size_t building;
    std::array<std::int64_t, 2> low_cm, high_cm;
  };
  [[nodiscard]] static Line line_of(std::size_t building, Point2d a, Point2d b);
  [[nodiscard]] bool touches(const Line& line) const;

  std::vector<Line> lines_;
};

}  // namespace farlod
