// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/exported_view.hpp"

#include <fstream>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "view/bundle_files.hpp"
#include "view/one_page.hpp"

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

/// Takes a file by its name.
using TakeFile = std::function<void(const std::string& name, std::string_view bytes)>;

/// Hands over all files that the page asks for; how many of them are tiles with content.
std::size_t make_files(const ViewCity& city, const TakeFile& take, const OnExportProgress& on_progress) {
  const TileTree tree = city.tree().down_to_cells();
  const std::vector<TileAddress> tiles = tiles_of(tree);
  std::size_t with_content = 0;
  take("view.json", city.description(false));
  take("tileset.json", city.tileset(tree));
  for (std::size_t n = 0; n < city.results().size(); ++n) {
    const std::string name = "results/" + std::to_string(n);
    take(name, city.results()[n].bytes());
    take(name + ".json", labels_json(city.results()[n]));
  }
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    if (tiles[n].level % levels_of_subtree == 0) take(name_of_subtree(tiles[n]), subtree_file(tree, tiles[n]));
    if (tree.has_content(tiles[n])) {
      take(name_of_tile(tiles[n]), city.tile(tiles[n]));
      ++with_content;
    }
    on_progress(n + 1, tiles.size());
  }
  return with_content;
}

OutputError too_large(const std::filesystem::path& file, std::uint64_t most_bytes) {
  return {file, "one page of this city would have more than " + std::to_string(most_bytes >> 20U) +
                    " MiB, which browsers are slow to open. Export a folder, by a name without .html, or pack a smaller --area"};
}

}  // namespace

ExportedView export_view(const ViewCity& city, const std::filesystem::path& folder, const OnExportProgress& on_progress) {
  AtomicFolder atomic(folder);
  FolderWriter files(atomic.temporary());
  for (const BundleFile& file : bundle_files()) files.write(std::string(file.name), file.bytes);
  ExportedView exported;
  exported.tiles = make_files(
      city, [&](const std::string& name, std::string_view bytes) { files.write(name, bytes); }, on_progress);
  exported.bytes = files.bytes();
  atomic.commit("tileset.json");
  return exported;
}

ExportedView export_page(const ViewCity& city, const std::filesystem::path& file, const OnExportProgress& on_progress,
                         std::uint64_t most_bytes) {
  ExportedView exported;
  write_atomically(file, [&](std::ostream& stream) {
    OnePage page(stream);
    const auto expect_room = [&] {
      if (page.bytes() > most_bytes) throw too_large(file, most_bytes);
    };
    const auto take = [&](const std::string& name, std::string_view bytes) {
      page.add(name, bytes);
      expect_room();
    };
    exported.tiles = make_files(city, take, on_progress);
    page.finish();
    expect_room();
    exported.bytes = page.bytes();
  });
  return exported;
}

void require_page_is_possible(const std::filesystem::path& file, std::uint64_t triangles) {
  // Three real cities with their ground took 170 to 390 bytes for each triangle
  constexpr std::uint64_t least_bytes_of_triangle = 40;
  if (triangles > most_bytes_of_page / least_bytes_of_triangle) throw too_large(file, most_bytes_of_page);
  if (std::filesystem::is_directory(file)) throw OutputError(file, "there is a folder of this name; choose another");
}

}  // namespace farlod
