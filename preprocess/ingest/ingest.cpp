// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/ingest.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "base/cancellation.hpp"
#include "base/unread_file.hpp"
#include "farlod/error.hpp"
#include "ingest/citygml/citygml_reader.hpp"
#include "ingest/cityjson/cityjson_reader.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/files/foreign_format.hpp"
#include "ingest/footprints/footprint_reader.hpp"
#include "ingest/mesh/mesh_buildings.hpp"
#include "ingest/mesh/mesh_classes.hpp"
#include "ingest/mesh/mesh_placement.hpp"
#include "ingest/mesh/mesh_scanners.hpp"
#include "ingest/obj/obj_scanner.hpp"
#include "ingest/palm/palm_driver_reader.hpp"

namespace farlod::ingest {
namespace {

namespace fs = std::filesystem;

/// Each takes the memory that its reader needs besides the city, which for JSON is much.
constexpr std::size_t most_files_at_once = 4;

bool is_folder(const InputFile& file) {
  std::error_code error;
  return !file.is_packed() && fs::is_directory(file.path, error);
}

/// A folder is never empty: some formats of GDAL are folders.
bool is_empty(const InputFile& file) {
  if (file.declared_bytes) return *file.declared_bytes == 0;
  return !is_folder(file) && read_beginning(file, 1).empty();
}

void require_content(const InputFile& file) {
  std::error_code error;
  if (!fs::exists(file.on_disk, error)) throw InputError(why_unread(file.on_disk));
  if (is_empty(file)) throw InputError(file.name + " is empty: 0 bytes. Was the download cut short?");
}

bool has_reader(FileFormat format) {
  if (format == FileFormat::palm_driver) return true;  // it has no ending of its own
  const std::span<const InputFormat> formats = input_formats();
  return std::any_of(formats.begin(), formats.end(),
                     [&](const InputFormat& known) { return known.format == format && known.is_this != nullptr; });
}

FileFormat format_of(const InputFile& file, Report& report) {
  const FileFormat format = format_by_content(file);
  if (const ForeignFormat* foreign = has_reader(format) ? nullptr : foreign_format_of(file))
    throw InputError(refusal_of(file, *foreign));
  if (format == FileFormat::unknown) return format_by_name(file);
  const std::string name = file.unpacked_name();
  if (!name_allows(name, format))
    report.add({ProblemCode::another_format, file.name, "the whole file",
                "it is named " + name + ", but is " + std::string(name_of(format)) + ", and is read as that"});
  return format;
}

std::string text_of(const std::map<std::string, std::uint64_t>& ground_faces) {
  std::string text;
  for (const auto& [name, count] : ground_faces) text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " + name;
  return text;
}

SourceCity ingest_mesh(const Mesh& mesh, const InputFile& file, const IngestSettings& settings, Report& report,
                       const std::stop_token& stop) {
  if (mesh.faces.empty())
    throw InputError(file.name + " holds " + std::to_string(mesh.vertices.size()) +
                     " vertices and no face: it is no mesh, or it is a point cloud. Export it as a polygon mesh.");
  const MeshPlacement placement = find_mesh_placement(file);
  const Point3d origin = settings.obj_origin ? *settings.obj_origin : placement.origin.value_or(Point3d{});
  CityModelBuilder builder(file.name, report);
  MeshRest rest =
      add_buildings(mesh, {mesh.origin + origin, settings.up.value_or(mesh.up)}, settings.ground_names, builder, stop);
  std::vector<std::string> notes = notes_of(placement, file, settings.obj_origin.has_value());
  if (!rest.ground_faces.empty())
    notes.push_back(file.name + ": faces that are ground by their names: " + text_of(rest.ground_faces));
  if (!rest.sheet_faces.empty())
    notes.push_back(file.name +
                    ": faces that are ground, since they lie below buildings and have no walls: " + text_of(rest.sheet_faces));
  // Meshes have x to the east, whatever the order of axes in the definition of the CRS
  return {.source = file.name,
          .crs = {placement.crs, true, false},
          .city = builder.take_city(),
          .relief_points = std::move(rest.relief_points),
          .skipped = std::move(rest.skipped),
          .notes = std::move(notes),
          .met_ground_names = met_names(mesh, settings.ground_names)};
}

/// Throws InputError for an archive that unpacks to too much. GDAL, which reads the file next, has no such limit.
void require_city_size(const InputFile& file) {
  if (!file.is_packed()) return;
  const std::unique_ptr<std::istream> stream = open_input(file);
  while (stream->ignore(std::streamsize{1} << 20))
    if (stream->eof()) break;
}

/// Throws InputError for what is no city by itself.
void require_readable(const InputFile& file, FileFormat format) {
  if (format == FileFormat::archive)
    throw InputError(file.name + " is an archive within an archive, or of a kind that is not opened: unpack it first.");
  if (format == FileFormat::raster) throw InputError(file.name + " is a raster among other files: give it with --terrain.");
  if (format == FileFormat::only_by_name)
    throw InputError(file.name + " is of a format that may name other files: give it by its own name, unpacked.");
}

SourceCity read_as(FileFormat format, const InputFile& file, const IngestSettings& settings, Report& report,
                   const std::stop_token& stop) {
  switch (format) {
    case FileFormat::citygml:
      return read_citygml(file, settings.lod, report, stop);
    case FileFormat::cityjson:
      return read_cityjson(file, settings.lod, report);
    case FileFormat::obj:
      return ingest_mesh(scan_obj(*open_input(file), stop), file, settings, report, stop);
    case FileFormat::stl:
      return ingest_mesh(scan_stl(file), file, settings, report, stop);
    case FileFormat::ply:
      return ingest_mesh(scan_ply(file), file, settings, report, stop);
    case FileFormat::glb:
      return ingest_mesh(scan_glb(file), file, settings, report, stop);
    case FileFormat::palm_driver:
      return read_palm_driver(file, report);
    case FileFormat::archive:
    case FileFormat::raster:
    case FileFormat::only_by_name:
    case FileFormat::features:
    case FileFormat::unknown:
      break;
  }
  require_readable(file, format);
  require_city_size(file);
  return read_footprints(file, settings.footprints, report);
}

SourceCity read(const InputFile& file, const IngestSettings& settings, Report& report, const std::stop_token& stop) {
  const FileFormat format = format_of(file, report);
  SourceCity city = read_as(format, file, settings, report, stop);
  city.advice = advice_of(format);
  return city;
}

/// One of several files.
struct FileReading {
  Report report;
  std::optional<SourceCity> city;
  std::exception_ptr failure;  ///< what ends the run: the first in the order of the files does
};

/// A file that cannot be used is reported and does not end the run.
FileReading ingest_among_others(const InputFile& file, const IngestSettings& settings, const std::stop_token& stop) {
  FileReading reading;
  try {
    if (is_empty(file))
      reading.report.add({ProblemCode::empty_file, file.name, "the whole file", "0 bytes: was the download cut short?"});
    else
      reading.city = ingest(file, settings, reading.report, stop);
  } catch (const InputError& error) {
    reading.report.add({ProblemCode::unusable_file, file.name, "the whole file", error.what()});
  } catch (...) {
    reading.failure = std::current_exception();
  }
  return reading;
}

/// Reads some files at a time. Their cities and problems are in the order of the files.
std::vector<SourceCity> ingest_several(std::span<const InputFile> files, const IngestSettings& settings, Report& report,
                                       const std::stop_token& stop) {
  std::vector<SourceCity> cities;
  std::vector<FileReading> readings(std::min(threads_here(), most_files_at_once));
  std::vector<const InputFile*> files_at(readings.size());
  std::size_t next = 0;
  const auto begin = [&](std::size_t place) {
    throw_if_cancelled(stop);
    if (next == files.size()) return false;
    files_at[place] = &files[next++];
    return true;
  };
  const auto read_one = [&](std::size_t place) { readings[place] = ingest_among_others(*files_at[place], settings, stop); };
  const auto end = [&](std::size_t place) {
    FileReading reading = std::move(readings[place]);
    if (reading.failure) std::rethrow_exception(reading.failure);
    for (Problem& problem : reading.report.since(0)) report.add(std::move(problem));
    if (reading.city) cities.push_back(std::move(*reading.city));
  };
  run_in_order(readings.size(), {begin, read_one, end});
  return cities;
}

}  // namespace

SourceCity ingest(const InputFile& file, const IngestSettings& settings, Report& report, const std::stop_token& stop) {
  require_content(file);
  const std::size_t known = report.problems().size();
  SourceCity city = read(file, settings, report, stop);
  if (city.city.buildings().empty() && city.relief_points.empty()) {
    const auto& problems = report.problems();
    const std::string reason =
        problems.size() > known ? " The first problem: " + problems[known].place + ": " + problems[known].detail + "." : "";
    throw InputError(file.name + " holds no usable building; " + std::to_string(problems.size() - known) +
                     " problems are in the report." + reason);
  }
  return city;
}

namespace {

/// Parts of buildings in one file stand for the outlines that another one has of them, as Overture's two types do.
void drop_outlines_with_parts(std::vector<SourceCity>& cities) {
  std::set<std::string> owners;
  for (SourceCity& city : cities) owners.insert(city.owners_of_parts.begin(), city.owners_of_parts.end());
  if (owners.empty()) return;
  for (SourceCity& city : cities) {
    std::vector<bool> is_dropped(city.city.facets().size());
    for (const Building& b : city.city.buildings()) {
      if (!owners.contains(b.id)) continue;
      ++city.skipped["outlines of buildings whose parts are there"];
      std::fill_n(is_dropped.begin() + static_cast<std::ptrdiff_t>(b.first_facet), b.facet_count, true);
    }
    city.city.drop_facets(is_dropped);
  }
}

}  // namespace

std::vector<SourceCity> ingest_all(std::span<const InputFile> found, const IngestSettings& settings, Report& report,
                                   const std::stop_token& stop) {
  std::vector<InputFile> files(found.begin(), found.end());
  // The features are read with their header. Where it is alone, the reader says that it has no buildings
  if (files.size() > 1) std::erase_if(files, is_header_of_features);
  if (files.empty() && !found.empty()) files.push_back(found.front());
  if (files.size() == 1) {
    std::vector<SourceCity> cities;
    cities.push_back(ingest(files.front(), settings, report, stop));
    return cities;
  }
  const std::size_t known = report.problems().size();
  std::vector<SourceCity> cities = ingest_several(files, settings, report, stop);
  if (cities.empty() && !files.empty())
    throw InputError("none of the " + std::to_string(files.size()) + " files can be used. The first problem: " +
                     report.problems()[known].source + ": " + report.problems()[known].detail);
  drop_outlines_with_parts(cities);
  return cities;
}

}  // namespace farlod::ingest
