// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "occlusion/crown_occluder.hpp"
#include "package/crown.hpp"
#include "package/manifest.hpp"
#include "scene/canopy_around.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

/// How many crowns of each shape a manifest must count for these bytes to be read, if they can be at all.
std::array<std::uint64_t, crown_shape_count> crowns_of_shape(std::span<const std::byte> bytes) {
  std::array<std::uint64_t, crown_shape_count> counts{};
  if (bytes.size() < sizeof(package::CrownsHeader)) return counts;
  package::CrownsHeader header{};
  std::memcpy(&header, bytes.data(), sizeof header);
  const std::uint64_t cells = std::min<std::uint64_t>(header.cell_count, bytes.size());
  for (std::size_t at = package::crowns_file_bytes(cells, 0); at + sizeof(Crown) <= bytes.size(); at += sizeof(Crown))
    if (const auto shape = static_cast<std::size_t>(bytes[at + offsetof(Crown, shape)]); shape < counts.size()) ++counts[shape];
  return counts;
}

/// Beside the sample's manifest, which names these crowns.
void write_crowns(const std::filesystem::path& folder, std::span<const std::byte> bytes) {
  nlohmann::json m = open_manifest(sample_packages()[0]);
  m["version"] = package::format_version;
  m["canopy"] = entry_of_file(bytes);
  auto counts = crowns_of_shape(bytes);
  // A manifest that counts none is refused, and nobody opens the file
  if (counts == decltype(counts){}) counts[0] = 1;
  for (std::size_t n = 0; n < crown_shape_count; ++n) m["canopy"][package::crown_shape_keys[n]] = counts[n];
  write_bytes(folder / package::crowns_file, bytes);
  write_sealed(folder, m.dump(1) + "\n");
}

void ask_light(const std::vector<Crown>& crowns) {
  for (const CanopyRule rule : {CanopyRule::once, CanopyRule::each, CanopyRule::beer}) {
    CanopySettings settings;
    settings.rule = rule;
    const CrownOccluder occluder(crowns, settings);
    for (const Point3f& direction : {Point3f{0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}, {-0.5F, 0.25F, 0.5F}}) {
      const CrownLight light = occluder.light({{20.0F, 20.0F, 1.5F}, direction});
      FARLOD_EXPECTS(0.0F <= light.transmitted && light.transmitted <= 1.0F && light.nearest >= 0.0F);
    }
  }
}

void ask_everything(const std::filesystem::path& folder) {
  const PackageReader package(folder);
  std::size_t count = 0;
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) {
    count += package.crowns_of(cells.cell_at(n)).size();
    ask_light(crowns_near(package, cells.cell_at(n), 10.0));
  }
  FARLOD_EXPECTS(count == package.manifest().canopy->crowns());
  FARLOD_EXPECTS(count == crowns_of_whole_city(package, cells.cell_at(0)).size());
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder scratch;
  const auto all = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(all.begin(), all.end());
  (void)mend_header<package::CrownsHeader>(bytes, package::crowns_magic, package::crowns_version);
  write_crowns(scratch.path(), bytes);
  expect_answer_or_refusal([&] { ask_everything(scratch.path()); });
  return 0;
}
