// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/sources_file.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#include "base/durable_file.hpp"
#include "farlod/error.hpp"
#include "package/file_stamp.hpp"
#include "package/package_folder.hpp"

namespace farlod {
namespace {

using Files = std::span<const std::optional<SourceOfPackage>>;

void append_text(std::vector<std::uint8_t>& bytes, const std::string& text) {
  package::append_number(bytes, text.size());
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void append_file(std::vector<std::uint8_t>& bytes, const SourceOfPackage& file) {
  package::append_number(bytes, file.input);
  package::append_number(bytes, static_cast<std::uint64_t>(file.format));
  package::append_number(bytes, file.forms.size());
  for (const package::AttributeForm& form : file.forms)
    for (const std::string* text :
         {&form.before_all, &form.before_name, &form.before_value, &form.behind_value, &form.between, &form.behind_all})
      append_text(bytes, *text);
}

/// Writes the bytes that gather, some at a time.
class Gathered {
 public:
  explicit Gathered(std::ofstream& file) : file_(file) {}
  [[nodiscard]] std::vector<std::uint8_t>& bytes() { return bytes_; }
  void write_if_many() {
    constexpr std::size_t many = std::size_t{1} << 20;
    if (bytes_.size() >= many) write();
  }
  void write() {
    file_.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    written_ += bytes_.size();
    bytes_.clear();
  }
  [[nodiscard]] std::uint64_t written() const { return written_; }

 private:
  std::ofstream& file_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t written_ = 0;
};

/// Whether a building has surfaces with ids.
bool any_ids(const TileSources& sources) {
  std::uint64_t begin = 0;
  for (const TileSources::OfBuilding& building : sources.buildings) {
    const auto origin = package::origin_from(std::span(sources.origins.data() + begin, building.bytes));
    if (origin && !origin->ids.empty()) return true;
    begin += building.bytes;
  }
  return false;
}

/// Returns the number of bytes.
std::uint64_t write_contents(std::ofstream& file, const TileSources& sources, Files files, bool with_ids) {
  Gathered gathered(file);
  std::vector<std::uint64_t> numbers(files.size());  // counted from 1 among those with places
  std::uint64_t with_places = 0;
  for (std::size_t n = 0; n < files.size(); ++n) {
    if (!files[n]) continue;
    numbers[n] = ++with_places;
    append_file(gathered.bytes(), *files[n]);
  }
  std::uint64_t begin = 0;
  for (const TileSources::OfBuilding& building : sources.buildings) {
    const bool has_places = building.bytes > 0 && building.source < files.size() && files[building.source];
    package::append_number(gathered.bytes(), has_places ? numbers[building.source] : 0);
    const std::span<const std::uint8_t> origin(sources.origins.data() + begin, building.bytes);
    begin += building.bytes;
    if (!has_places && !with_ids) continue;
    package::append_number(gathered.bytes(), origin.size());
    gathered.bytes().insert(gathered.bytes().end(), origin.begin(), origin.end());
    gathered.write_if_many();
  }
  gathered.write();
  return gathered.written();
}

void write(const std::filesystem::path& path, const TileSources& sources, Files files, bool with_ids) {
  std::ofstream file(path, std::ios::binary);
  package::SourcesHeader header{};
  header.magic = package::sources_magic;
  header.version = with_ids ? package::sources_version_with_ids : package::sources_version;
  header.file_count = static_cast<std::uint32_t>(std::ranges::count_if(files, [](const auto& f) { return f.has_value(); }));
  header.building_count = sources.buildings.size();
  const auto put_header = [&] { file.write(reinterpret_cast<const char*>(&header), sizeof(header)); };
  put_header();
  header.file_bytes = sizeof(header) + write_contents(file, sources, files, with_ids);
  file.seekp(0);
  put_header();
  file.close();
  if (!file) throw OutputError(path.string() + " cannot be written. Is the disk full?");
}

}  // namespace

std::optional<package::FileStamp> write_sources(const std::filesystem::path& folder, const TileSources& sources, Files files) {
  const bool with_ids = any_ids(sources);
  if (!with_ids && std::ranges::none_of(files, [](const auto& file) { return file.has_value(); })) return std::nullopt;
  make_folder(folder);
  package::FileStamp stamp;
  write_durably(folder / package::sources_file, [&](const std::filesystem::path& part) {
    write(part, sources, files, with_ids);
    stamp = stamp_of(part);
  });
  return stamp;
}

}  // namespace farlod
