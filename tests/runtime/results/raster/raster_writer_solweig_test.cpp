// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_solweig.hpp"

#include <gtest/gtest.h>

#include "tests/counted/held_memory.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// With shadow patches between other quantities.
RasterFrame frame_with_shadows(std::size_t edge, std::size_t threads) {
  RasterFrame frame;
  frame.columns = frame.rows = edge;
  frame.threads = threads;
  frame.bands = svf_bands("svf", RasterBands::svf);
  const std::vector<Band> further = column_descriptions_of({.directional = true, .svf_total = true, .shadow_patches = true});
  frame.bands.insert(frame.bands.end(), further.begin(), further.end());
  return frame;
}

void write_all(const RasterFrame& frame, const std::filesystem::path& path) {
  SolweigWriter writer(frame, path);
  RasterTile tile({}, RasterBands::svf, frame.bands.size() - 1);
  for (auto& band : tile.further) band.assign(band.size(), 21845.0F);
  for (tile.place.row = 0; tile.place.row < tiles_along(frame.rows); ++tile.place.row)
    for (tile.place.column = 0; tile.place.column < tiles_along(frame.columns); ++tile.place.column) writer.write(tile);
  writer.commit();
}

TEST(SolweigWriter, SaysWhatItHolds) {
  // A tile of all bands, and a copy of it without the shadows; the buffers of streams and libraries
  constexpr std::size_t tile_bytes = raster_tile_edge * raster_tile_edge * sizeof(float), beside = 1 << 20;
  constexpr std::size_t threads = 2;
  const scenes::TemporaryFolder folder;
  const RasterFrame frame = frame_with_shadows(1500, threads);
  write_all(frame_with_shadows(10, threads), folder.file("small.solweig"));  // drivers that GDAL keeps
  const HeldMemory held;
  write_all(frame, folder.file("o.solweig"));
  const std::uint64_t said = SolweigWriter::bytes_for(frame);
  EXPECT_LE(held.most_bytes(), said + 2 * frame.bands.size() * tile_bytes + beside);
  if (HeldMemory::counts_malloc) {
    EXPECT_LE(said, held.most_bytes() + held.most_bytes() / 2);
  }
}

}  // namespace
}  // namespace farlod
