// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "base/expects.hpp"
#include "package/far_map_reader.hpp"
#include "package/manifest.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

void read_cell(const FarMapReader& reader, const package::FarMapShape& shape, Cell cell) {
  const std::size_t pixels = std::size_t{shape.picture_columns()} * shape.picture_rows();
  if (shape.is_box()) {
    (void)reader.read_box(cell, 1.0F);
    return;
  }
  FarHorizon map{ReceiverPatches(50.0, shape.squares_per_edge, std::vector<float>(shape.layers)),
                 AzimuthBins{shape.azimuth_bins},
                 {},
                 {},
                 {},
                 {},
                 {}};
  reader.read_slopes(cell, map);
  FARLOD_EXPECTS(map.low.size() == pixels && map.estimate.size() == pixels && map.high.size() == pixels &&
                 map.overhang.size() == pixels);
}

void read_all(const std::filesystem::path& file, const package::Manifest& manifest) {
  const CellRange cells = manifest.grid.cells_of(manifest.blocks[0].block);
  expect_answer_or_refusal([&] {
    const FarMapReader reader(file, cells, manifest.far_map);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n)
      expect_answer_or_refusal([&] { read_cell(reader, manifest.far_map, cells.cell_at(n)); });
  });
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder folder;
  static const std::array manifests{read_manifest(sample_packages()[0]), read_manifest(sample_packages()[1])};
  const std::filesystem::path file = folder.write({data, size}, package::far_map_file);
  for (const package::Manifest& manifest : manifests) read_all(file, manifest);
  return 0;
}
