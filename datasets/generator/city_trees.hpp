// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "generator/city_layout.hpp"
#include "generator/city_settings.hpp"
#include "generator/city_text_file.hpp"
#include "generator/city_writer.hpp"
#include "generator/generated_building.hpp"

namespace farlod {

/// A tree of a generated city. All lengths are in whole millimetres.
struct GeneratedTree {
  PlanPointMm place{};  ///< city frame
  std::int64_t height_mm = 0, crown_mm = 0, trunk_mm = 0;
  bool is_evergreen = false;
};

/// The trees along the kerbs of a block, and in its yards or its park. They depend on nothing but the settings and the block.
///   (1) along avenues stands a row, along other streets some; none is nearer than 6 m to another one of its side
///   (2) in yards, none stands in the footprint of a building, or within 2 m of the rectangle around it
[[nodiscard]] std::vector<GeneratedTree> trees_of_block(const CitySettings& settings, CityBlock block,
                                                        std::span<const GeneratedBuilding> buildings);

/// Writes trees as points of GeoJSON in the CRS of the city, with `height`, `crown_diameter`, `trunk_height` and `leaf_cycle`.
/// The file gets its name at the end. All members throw OutputError.
class TreeWriter {
 public:
  TreeWriter(const std::filesystem::path& path, const CityHeader& header);
  void add(const GeneratedTree& tree);
  void end();

 private:
  CityHeader header_;
  CityTextFile file_;
  bool is_first_ = true;
};

}  // namespace farlod
