// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/exported_view.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "base/expects.hpp"
#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "view/bundle_files.hpp"

namespace farlod {
namespace {

constexpr int compression_level = 6;  // of tiles, 9 saves nothing, and takes ten times as long
constexpr int gzip_window_bits = 15 + 16, memory_level = 8;

/// The bytes as a file of gzip, without a name and a time: the same bytes give the same file.
std::string gzipped(std::string_view bytes) {
  FARLOD_EXPECTS(bytes.size() < std::numeric_limits<uInt>::max() / 2);
  z_stream stream{};
  if (deflateInit2(&stream, compression_level, Z_DEFLATED, gzip_window_bits, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string file(deflateBound(&stream, bytes.size()), '\0');
  // zlib only reads there
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(file.data());
  stream.avail_out = static_cast<uInt>(file.size());
  const int ended = deflate(&stream, Z_FINISH);
  file.resize(stream.total_out);
  deflateEnd(&stream);
  FARLOD_EXPECTS(ended == Z_STREAM_END);
  return file;
}

/// What the server says in a header. Nothing may be loaded but what lies in the page.
constexpr std::string_view policy =
    "  <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; img-src blob: data:; connect-src blob: data:; worker-src blob:; base-uri 'none'; form-action 'none'\">\n";

std::string_view bytes_of(std::string_view name) {
  const auto files = bundle_files();
  const auto found = std::ranges::find(files, name, &BundleFile::name);
  FARLOD_EXPECTS(found != files.end());
  return found->bytes;
}

/// Between tags. The text must not end the element: viewer/build.mjs sees to it.
std::string element(std::string_view begin, std::string_view text, std::string_view end) {
  FARLOD_EXPECTS(text.find(end) == std::string_view::npos);
  return std::string(begin).append("\n").append(text).append(end).append("\n");
}

/// index.html up to the place of the files, and from there on.
struct PageText {
  std::string before, after;
};

PageText page_text() {
  PageText text;
  std::string_view rest = bytes_of("index.html");
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest.remove_prefix(line.size());
    const auto has = [&](std::string_view words) { return line.find(words) != std::string_view::npos; };
    if (has("rel=\"stylesheet\"")) {
      text.before.append(policy).append(element("<style>", bytes_of("viewer.css"), "</style>"));
    } else if (has("src=\"viewer.js\"")) {
      text.before += element("<script type=\"text/plain\" id=\"licences\">", bytes_of("licences.txt"), "</script>");
      text.after = element("<script type=\"module\">", bytes_of("viewer.js"), "</script>");
    } else if (!has("rel=\"preload\"")) {
      (text.after.empty() ? text.before : text.after) += line;
    }
  }
  FARLOD_EXPECTS(text.before.find("<style>") != std::string::npos && !text.after.empty());
  return text;
}

std::string in_base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const auto byte = [&](std::size_t k) { return n + k < bytes.size() ? static_cast<unsigned char>(bytes[n + k]) : 0U; };
    const unsigned int three = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (const unsigned int shift : {18U, 12U, 6U, 0U}) text.push_back(digits[three >> shift & 63U]);
  }
  std::fill_n(text.rbegin(), (3 - bytes.size() % 3) % 3, '=');
  return text;
}

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
  if (city.has_crowns()) take("crowns", city.crowns());
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

OnePage::OnePage(std::ostream& stream) : stream_(stream) {
  PageText text = page_text();
  write(text.before);
  rest_ = std::move(text.after);
}

void OnePage::add(const std::string& name, std::string_view bytes) {
  write("<script type=\"text/plain\" data-file=\"" + name + "\">" + in_base64(gzipped(bytes)) + "</script>\n");
}

void OnePage::finish() { write(rest_); }

void OnePage::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  bytes_ += text.size();
}

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
