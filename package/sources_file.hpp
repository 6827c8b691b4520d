// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "farlod/city_sources.hpp"
#include "package/manifest.hpp"
#include "package/package_folder.hpp"
#include "package/sources_layout.hpp"
#include "package/tile_set.hpp"

namespace farlod {

/// The `sources.bin` of a package, mapped. Everything is checked once:
///   (1) each file is an input of the manifest, and each building is of one of these files or of none
///   (2) places are within their file, and their forms are there
///   (3) surfaces are in order, and name objects and semantic surfaces of their building
class SourcesFile {
 public:
  /// Opens that of a package whose manifest names it. Throws PackageDamaged or PackageUnusable.
  SourcesFile(const PackageFolder& folder, const package::Manifest& manifest);

  [[nodiscard]] const std::vector<PackedCityFile>& files() const { return files_; }
  /// Calls visit(building, file, origin) for each building of the city that is of one of files().
  template <class Visit>
  void visit(const Visit& visit) const {
    for (std::size_t n = 0; n < buildings_.size(); ++n)
      if (buildings_[n].file > 0) visit(static_cast<std::uint32_t>(n), buildings_[n].file - std::size_t{1}, origin_of(n));
  }
  /// What a building of the city comes from, of whatever file; nothing where that is not known.
  [[nodiscard]] std::optional<BuildingOrigin> find(std::uint32_t building) const {
    if (building >= buildings_.size() || buildings_[building].bytes.empty()) return std::nullopt;
    return origin_of(building);
  }

 private:
  struct Row {
    std::uint32_t file = 0;  ///< counted from 1
    std::span<const std::uint8_t> bytes;
  };

  [[nodiscard]] const package::SourcesHeader& header() const;
  void check_header(const package::Manifest& manifest) const;
  void read_file(package::SourcesCursor& cursor, const package::Manifest& manifest);
  void read_building(package::SourcesCursor& cursor);
  [[nodiscard]] BuildingOrigin origin_of(std::size_t building) const;
  void check(const BuildingOrigin& origin, const PackedCityFile& file) const;
  void require(bool rule, const char* what) const { require_whole(rule, name_, what); }

  std::string name_;
  MappedFile mapped_;
  std::vector<PackedCityFile> files_;
  std::vector<Row> buildings_;
};

/// A city file of a package into which attributes can be inserted.
struct SourceOfPackage {
  std::uint32_t input = 0;  ///< in Manifest::inputs
  package::CityFileFormat format = package::CityFileFormat::citygml;
  std::vector<package::AttributeForm> forms;
};

/// Writes `sources.bin` into the folder of a package, which is made where there is none. `files`: as LocatedCity::sources; empty
/// where attributes have no places. Returns its stamp; nothing where no file has places, and no surface an id. Throws
/// OutputError.
[[nodiscard]] std::optional<package::FileStamp> write_sources(const std::filesystem::path& folder, const TileSources& sources,
                                                              std::span<const std::optional<SourceOfPackage>> files);

}  // namespace farlod
