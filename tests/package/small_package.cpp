// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/package/small_package.hpp"

#include <fstream>
#include <iterator>

#include "base/expects.hpp"
#include "package/file_stamp.hpp"
#include "tests/scenes/scene_builder.hpp"
#include "tests/scenes/sealed_manifest.hpp"

namespace farlod {
namespace fs = std::filesystem;
using nlohmann::json;

Bytes bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

void write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

namespace {

FarMapSettings small_maps_of(FarMapKind kind) {
  if (kind == FarMapKind::box) return scenes::box_maps(4, 4);
  FarMapSettings settings;
  settings.horizon.azimuth_bins = 8;
  settings.horizon.layers = 3;
  return settings;
}

}  // namespace

SmallPackage::SmallPackage(FarMapKind kind) {
  scenes::SceneBuilder builder;
  for (const double x : {2.0, 22.0, 42.0}) builder.add_box({{x, 3.0}, {x + 6.0, 9.0}}, 0.0, 4.0 + x);
  builder.add_box({{10.0, 14.0}, {32.0, 17.0}}, 9.0, 10.0);
  const Grid grid = scenes::grid_covering(builder.city(), {}, 20.0, 1, 2);
  FARLOD_EXPECTS(grid.cells == (CellRange{0, 0, 3, 1}));
  scenes::pack_city(builder.city(), grid, folder_, small_maps_of(kind));
  // Give all lists of the manifest an entry
  json m = manifest();
  m["inputs"].push_back({{"name", "town.gml"}, {"bytes", 1}, {"xxh3", "ff"}});
  m["crs"]["epsg"] = 25832;
  write_manifest(m);
}

json SmallPackage::manifest() const {
  std::ifstream file(folder_ / package::manifest_file);
  json m = json::parse(file);
  m.erase("xxh3");
  return m;
}

void SmallPackage::write_manifest(const json& manifest) const {
  std::ofstream(folder_ / package::manifest_file) << scenes::sealed(manifest.dump(1) + "\n");
}

void SmallPackage::stamp_anew() const {
  json m = manifest();
  for (json& block : m["blocks"]) {
    const fs::path folder = folder_ / package::block_folder({block["i"], block["j"]});
    for (const auto& [key, name] : {std::pair("tiles", package::tiles_file), std::pair("far_map", package::far_map_file)}) {
      const package::FileStamp stamp = stamp_of(folder / name);
      std::ostringstream digits;
      digits << std::hex << stamp.xxh3;
      block[key] = {{"bytes", stamp.bytes}, {"xxh3", digits.str()}};
    }
  }
  write_manifest(m);
}

package::Section& TilesBytes::section(package::SectionKind kind) {
  for (std::uint32_t n = 0; n < header().section_count; ++n) {
    auto& section = at<package::Section>(sizeof(package::Header) + n * sizeof(package::Section));
    if (section.kind == kind) return section;
  }
  FARLOD_EXPECTS(false && "the section exists");
  return at<package::Section>(0);
}

std::string damage_met_by(const std::function<void()>& work) {
  try {
    work();
  } catch (const PackageDamaged& damage) {
    return damage.what();
  }
  return "no damage";
}

}  // namespace farlod
