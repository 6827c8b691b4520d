// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "horizon/pixel_field.hpp"
#include "package/manifest.hpp"
#include "package/pixel_heights.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

/// Beside the sample's manifest, which names it, and has as many pixels as its header says.
void write_heights(const std::filesystem::path& folder, std::span<const std::byte> bytes, const package::HeightsHeader& h) {
  nlohmann::json m = open_manifest(sample_packages()[0]);
  m["pixels"] = {{"north_west_m", {0.0, 0.0}}, {"step_m", 0.5}, {"columns", h.columns}, {"rows", h.rows}};
  m["pixels"]["heights"] = entry_of_file(bytes);
  write_bytes(folder / package::heights_file, bytes);
  write_sealed(folder, m.dump(1) + "\n");
}

void ask_everything(const std::filesystem::path& folder) {
  const PackageFolder opened(folder);
  const package::Manifest manifest = read_manifest(opened);
  const PixelHeightsFile file(opened, manifest);
  const PixelField field(*manifest.pixels, file.height_m(), file.joined());
  for (std::int32_t row = 0; row < static_cast<std::int32_t>(manifest.pixels->rows); ++row)
    for (std::int32_t column = 0; column < static_cast<std::int32_t>(manifest.pixels->columns); ++column)
      for (const double height_m : middle_of(field.four_from(column, row)).middle_height_m)
        FARLOD_EXPECTS(std::abs(height_m) <= static_cast<double>(package::farthest_in_tile_m));
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder scratch;
  const auto all = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(all.begin(), all.end());
  const auto header = mend_header<package::HeightsHeader>(bytes, package::heights_magic, package::heights_version);
  write_heights(scratch.path(), bytes, header);
  expect_answer_or_refusal([&] { ask_everything(scratch.path()); });
  return 0;
}
