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

[[nodiscard]] std::string text_of(const std::filesystem::path& path);
[[nodiscard]] std::size_t count_of(const std::string& text, const std::string& word);
[[nodiscard]] WrittenCity read_cityjson(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_geojson(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_obj(const std::filesystem::path& path);
[[nodiscard]] WrittenCity read_citygml(const std::filesystem::path& path);

/// A folder that is gone after the test.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::size_t file_count() const;

 private:
  std::filesystem::path path_;
};

}  // namespace farlod
