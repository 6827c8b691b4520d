// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/expects.hpp"
#include "farlod/box.hpp"
#include "generator/city_settings.hpp"
#include "generator/plan_frame.hpp"

namespace farlod {

/// A block of the city by column (avenues) and row (streets), from the south-west of the plan.
struct CityBlock {
  std::int32_t i = 0, j = 0;
  bool operator==(const CityBlock&) const = default;
};

/// The streets of a city, and the blocks between them. The place of a street is computed without that of the others, so that a
/// city of any size can be made block by block.
///   (1) blocks lie within the square of the city, and do not touch each other
///   (2) between neighboring blocks lies a street at least as wide as asked for
class CityLayout {
 public:
  explicit CityLayout(const CitySettings& settings);

  [[nodiscard]] std::int32_t columns() const { return columns_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t block_count() const { return std::int64_t{columns_} * rows_; }
  [[nodiscard]] bool contains(CityBlock block) const {
    return 0 <= block.i && block.i < columns_ && 0 <= block.j && block.j < rows_;
  }
  /// Row by row from the south, each from the west.
  [[nodiscard]] CityBlock block_at(std::int64_t index) const {
    return {static_cast<std::int32_t>(index % columns_), static_cast<std::int32_t>(index / columns_)};
  }
  /// The block's rectangle in the plan: from kerb to kerb.
  [[nodiscard]] Box2d rectangle(CityBlock block) const;

 private:
  enum class Line { avenue, street };
  [[nodiscard]] double axis_m(Line line, std::int32_t number) const;
  [[nodiscard]] double half_width_m(Line line, std::int32_t number) const;

  CitySettings settings_;
  std::int32_t columns_, rows_;
};

/// A side of a block as the frame of its lots: u runs counter-clockwise along the side, v into the block.
[[nodiscard]] LotFrame side_frame(const Box2d& rectangle, int side);
/// Length of that side.
[[nodiscard]] double side_length_m(const Box2d& rectangle, int side);

}  // namespace farlod
