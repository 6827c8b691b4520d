// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "farlod/city_sources.hpp"
#include "package/manifest.hpp"
#include "package/sources_layout.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

constexpr std::uint64_t most_buildings = 1000;

/// Makes the header what no reader refuses, as far as it does not depend on the rest. Returns the number of buildings.
std::uint64_t mend_sources(std::span<std::byte> bytes) {
  auto header = mend_header<package::SourcesHeader>(bytes, package::sources_magic, package::sources_version);
  header.building_count %= most_buildings;
  if (bytes.size() >= sizeof header) std::memcpy(bytes.data(), &header, sizeof header);
  return header.building_count;
}

/// Beside the sample's manifest, which names these sources, and two inputs.
void write_sources(const std::filesystem::path& folder, std::span<const std::byte> bytes, std::uint64_t buildings) {
  nlohmann::json m = open_manifest(sample_packages()[0]);
  m["version"] = package::format_version;
  m["counts"]["buildings"] = buildings;
  m["inputs"] = {{{"name", "a.gml"}, {"bytes", 300}, {"xxh3", "1"}}, {{"name", "b.city.json"}, {"bytes", 70'000}, {"xxh3", "2"}}};
  m["sources"] = entry_of_file(bytes);
  write_bytes(folder / package::sources_file, bytes);
  write_sealed(folder, m.dump(1) + "\n");
}

void ask_everything(const std::filesystem::path& folder) {
  const Package package(folder);
  const std::vector<PackedCityFile> files = city_files_of(package);
  visit_origins(package, [&](std::uint32_t, std::size_t file, const BuildingOrigin& origin) {
    FARLOD_EXPECTS(file < files.size() && !origin.objects.empty());
    for (const auto* places : {&origin.objects, &origin.semantics})
      for (const AttributePlace& place : *places)
        FARLOD_EXPECTS(place.at <= files[file].input.bytes && place.form <= files[file].forms.size());
    for (const SurfaceOrigin& surface : origin.surfaces)
      FARLOD_EXPECTS(surface.object < origin.objects.size() &&
                     (!surface.semantics || *surface.semantics < origin.semantics.size()));
  });
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder scratch;
  const auto all = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(all.begin(), all.end());
  const std::uint64_t buildings = mend_sources(bytes);
  write_sources(scratch.path(), bytes, buildings);
  expect_answer_or_refusal([&] { ask_everything(scratch.path()); });
  return 0;
}
