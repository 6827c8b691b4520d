// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/exported_view.hpp"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "view/bundle_files.hpp"

namespace farlod {
namespace {

/// Writes below a folder, and counts.
class FolderWriter {
 public:
  explicit FolderWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = folder_ / name;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw OutputError(path, "it cannot be written");
    bytes_ += bytes.size();
  }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path folder_;
  std::uint64_t bytes_ = 0;
};

/// The tiles of all levels down to whole cells, level by level.
std::vector<TileAddress> tiles_of(const TileTree& tree) {
  std::vector<TileAddress> tiles;
  for (std::uint32_t level = 0; level <= tree.level_of_cells(); ++level)
    for (std::uint32_t y = 0; y < 1U << level; ++y)
      for (std::uint32_t x = 0; x < 1U << level; ++x)
        if (tree.contains({level, x, y})) tiles.push_back({level, x, y});
  return tiles;
}

std::string name_of_tile(const TileAddress& t) {
  return "tiles/" + std::to_string(t.level) + "/" + std::to_string(t.x) + "/" + std::to_string(t.y) + ".glb";
}

std::string name_of_subtree(const TileAddress& t) {
  return "subtrees/" + std::to_string(t.level) + "." + std::to_string(t.x) + "." + std::to_string(t.y) + ".subtree";
}

}  // namespace

ExportedView export_view(const ViewCity& city, const std::filesystem::path& folder,
                         const std::function<void(std::size_t done, std::size_t all)>& on_progress) {
  AtomicFolder atomic(folder);
  FolderWriter files(atomic.temporary());
  const TileTree tree = city.tree().down_to_cells();
  const std::vector<TileAddress> tiles = tiles_of(tree);
  ExportedView exported;
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    if (tree.has_content(tiles[n])) {
      files.write(name_of_tile(tiles[n]), city.tile(tiles[n]));
      ++exported.tiles;
    }
    if (tiles[n].level % levels_of_subtree == 0) files.write(name_of_subtree(tiles[n]), subtree_file(tree, tiles[n]));
    on_progress(n + 1, tiles.size());
  }
  for (const BundleFile& file : bundle_files()) files.write(std::string(file.name), file.bytes);
  for (std::size_t n = 0; n < city.results().size(); ++n) {
    const ResultLayer& layer = city.results()[n];
    const std::string name = "results/" + std::to_string(n);
    files.write(name, layer.bytes());
    files.write(name + ".json", labels_json(layer));
  }
  files.write("view.json", city.description(false));
  files.write("tileset.json", city.tileset(tree));
  exported.bytes = files.bytes();
  atomic.commit("tileset.json");
  return exported;
}

}  // namespace farlod
