// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/package_reader.hpp"

namespace farlod {

BlockCheck::BlockCheck(const PackageFolder& folder, const package::Manifest& manifest, std::size_t n)
    : manifest_(manifest),
      files_(manifest.blocks[n]),
      cells_(manifest.grid.cells_of(files_.block)),
      folder_(folder),
      tiles_name_(std::filesystem::path(package::folder_of(files_)) / package::tiles_file),
      far_map_name_(std::filesystem::path(package::folder_of(files_)) / package::far_map_file),
      tiles_file_(folder.file(tiles_name_)),
      far_map_file_(folder.file(far_map_name_)) {
  open_tiles();
  if (files_.has_far_maps()) open_far_maps();
}

template <class Work>
bool BlockCheck::succeeds(const PackageFile& file, const Work& work) {
  try {
    work();
    return true;
  } catch (const PackageDamaged& error) {
    damage_.push_back({file.name, std::nullopt, error.what()});
  } catch (const PackageUnusable& error) {
    // A version that is not the manifest's
    damage_.push_back({file.name, std::nullopt, error.what()});
  }
  return false;
}

void BlockCheck::open_tiles() {
  const bool is_mapped = succeeds(tiles_file_, [&] {
    (void)folder_.plain_file(tiles_name_);
    tiles_bytes_.emplace(tiles_file_);
  });
  if (!is_mapped) return;
  succeeds(tiles_file_, [&] {
    check_stamp(tiles_file_, tiles_bytes_->bytes(), files_.tiles);
    tiles_.emplace(tiles_bytes_->bytes(), cells_, tiles_file_.name);
    if (files_.has_far_maps() && !manifest_.far_map.is_box() && !tiles_->has_far_cells())
      throw PackageDamaged(tiles_file_.name + " is damaged: it does not name what its far maps need. Pack the city again.");
  });
}

void BlockCheck::open_far_maps() {
  std::optional<std::uint64_t> bytes;
  succeeds(far_map_file_, [&] {
    (void)folder_.plain_file(far_map_name_);
    const MappedFile file(far_map_file_);
    bytes = file.bytes().size();
    check_stamp(far_map_file_, file.bytes(), files_.far_map);
  });
  // The maps of a file that was altered tell which cells are concerned; of one that was cut there is nothing more to say
  if (bytes != files_.far_map.bytes) return;
  if (!succeeds(far_map_file_, [&] { far_maps_.emplace(far_map_file_, cells_, manifest_.far_map, files_.mapped); })) return;
  for (std::size_t place = 0; place < static_cast<std::size_t>(cells_.size()); ++place)
    if (files_.has_far_map(place)) mapped_cells_.push_back(cells_.cell_at(place));
}

std::optional<std::uint64_t> BlockCheck::triangles() const {
  if (!tiles_) return std::nullopt;
  std::uint64_t count = 0;
  for (std::size_t place = 0; place < static_cast<std::size_t>(cells_.size()); ++place)
    count += tiles_->tile(cells_.cell_at(place)).mesh.triangles.size();
  return count;
}

std::optional<BlockDamage> BlockCheck::check_far_map(Cell cell) const {
  try {
    read_far_map(cell);
    return std::nullopt;
  } catch (const PackageDamaged& error) {
    return BlockDamage{far_map_file_.name, cell, error.what()};
  }
}

/// What the map is measured by comes from the tiles; where these are damaged, any will do.
void BlockCheck::read_far_map(Cell cell) const {
  const package::FarMapShape& shape = manifest_.far_map;
  if (shape.is_box()) {
    (void)far_maps_->read_box(cell, tiles_ ? tiles_->tile(cell).cell->far_map_top : 1.0F);
    return;
  }
  const bool has_levels = tiles_ && tiles_->has_far_cells();
  FarHorizon map{ReceiverPatches(manifest_.grid.cell_edge_m, shape.squares_per_edge,
                                 has_levels ? tiles_->levels_m(cell, shape.layers) : std::vector<float>(shape.layers)),
                 AzimuthBins{shape.azimuth_bins},
                 {},
                 {},
                 {},
                 {},
                 {}};
  far_maps_->read_slopes(cell, map);
}

}  // namespace farlod
