// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/expects.hpp"
#include "horizon/pixel_field.hpp"
#include "package/manifest.hpp"
#include "package/pixel_heights.hpp"
#include "package/relief_tiles.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

/// Half of the files say where their pixels lie, and leave squares out.
bool knows_places(std::span<const std::byte> bytes, const package::HeightsHeader& h) {
  return (h.reserved & 1U) != 0 && bytes.size() >= sizeof(package::HeightsHeader) + sizeof(PixelsInGrid);
}

/// As many squares as the bytes of the pixels say, which are the last.
std::size_t squares_in(std::span<const std::byte> bytes) {
  const std::size_t places = sizeof(package::HeightsHeader) + sizeof(PixelsInGrid), pixels = (bytes.size() - places) / 5;
  std::size_t count = 0;
  for (const std::byte b : bytes.last(pixels)) count += (std::to_integer<std::uint8_t>(b) & PixelSquares::left_out) != 0 ? 1 : 0;
  return count;
}

/// Beside the sample's manifest, which names it, and has as many pixels as its header says.
void write_heights(const std::filesystem::path& folder, std::span<const std::byte> bytes, const package::HeightsHeader& h) {
  nlohmann::json m = open_manifest(sample_packages()[0]);
  m["pixels"] = {{"north_west_m", {0.0, 0.0}}, {"step_m", 0.5}, {"columns", h.columns}, {"rows", h.rows}};
  m["pixels"]["heights"] = entry_of_file(bytes);
  if (knows_places(bytes, h)) {
    m["version"] = package::relief_format_version;
    m["pixels"]["squares"] = squares_in(bytes);
  }
  write_bytes(folder / package::heights_file, bytes);
  write_sealed(folder, m.dump(1) + "\n");
}

void ask_everything(const std::filesystem::path& folder) {
  const PackageFolder opened(folder);
  const package::Manifest manifest = read_manifest(opened);
  const PixelHeightsFile file(opened, manifest);
  // A block of the sample, whose ground gets the squares of its cells
  const std::vector<std::byte> tiles = file_bytes(sample_packages()[0] / package::folder_of(manifest.blocks[0]) / "tiles.bin");
  const CellRange cells = manifest.grid.cells_of(manifest.blocks[0].block);
  const BlockTiles block(tiles, cells, "tiles.bin");
  for (std::size_t n = 0; file.in_grid() && n < static_cast<std::size_t>(cells.size()); ++n) {
    const ReliefTile tile = relief_tile(block.tile(cells.cell_at(n)), cells.cell_at(n), file, *manifest.pixels, manifest.grid);
    for (const Triangle& t : tile.triangles) FARLOD_EXPECTS(std::max({t.a, t.b, t.c}) < tile.vertices.size());
  }
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
  auto header = mend_header<package::HeightsHeader>(bytes, package::heights_magic, package::heights_version);
  if (knows_places(bytes, header))
    header = mend_header<package::HeightsHeader>(bytes, package::heights_magic, package::placed_heights_version);
  write_heights(scratch.path(), bytes, header);
  expect_answer_or_refusal([&] { ask_everything(scratch.path()); });
  return 0;
}
