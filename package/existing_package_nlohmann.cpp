// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "package/existing_package.hpp"
#include "package/file_stamp.hpp"
#include "package/layout.hpp"
#include "package/package_folder.hpp"
#include "package/tiles_writer.hpp"

namespace farlod {
namespace {

using namespace package;

using Bytes = std::span<const std::byte>;

template <class T>
T element(Bytes bytes, std::size_t n) {
  T value;
  std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
  return value;
}

/// The sections of a file; nothing where it is none, or is cut off.
std::optional<std::vector<Section>> sections_of(Bytes file) {
  if (file.size() < sizeof(Header)) return std::nullopt;
  const auto header = element<Header>(file, 0);
  const Bytes rest = file.subspan(sizeof(Header));
  if (header.magic != magic || header.section_count > rest.size() / sizeof(Section)) return std::nullopt;
  std::vector<Section> sections;
  for (std::size_t n = 0; n < header.section_count; ++n) {
    sections.push_back(element<Section>(rest, n));
    const Section& s = sections.back();
    const bool fits = s.offset <= file.size() && s.element_bytes > 0 && s.count <= (file.size() - s.offset) / s.element_bytes;
    if (!fits) return std::nullopt;
  }
  return sections;
}

Bytes bytes_of(Bytes file, const Section& s) { return file.subspan(s.offset, s.count * s.element_bytes); }

bool is_of_far_maps(SectionKind kind) {
  return kind == SectionKind::far_cells || kind == SectionKind::far_edges || kind == SectionKind::explicit_edges;
}

CellRecord without_map(CellRecord cell) {
  cell.capture_x_m = cell.capture_y_m = cell.capture_z_m = cell.far_map_top = 0.0F;
  return cell;
}

/// Both have as many bytes.
bool same_cells(Bytes a, Bytes b) {
  for (std::size_t n = 0; n < a.size() / sizeof(CellRecord); ++n) {
    const CellRecord in_a = without_map(element<CellRecord>(a, n)), in_b = without_map(element<CellRecord>(b, n));
    // Bits are to be the same, of floats too. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c)
    if (std::memcmp(&in_a, &in_b, sizeof(CellRecord)) != 0) return false;
  }
  return true;
}

bool same_section(Bytes a, Bytes b, SectionKind kind) {
  if (a.size() != b.size()) return false;
  return kind == SectionKind::cells ? same_cells(a, b) : std::ranges::equal(a, b);
}

}  // namespace

bool same_tiles(Bytes file, Bytes file_without_maps) {
  const auto sections = sections_of(file), expected = sections_of(file_without_maps);
  if (!sections || !expected || sections->size() != expected->size()) return false;
  if (element<Header>(file, 0).version != element<Header>(file_without_maps, 0).version) return false;
  for (std::size_t n = 0; n < sections->size(); ++n) {
    const Section &a = (*sections)[n], &b = (*expected)[n];
    if (a.kind != b.kind || a.element_bytes != b.element_bytes) return false;
    if (is_of_far_maps(a.kind)) continue;
    if (!same_section(bytes_of(file, a), bytes_of(file_without_maps, b), a.kind)) return false;
  }
  return true;
}

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
constexpr std::array keys_after_tiles{"frame", "counts", "problems", "pixels", "canopy", "far_terrain"};

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
