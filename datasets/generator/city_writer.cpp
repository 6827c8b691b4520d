// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>
#include <utility>

#include "farlod/error.hpp"
#include "generator/city_layout.hpp"

namespace farlod {

std::optional<CityFormat> generated_format_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".gml") return CityFormat::citygml;
  if (ending == ".json") return CityFormat::cityjson;
  if (ending == ".obj") return CityFormat::obj;
  if (ending == ".geojson") return CityFormat::geojson;
  return std::nullopt;
}

namespace {

/// The name of the file without its endings and without characters that XML, JSON or OBJ would have to escape.
[[nodiscard]] std::string plain_name(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  name.resize(std::min(name.size(), name.find('.', 1)));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
    if (!plain) c = '_';
  }
  return name;
}

}  // namespace

CityHeader header_of(const CitySettings& settings, const std::filesystem::path& path) {
  CityHeader header{.name = plain_name(path), .lod = written_lod(settings), .epsg = settings.epsg};
  header.centre_easting_mm = millimetres(settings.centre_easting_m);
  header.centre_northing_mm = millimetres(settings.centre_northing_m);
  return header;
}

std::unique_ptr<GeneratedCityWriter> make_city_writer(CityFormat format, const std::filesystem::path& path,
                                                      const CityHeader& header) {
  switch (format) {
    case CityFormat::citygml:
      return make_citygml_writer(path, header);
    case CityFormat::cityjson:
      return make_cityjson_writer(path, header);
    case CityFormat::obj:
      return make_obj_writer(path, header);
    case CityFormat::geojson:
      break;
  }
  return make_geojson_writer(path, header);
}

namespace {

OutputError refused_by_disk(const std::filesystem::path& path, const std::string& reason) {
  return {path, reason + ". Is the folder there, may you write to it, and is there room on the disk?"};
}

}  // namespace

CityTextFile::CityTextFile(std::filesystem::path destination) : destination_(std::move(destination)) {
  errno = 0;
  std::error_code unknown;
  if (std::filesystem::is_fifo(destination_, unknown)) {
    file_.open(destination_, std::ios::binary | std::ios::out);
  } else {
    // The process id separates two runs that write the same file
    temporary_ = destination_.parent_path() / fmt::format(".{}.{}.partial", destination_.filename().string(), getpid());
    file_.open(temporary_, std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc);
  }
  if (!file_) fail();
  buffer_.reserve(buffer_bytes + buffer_bytes / 4);
}

CityTextFile::~CityTextFile() {
  std::error_code nothing_to_remove;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, nothing_to_remove);
}

void CityTextFile::overwrite(std::uint64_t position, std::string_view text) {
  flush();
  file_.seekp(static_cast<std::streamoff>(position));
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
  file_.seekp(0, std::ios::end);
  if (!file_) fail();
}

void CityTextFile::append(CityTextFile& other) {
  other.flush();
  other.file_.seekg(0);
  std::string piece(buffer_bytes, '\0');
  while (other.file_.read(piece.data(), static_cast<std::streamsize>(piece.size())) || other.file_.gcount() > 0) {
    buffer_.append(piece, 0, static_cast<std::size_t>(other.file_.gcount()));
    flush();
  }
}

std::uint64_t CityTextFile::commit() {
  const std::uint64_t bytes = position();
  flush();
  file_.close();
  if (!file_) fail();
  if (temporary_.empty()) return bytes;
  std::error_code error;
  std::filesystem::rename(temporary_, destination_, error);
  if (error) throw refused_by_disk(destination_, error.message());
  return bytes;
}

void CityTextFile::flush() {
  errno = 0;
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.flush();
  if (!file_) fail();
  flushed_bytes_ += buffer_.size();
  buffer_.clear();
}

void CityTextFile::fail() const {
  // The stream has no reason of its failure; the last error of the system has
  throw refused_by_disk(destination_, errno != 0 ? std::generic_category().message(errno) : "the disk refused the data");
}

void append_metres(std::string& text, std::int64_t value_mm) {
  const std::int64_t size_mm = value_mm < 0 ? -value_mm : value_mm;
  if (value_mm < 0) text += '-';
  fmt::format_to(std::back_inserter(text), FMT_STRING("{}.{:03}"), size_mm / 1000, size_mm % 1000);
}

}  // namespace farlod
