// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/ingest.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "city/input_error.hpp"
#include "ingest/citygml_reader.hpp"
#include "ingest/cityjson_reader.hpp"
#include "ingest/footprint_reader.hpp"
#include "ingest/obj_reader.hpp"

namespace farlod {
namespace {

namespace fs = std::filesystem;

enum class Format { citygml, cityjson, obj, footprints };

std::string lower_case_name(const fs::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

Format format_of(const fs::path& file) {
  const std::string name = lower_case_name(file);
  for (const char* ending : {".gml", ".xml", ".citygml"})
    if (name.ends_with(ending)) return Format::citygml;
  for (const char* ending : {".city.json", ".cityjson", ".jsonl"})
    if (name.ends_with(ending)) return Format::cityjson;
  if (name.ends_with(".obj")) return Format::obj;
  return name.ends_with(".json") && is_cityjson(file) ? Format::cityjson : Format::footprints;
}

void require_content(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw InputError(file.string() + " does not exist. Check the path.");
  if (fs::is_directory(file, error)) return;  // some of GDAL's formats are folders
  const std::uintmax_t bytes = fs::file_size(file, error);
  if (error || !std::ifstream(file)) throw InputError(file.string() + " cannot be opened. Check its permissions.");
  if (bytes == 0) throw InputError(file.string() + " is empty: 0 bytes. Was the download cut short?");
}

/// A mesh has no place for its reference system; by custom a file beside it tells.
std::string crs_beside(fs::path file) {
  std::ifstream stream(file.replace_extension(".prj"));
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

SourceCity ingest_obj(const fs::path& file, const IngestSettings& settings, Report& report) {
  CityWriter writer(file.string(), report);
  read_obj(file, settings, writer);
  // Meshes are drawn with x to the east, whatever order of axes an authority gives to the system
  return {file.string(), {crs_beside(file), true, false}, writer.take_city()};
}

SourceCity read(const fs::path& file, const IngestSettings& settings, Report& report) {
  switch (format_of(file)) {
    case Format::citygml:
      return read_citygml(file, settings.lod, report);
    case Format::cityjson:
      return read_cityjson(file, settings.lod, report);
    case Format::obj:
      return ingest_obj(file, settings, report);
    case Format::footprints:
      break;
  }
  return read_footprints(file, settings, report);
}

}  // namespace

SourceCity ingest(const fs::path& file, const IngestSettings& settings, Report& report) {
  require_content(file);
  const std::size_t known = report.problems().size();
  SourceCity city = read(file, settings, report);
  if (city.city.buildings().empty()) {
    const auto& problems = report.problems();
    const std::string reason =
        problems.size() > known ? " The first problem: " + problems[known].place + ": " + problems[known].detail + "." : "";
    throw InputError(file.string() + " holds no usable building; " + std::to_string(problems.size() - known) +
                     " problems are in the report." + reason);
  }
  return city;
}

}  // namespace farlod
