// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "contract/package/layout.hpp"
#include "contract/package/manifest_seal.hpp"
#include "package/existing_package.hpp"
#include "package/file_stamp.hpp"
#include "package/manifest_writer.hpp"
#include "package/package_files.hpp"
#include "package/same_tiles.hpp"
#include "package/tiles_writer.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

package::FileStamp stamp_from(const Json& j) {
  const auto digits = j.at("xxh3").get<std::string>();
  package::FileStamp stamp{j.at("bytes").get<std::uint64_t>(), 0};
  std::from_chars(digits.data(), digits.data() + digits.size(), stamp.xxh3, 16);
  return stamp;
}

package::BlockFiles block_from(const Json& j) {
  package::BlockFiles files{{j.at("i").get<std::int32_t>(), j.at("j").get<std::int32_t>()}, stamp_from(j.at("tiles")), {}};
  if (j.contains("cells_with_far_map")) {
    files.mapped.emplace();
    for (const Json& run : j.at("cells_with_far_map"))
      files.mapped->runs.push_back({run.at(0).get<std::uint32_t>(), run.at(1).get<std::uint32_t>()});
  }
  if (files.has_far_maps()) files.far_map = stamp_from(j.at("far_map"));
  return files;
}

/// Of a value in a message.
std::string shortened(const Json& j) {
  constexpr std::size_t longest = 60;
  const std::string text = j.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= longest ? text : text.substr(0, longest) + "…";
}

std::string name_of_key(std::string_view key) { return key == "software" ? "the program" : "\"" + std::string(key) + "\""; }

/// "the input town.gml": the first that is not the same.
std::string difference_of_inputs(const Json& there, const Json& now) {
  if (there.size() != now.size())
    return "it was made of " + std::to_string(there.size()) + " input files, and there are " + std::to_string(now.size()) +
           " now";
  for (std::size_t n = 0; n < now.size(); ++n) {
    if (there[n] == now[n]) continue;
    const auto was = there[n].value("name", ""), is = now[n].value("name", "");
    return was == is ? "the input " + is + " has changed since" : "its input was " + was + ", and is " + is + " now";
  }
  return "";
}

std::string difference(std::string_view key, const Json& there, const Json& now) {
  if (there == now) return "";
  if (key == "inputs") return difference_of_inputs(there, now);
  if (!there.is_object() || !now.is_object()) return name_of_key(key) + " was " + shortened(there) + ", and is " + shortened(now);
  for (const auto& [name, value] : now.items()) {
    const Json was = there.contains(name) ? there.at(name) : Json();
    if (was != value) return difference(std::string(key) + "." + name, was, value);
  }
  return name_of_key(key) + " was " + shortened(there) + ", and is " + shortened(now);
}

/// Whether the cells with far maps are some of the block's, in order.
bool lists_cells_of(const package::BlockFiles& files, const Grid& grid) {
  if (!files.mapped) return true;
  std::uint32_t after = 0;
  for (const package::CellRun& run : files.mapped->runs) {
    if (run.begin < after || run.end <= run.begin) return false;
    after = run.end;
  }
  return std::int64_t{after} <= grid.cells_of(files.block).size();
}

constexpr std::array keys_before_tiles{"software", "inputs", "settings", "crs", "grid"};
constexpr std::array keys_after_tiles{"frame", "counts", "problems", "canopy"};

Json value_of(const Json& manifest, const char* key) { return manifest.contains(key) ? manifest.at(key) : Json(); }

}  // namespace

struct ExistingPackage::Impl {
  fs::path folder;
  std::string text;
  Json manifest;
  std::vector<package::BlockFiles> blocks;
  std::map<Block, bool> whole;  ///< those that were read

  [[noreturn]] void refuse(const std::string& difference) const {
    throw OutputError(folder.string() + " is not the package of these inputs and options: " + difference +
                      ". Let it be replaced (--force), or choose another folder.");
  }
  void require_same(const Json& now, std::span<const char* const> keys) const {
    for (const char* key : keys) {
      const std::string what = difference(key, value_of(manifest, key), value_of(now, key));
      if (!what.empty()) refuse(what);
    }
  }
  void require_seal() const {
    const auto seal = package::ManifestSeal::of(text);
    if (!seal || stamp_of(std::as_bytes(std::span(seal->sealed))).xxh3 != seal->checksum)
      refuse("its manifest is damaged (its checksum is not that of its text)");
  }
  void read() {
    const auto version = manifest.at("version").get<std::int64_t>();
    if (version < package::oldest_format_version || version > package::newest_format_version)
      refuse("it has format version " + std::to_string(version) + ", which this program does not write");
    require_seal();
    for (const Json& b : manifest.at("blocks")) blocks.push_back(block_from(b));
  }
};

std::optional<ExistingPackage> ExistingPackage::find(const fs::path& folder) {
  std::error_code unread;
  const fs::path path = folder / package::manifest_file;
  if (!fs::is_regular_file(path, unread)) return std::nullopt;
  auto impl = std::make_unique<Impl>(Impl{folder, text_of(path), {}, {}, {}});
  try {
    impl->manifest = Json::parse(impl->text);
    impl->read();
  } catch (const nlohmann::json::exception& reason) {
    impl->refuse(std::string("its manifest is damaged (") + reason.what() + ")");
  }
  return ExistingPackage(std::move(impl));
}

ExistingPackage::ExistingPackage(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ExistingPackage::ExistingPackage(ExistingPackage&&) noexcept = default;
ExistingPackage& ExistingPackage::operator=(ExistingPackage&&) noexcept = default;
ExistingPackage::~ExistingPackage() = default;

const std::vector<package::BlockFiles>& ExistingPackage::blocks() const { return impl_->blocks; }

void ExistingPackage::require_same(const package::Manifest& manifest, Known known) const {
  const Json now = Json::parse(manifest_text(manifest));
  impl_->require_same(now, keys_before_tiles);
  if (known == Known::all) impl_->require_same(now, keys_after_tiles);
  const std::vector<Block> expected = manifest.grid.blocks();
  const auto is_block = [](const package::BlockFiles& files, Block block) { return files.block == block; };
  if (!std::ranges::equal(impl_->blocks, expected, is_block)) impl_->refuse("its manifest does not list the blocks of its grid");
  for (const package::BlockFiles& files : impl_->blocks)
    if (!lists_cells_of(files, manifest.grid)) impl_->refuse("its manifest lists cells with far maps that do not exist");
}

void ExistingPackage::require_same_tiles(const TileSet& tiles, const Grid& grid) const {
  oneapi::tbb::parallel_for(std::size_t{0}, impl_->blocks.size(), [&](std::size_t n) {
    const package::BlockFiles& files = impl_->blocks[n];
    if (const auto read = impl_->whole.find(files.block); read != impl_->whole.end() && !read->second) return;
    const fs::path path = impl_->folder / package::folder_of(files) / package::tiles_file;
    const std::string there = text_of(path);
    if (!same_tiles(std::as_bytes(std::span(there)), tiles_file_without_maps(tiles, grid, files.block)))
      impl_->refuse("the tiles in " + path.string() + " are not those of this run (is an option of the input another one?)");
  });
}

bool ExistingPackage::is_whole(const package::BlockFiles& files) const {
  const auto [entry, is_new] = impl_->whole.try_emplace(files.block, false);
  if (is_new) entry->second = are_whole(impl_->folder, files);
  return entry->second;
}

void ExistingPackage::require_unchanged() const {
  if (text_of(impl_->folder / package::manifest_file) != impl_->text) impl_->refuse("another run has changed it meanwhile");
}

}  // namespace farlod
