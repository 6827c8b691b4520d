// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "farlod/error.hpp"
#include "package/existing_package.hpp"
#include "package/layout.hpp"
#include "package/manifest_reader.hpp"
#include "package/manifest_writer.hpp"
#include "package/package_files.hpp"
#include "package/same_tiles.hpp"
#include "package/tiles_writer.hpp"
#include "package/written_stamp.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The text of a value in a message.
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

constexpr std::array keys_before_tiles{"software", "inputs", "settings", "crs", "grid"};
constexpr std::array keys_after_tiles{"frame", "counts", "problems", "canopy"};

Json value_of(const Json& manifest, const char* key) { return manifest.contains(key) ? manifest.at(key) : Json(); }

}  // namespace

struct ExistingPackage::Impl {
  fs::path folder;
  std::string text;
  Json manifest;                            ///< to be compared with another one, value by value
  std::vector<package::BlockFiles> blocks;  ///< as the runtime reads them
  std::map<Block, bool> whole;              ///< those that were read

  [[noreturn]] void refuse(const std::string& difference) const {
    throw OutputError(folder.string() + " is not the package of these inputs and options: " + difference +
                      ". Let it be replaced (--force), or choose another folder.");
  }
  [[noreturn]] void refuse_unread(const Error& reason) const {
    throw OutputError("cannot go on with " + folder.string() + ": " + reason.what() +
                      " Let it be replaced (--force), or choose another folder.");
  }
  void require_same(const Json& now, std::span<const char* const> keys) const {
    for (const char* key : keys) {
      const std::string what = difference(key, value_of(manifest, key), value_of(now, key));
      if (!what.empty()) refuse(what);
    }
  }
  /// The reader of the runtime decides what a manifest is, so that no number means another thing here.
  void read() {
    try {
      blocks = manifest_from_text(text, (folder / package::manifest_file).string()).blocks;
    } catch (const PackageUnusable& reason) {
      refuse_unread(reason);
    } catch (const PackageDamaged& reason) {
      refuse_unread(reason);
    }
    manifest = Json::parse(text);
  }
};

std::optional<ExistingPackage> ExistingPackage::find(const fs::path& folder) {
  std::error_code unread;
  const fs::path path = folder / package::manifest_file;
  if (!fs::is_regular_file(path, unread)) return std::nullopt;
  auto impl = std::make_unique<Impl>(Impl{folder, text_of(path), {}, {}, {}});
  impl->read();
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
