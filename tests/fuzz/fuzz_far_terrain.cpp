// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "package/far_terrain.hpp"
#include "package/manifest.hpp"
#include "scene/ray_scenes.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

/// Beside the sample's manifest, which names it.
void write_far_terrain(const std::filesystem::path& folder, std::span<const std::byte> bytes) {
  nlohmann::json m = open_manifest(sample_packages()[0]);
  m["version"] = package::far_terrain_format_version;
  m["far_terrain"] = entry_of_file(bytes);
  write_bytes(folder / package::far_terrain_file, bytes);
  write_sealed(folder, m.dump(1) + "\n");
}

void ask_everything(const std::filesystem::path& folder) {
  const PackageFolder opened(folder);
  const FarTerrainFile file(opened, read_manifest(opened));
  const MeshView mesh = file.mesh();
  for (const Triangle& t : mesh.triangles) FARLOD_EXPECTS(std::max({t.a, t.b, t.c}) < mesh.vertices.size());
  const std::vector<PlacedMesh> placed{{mesh, {}}};
  const Occluder occluder = occluder_of(placed);
  (void)occluder.nearest({{0.0F, 0.0F, 0.0F}, {1.0F, 0.5F, 0.25F}});
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder scratch;
  const auto all = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(all.begin(), all.end());
  (void)mend_header<package::FarTerrainHeader>(bytes, package::far_terrain_magic, package::far_terrain_version);
  write_far_terrain(scratch.path(), bytes);
  expect_answer_or_refusal([&] { ask_everything(scratch.path()); });
  return 0;
}
