// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace farlod {

/// A place as a file gives it, in whole millimetres of the CRS.
using PlaceMm = std::array<std::int64_t, 3>;

/// A building as read back from a file; what a format does not hold stays empty.
struct WrittenBuilding {
  std::int64_t base_mm = 0, height_mm = 0;
  std::size_t polygons = 0, solids = 0;
  std::set<PlaceMm> places;
  std::set<std::string> children, said_by_children;  ///< ids of parts and installations: as it tells, and as they tell
};

struct WrittenCity {
  int epsg = 0;
  std::map<std::string, WrittenBuilding> buildings;
};

[[nodiscard]] std::size_t count_of(const std::string& text, const std::string& word);
[[nodiscard]] WrittenCity read_cityjson(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_geojson(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_obj(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_citygml(const std::filesystem::path& path);

}  // namespace farlod
