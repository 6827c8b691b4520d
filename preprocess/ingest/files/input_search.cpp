// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/files/input_search.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/foreign_format.hpp"

namespace farlod::ingest {
namespace {

// The format is described in APPNOTE.TXT of PKWARE: the end of the central directory in 4.3.16, its entries in 4.3.12
constexpr std::size_t end_bytes = 22, longest_comment = 0xFFFF, entry_bytes = 46;
constexpr std::string_view end_mark = "PK\5\6", entry_mark = "PK\1\2";
constexpr std::uint64_t in_large_format = 0xFFFFFFFF, locked_bit = 1;
// The large format (zip64) has its own end, 4.3.14, and a pointer to it before the end, 4.3.15
constexpr std::size_t pointer_bytes = 20, large_end_bytes = 56;
constexpr std::string_view pointer_mark = "PK\6\7", large_end_mark = "PK\6\6";
/// A directory of a hundred thousand names of usual length is a tenth of this.
constexpr std::uint64_t most_directory_bytes = std::uint64_t{256} << 20;

/// A number of `count` bytes, little-endian.
std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t k = count; k-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + k]);
  return number;
}

std::string read_at(std::ifstream& stream, std::uintmax_t place, std::size_t bytes) {
  std::string text(bytes, '\0');
  stream.seekg(static_cast<std::streamoff>(place));
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  return stream ? text : std::string();
}

/// Where the central directory is.
struct DirectoryPlace {
  std::uint64_t place = 0, bytes = 0;
};

/// The place that an archive of the large format says, or else its end. `tail`: the last bytes of the archive, its end at `end`.
DirectoryPlace directory_place(std::ifstream& stream, std::string_view tail, std::size_t end) {
  const DirectoryPlace small{number_at(tail, end + 16, 4), number_at(tail, end + 12, 4)};
  if (end < pointer_bytes || !tail.substr(end - pointer_bytes).starts_with(pointer_mark)) return small;
  const std::string large = read_at(stream, number_at(tail, end - pointer_bytes + 8, 8), large_end_bytes);
  if (!large.starts_with(large_end_mark)) return small;
  return {number_at(large, 48, 8), number_at(large, 40, 8)};
}

/// The bytes of the central directory. Its declared length is checked against the file before it is read.
std::string list_of(const std::filesystem::path& archive) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(archive, error);
  std::ifstream stream(archive, std::ios::binary);
  if (error || !stream || size < end_bytes) return {};
  const std::size_t tail_bytes =
      static_cast<std::size_t>(std::min<std::uintmax_t>(size, end_bytes + longest_comment + pointer_bytes));
  const std::string tail = read_at(stream, size - tail_bytes, tail_bytes);
  const std::size_t end = tail.rfind(end_mark);
  if (end == tail.npos || end + end_bytes > tail.size()) return {};
  const auto [place, bytes] = directory_place(stream, tail, end);
  if (place == in_large_format || bytes > std::min<std::uint64_t>(size, most_directory_bytes) || place > size - bytes) return {};
  return read_at(stream, place, static_cast<std::size_t>(bytes));
}

}  // namespace

std::vector<ZipListing> zip_listings(const std::filesystem::path& archive) {
  const std::string list = list_of(archive);
  std::vector<ZipListing> listings;
  for (std::string_view rest = list; rest.size() >= entry_bytes && rest.starts_with(entry_mark);) {
    const std::size_t name_bytes = number_at(rest, 28, 2), more_bytes = number_at(rest, 30, 2) + number_at(rest, 32, 2);
    listings.push_back({printable(rest.substr(entry_bytes, name_bytes)), (number_at(rest, 8, 2) & locked_bit) != 0});
    rest.remove_prefix(std::min(rest.size(), entry_bytes + name_bytes + more_bytes));
  }
  return listings;
}

std::string printable(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, '?');
  return text;
}

bool leads_outside(std::string_view name) {
  if (name.starts_with('/') || name.starts_with('\\') || name.substr(0, 2).ends_with(':')) return true;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of("/\\"), name.size());
    if (name.substr(0, end) == "..") return true;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return false;
}

namespace {

namespace fs = std::filesystem;

/// Enough bytes to recognize an archive.
constexpr std::size_t mark_bytes = 512;

/// Companions of city files: parts of shapefiles and MapInfo tables, textures, styles, schemas, documents, files of the system.
bool is_companion(const std::string& name) {
  return ends_with_any(
      name, {".shx",  ".dbf", ".prj", ".cpg", ".qix",  ".sbn", ".sbx",  ".qmd",  ".qml", ".qpj",  ".shp.xml", ".aux.xml",
             ".lyr",  ".sld", ".mid", ".dat", ".map",  ".id",  ".ind",  ".gfs",  ".xsd", ".xsl",  ".mtl",     ".jpg",
             ".jpeg", ".png", ".bmp", ".gif", ".tga",  ".dds", ".webp", ".jgw",  ".pgw", ".tfw",  ".wld",     ".offset",
             ".txt",  ".md",  ".pdf", ".htm", ".html", ".css", ".doc",  ".docx", ".xls", ".xlsx", ".db",      ".properties"});
}

bool is_hidden(const fs::path& relative) {
  return std::any_of(relative.begin(), relative.end(), [](const fs::path& name) {
    const std::string text = name.string();
    return text == "__MACOSX" || (text.starts_with('.') && text != "." && text != "..");
  });
}

bool is_geodatabase(const fs::path& folder) { return ends_with_any(folder.filename().string(), {".gdb"}); }

/// The regular files below a folder, and the folders that are one data set, ordered by name.
std::vector<fs::path> entries_below(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code vanished;
    const bool is_folder = entry->is_directory(vanished), is_whole = is_folder && is_geodatabase(entry->path());
    if (is_whole) entry.disable_recursion_pending();
    const bool is_wanted = is_whole || (!is_folder && entry->is_regular_file(vanished));
    if (is_wanted && !is_hidden(entry->path().lexically_relative(folder))) entries.push_back(entry->path());
  }
  if (error) throw InputError(folder.string() + " cannot be searched: " + error.message() + ". Check its permissions.");
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// A file that the user did not name.
InputFile found(InputFile file) {
  file.is_named = false;
  return file;
}

/// The geodatabase that a member of an archive belongs to, which is a folder; otherwise the member itself.
InputFile whole_of(const InputFile& member) {
  fs::path inner = fs::path(member.name).lexically_relative(member.on_disk), outer = inner;
  while (!outer.empty() && !is_geodatabase(outer)) outer = outer.parent_path();
  if (outer.empty()) return member;
  fs::path path = member.path;
  for (; inner != outer; inner = inner.parent_path()) path = path.parent_path();
  return found({(member.on_disk / outer).string(), path, member.on_disk});
}

InputFile gzip_member(const fs::path& file) {
  return found({file.string(), "/vsigzip/" + fs::absolute(file).lexically_normal().string(), file});
}

InputFile readable_pipe(const fs::path& path) {
  InputFile file(path);
  file.pipe = std::make_shared<InputPipe>(path);
  const FileFormat content = format_by_content(file);
  const auto is_piped = [](const InputFormat& format) { return format.is_piped; };
  const auto is_it = [&](const InputFormat& format) { return format.format == content && format.is_piped; };
  if (names_where(is_it).empty() && !read_beginning(file, 1).empty())
    throw InputError(file.name + " is a pipe, and gives no " + names_where(is_piped, " or ") + ": write it to a file first.");
  return file;
}

/// Somebody packs what is packed already: its manifest would be taken for a wrong CityJSON, and its folder for one of no city.
void refuse_package(const fs::path& input) {
  constexpr const char* manifest = "manifest.json";
  std::error_code unread;
  const fs::path folder = input.filename() == manifest ? input.parent_path() : input;
  if (fs::is_regular_file(folder / manifest, unread) && fs::is_directory(folder / "blocks", unread))
    throw InputError((folder.empty() ? input : folder).string() +
                     " is a package already: farlod-svf computes from it. To pack again, give the files of the city.");
}

class InputSearch {
 public:
  InputSearch(Report& report, const std::optional<std::string>& layer) : report_(report), layer_(layer) {}

  FoundInputs search(std::span<const fs::path> inputs) {
    std::error_code error;
    for (const fs::path& input : inputs)
      if (!fs::exists(input, error)) throw InputError(why_unread(input));
    for (const fs::path& input : inputs) refuse_package(input);
    for (const fs::path& input : inputs) {
      rasters_.clear();
      only_by_name_.clear();
      const std::size_t known = found_.files.size();
      attempt(input, [&] { take_named(input); });
      resolve_rasters(found_.files.size() == known);
    }
    require_something(inputs);
    for (const auto& [name, reason] : unusable_) report_.add({ProblemCode::unusable_file, name, "the whole file", reason});
    return std::move(found_);
  }

 private:
  /// Collects failures. Only after all inputs have been searched is it known whether they end the run.
  template <class Work>
  void attempt(const fs::path& what, const Work& work) {
    try {
      work();
    } catch (const InputError& error) {
      unusable_.emplace_back(what.string(), error.what());
    }
  }

  void take_named(const fs::path& input) {
    if (!fs::is_directory(input)) return take_file(input, [this](const InputFile& file) { take_as_named(file); });
    if (is_geodatabase(input)) return add(input);
    const std::size_t known = found_.files.size();
    for (const fs::path& entry : entries_below(input))
      attempt(entry, [&] { take_file(entry, [this](const InputFile& file) { take_if_city(ingest::found(file)); }); });
    const bool is_empty = found_.files.size() == known && rasters_.empty();
    if (is_empty && map_kind_of(input) == MapKind::features) add(input);
  }

  /// Opens an archive and takes its members, which do not count as named by the user; hands any other file to `take`.
  template <class Take>
  void take_file(const fs::path& file, const Take& take) {
    if (fs::is_directory(file)) return add(ingest::found(file));
    if (is_pipe(file)) return add(readable_pipe(file));
    const std::string beginning = read_beginning(file, mark_bytes);
    if (is_zip(beginning) && !is_map_in_zip(file.string()))
      take_archive(file);
    else
      take(is_gzip(beginning) ? gzip_member(file) : InputFile(file));
  }

  void take_archive(const fs::path& archive) {
    locked_.clear();
    const std::vector<ZipListing> listings = zip_listings(archive);
    is_listed_ = !listings.empty();
    for (const ZipListing& listing : listings) {
      if (listing.is_locked) locked_.insert(listing.name);
      if (!leads_outside(listing.name)) continue;
      const std::string name = (archive / fs::path(listing.name).relative_path()).string();
      unusable_.emplace_back(name, name + " is not opened: its name, \"" + listing.name + "\", leads out of the archive.");
    }
    for (const InputFile& member : files_in_zip(archive)) take_member(ingest::found(member));
  }

  void take_member(const InputFile& member) {
    const fs::path inside = fs::path(member.name).lexically_relative(member.on_disk);
    const InputFile whole = whole_of(member);
    if (leads_outside(inside.generic_string()) && !is_listed_)
      unusable_.emplace_back(member.name, member.name + " is not opened: its name leads out of the archive.");
    if (is_hidden(inside) || leads_outside(inside.generic_string())) return;
    if (whole.path != member.path)
      add(whole);
    else if (!locked_.contains(inside.generic_string()))
      take_if_city(member);
    else if (!is_companion(member.unpacked_name()))
      unusable_.emplace_back(member.name, member.name + " is locked by a password: unpack it first.");
  }

  /// A GeoPackage holds features, rasters or both.
  [[nodiscard]] bool is_city_by_name(const InputFile& file) const {
    const std::string name = file.unpacked_name();
    return has_city_ending(name) && (!ends_with_any(name, {".gpkg"}) || map_kind_of(file, layer_) != MapKind::raster);
  }

  void take_as_named(const InputFile& file) {
    if (!is_city_by_name(file) && format_by_content(file, layer_) == FileFormat::raster)
      rasters_.push_back(file);
    else
      add(file);
  }

  void take_if_city(const InputFile& file) {
    const std::string name = file.unpacked_name();
    if (is_companion(name)) return;
    const bool is_xml = ends_with_any(name, {".xml"}), is_json = ends_with_any(name, {".json"});
    const bool is_empty_city = (is_xml || is_json) && read_beginning(file, 1).empty();
    if (is_city_by_name(file) || is_empty_city) return add(file);
    const FileFormat format = format_by_content(file, layer_);
    const bool is_table = format == FileFormat::features, is_none = format == FileFormat::unknown;
    if (format == FileFormat::raster)
      rasters_.push_back(file);
    else if (format == FileFormat::only_by_name)
      only_by_name_.push_back(file);
    else if (!is_none && (!is_table || is_json))
      add(file);
    else if (!is_xml && !is_json)
      skip(file);
    else
      unread_.push_back(file);
  }

  void add(const InputFile& file) {
    if (is_new(file)) found_.files.push_back(file);
  }

  bool is_new(const InputFile& file) {
    const std::string inside = file.name.substr(std::min(file.name.size(), file.on_disk.string().size()));
    // The standard input has a path, but no place on the disk
    const fs::path whole_path = file.pipe ? file.on_disk : fs::canonical(file.on_disk);
    return known_.insert(whole_path.string() + '\n' + inside).second;
  }

  void skip(const InputFile& file) {
    const std::string ending = lower_case(fs::path(file.unpacked_name()).extension().string());
    if (++found_.skipped[ending.empty() ? "files without an ending" : ending + " files"] == 1) unread_.push_back(file);
  }

  /// A raster that is alone is a surface model. Several rasters, or one beside cities, may be pictures and are skipped.
  void resolve_rasters(bool is_alone) {
    if (is_alone && rasters_.size() == 1) {
      if (is_new(rasters_.front())) found_.surface_models.push_back(rasters_.front());
    } else {
      for (const InputFile& raster : rasters_) skip(raster);
    }
    for (const InputFile& file : only_by_name_)
      if (is_alone && rasters_.empty())
        unusable_.emplace_back(file.name,
                               file.name + " is of a format that may name other files: give it by its own name, unpacked.");
      else
        skip(file);
  }

  /// Throws InputError when the only input, or a file in it, is of a format that is known, but not read.
  void refuse_foreign(const fs::path& input) const {
    std::vector<InputFile> files{InputFile(input)};
    files.insert(files.end(), unread_.begin(), unread_.end());
    for (const InputFile& file : files)
      if (const ForeignFormat* foreign = foreign_format_of(file))
        throw InputError((file.name == input.string() ? "" : input.string() + " holds no file of a city: ") +
                         refusal_of(file, *foreign));
  }

  void require_something(std::span<const fs::path> inputs) const {
    if (inputs.empty() || !found_.files.empty() || !found_.surface_models.empty()) return;
    if (!unusable_.empty()) throw InputError(unusable_.front().second);
    if (inputs.size() == 1) refuse_foreign(inputs.front());
    std::string others;
    for (const auto& [what, count] : found_.skipped)
      others += (others.empty() ? " It holds " : ", ") + std::to_string(count) + " " + what;
    throw InputError(inputs.front().string() + " holds no file of a city: no " +
                     names_where([](const InputFormat&) { return true; }, ", ") + " or footprints." + others +
                     (others.empty() ? "" : "."));
  }

  Report& report_;
  const std::optional<std::string>& layer_;
  FoundInputs found_;
  bool is_listed_ = false;                                     ///< whether the directory of the current archive could be read
  std::vector<InputFile> rasters_, only_by_name_;              ///< of the current input
  std::vector<InputFile> unread_;                              ///< the first of each ending that is no city
  std::unordered_set<std::string> known_, locked_;             ///< files taken so far; locked names of the current archive
  std::vector<std::pair<std::string, std::string>> unusable_;  ///< names and reasons
};

}  // namespace

FoundInputs find_input_files(std::span<const fs::path> inputs, Report& report, const std::optional<std::string>& layer) {
  return InputSearch(report, layer).search(inputs);
}

}  // namespace farlod::ingest
