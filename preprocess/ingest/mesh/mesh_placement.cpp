// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh/mesh_placement.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <utility>

namespace farlod::ingest {
namespace {

/// The largest file of a placement that is read.
constexpr std::size_t most_bytes = std::size_t{1} << 16;

constexpr std::string_view separators = " \t\r\n,;";

/// The numbers of a text; empty when it contains anything else.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    text = text.substr(std::min(text.find_first_not_of(separators), text.size()));
    if (text.empty()) return numbers;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const auto length = static_cast<std::size_t>(end - text.data());
    const bool ends_there = length == text.size() || separators.find(text[length]) != separators.npos;
    if (error != std::errc() || !ends_there || !std::isfinite(value)) return std::nullopt;
    numbers.push_back(value);
    text.remove_prefix(length);
  }
}

std::optional<Point3d> three_numbers(std::string_view text) {
  const auto numbers = numbers_in(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Point3d{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

/// "WGS84 UTM 32N" → "EPSG:32632".
std::string crs_of_utm_zone(std::string_view line) {
  constexpr std::string_view head = "WGS84 UTM ";
  if (!line.starts_with(head)) return {};
  line.remove_prefix(head.size());
  int zone = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), zone);
  const std::string_view hemisphere = line.substr(static_cast<std::size_t>(end - line.data()));
  if (error != std::errc() || zone < 1 || zone > 60 || (hemisphere != "N" && hemisphere != "S")) return {};
  return "EPSG:" + std::to_string((hemisphere == "N" ? 32600 : 32700) + zone);
}

/// The text of an XML element without attributes or children.
std::string_view element(std::string_view xml, const std::string& name) {
  const std::size_t begin = xml.find("<" + name + ">");
  if (begin == xml.npos) return {};
  const std::string_view rest = xml.substr(begin + name.size() + 2);
  const std::size_t end = rest.find("</" + name + ">");
  return end == rest.npos ? std::string_view() : rest.substr(0, end);
}

class PlacementSearch {
 public:
  explicit PlacementSearch(const InputFile& file)
      : file_(file), stem_(std::filesystem::path(file.unpacked_name()).stem().string()) {}

  MeshPlacement search() {
    if (const auto crs = text_of(stem_ + ".prj")) take_crs(*crs, stem_ + ".prj");
    for (const std::string& name : {stem_ + ".offset", stem_ + "_offset.xyz", std::string("offset.xyz")})
      if (const auto text = text_of(name))
        if (const auto origin = three_numbers(*text)) take_origin(*origin, name);
    for (const char* name : {"coords.txt", "../odm_georeferencing/coords.txt"}) take_opendronemap(name);
    for (const char* name : {"metadata.xml", "../metadata.xml", "../../metadata.xml"}) take_contextcapture(name);
    return found_;
  }

 private:
  std::optional<std::string> text_of(const std::string& name) const { return find_beginning(file_.beside(name), most_bytes); }

  void take_crs(std::string_view crs, const std::string& name) {
    if (!found_.crs.empty() || crs.empty()) return;
    found_.crs = crs;
    found_.crs_file = name;
  }

  void take_origin(const Point3d& origin, const std::string& name) {
    if (found_.origin) return;
    found_.origin = origin;
    found_.origin_file = name;
  }

  /// Reads the first lines; positions of cameras follow. `odm_textured_model` is the model without "geo": its coordinates are
  /// relative to the first camera, so that the file does not apply to it.
  void take_opendronemap(const std::string& name) {
    const auto text = stem_ == "odm_textured_model" ? std::nullopt : text_of(name);
    if (!text) return;
    std::string_view rest = *text;
    const std::string crs = crs_of_utm_zone(take_line(rest));
    const auto numbers = numbers_in(take_line(rest));
    if (crs.empty() || !numbers || numbers->size() < 2) return;
    take_crs(crs, name);
    take_origin({(*numbers)[0], (*numbers)[1], 0.0}, name);
  }

  void take_contextcapture(const std::string& name) {
    const auto text = text_of(name);
    if (!text || text->find("<ModelMetadata") == text->npos) return;
    const auto origin = three_numbers(element(*text, "SRSOrigin"));
    if (!origin) return;
    take_crs(element(*text, "SRS"), name);
    take_origin(*origin, name);
  }

  const InputFile& file_;
  std::string stem_;
  MeshPlacement found_;
};

}  // namespace

MeshPlacement find_mesh_placement(const InputFile& file) { return PlacementSearch(file).search(); }

std::vector<std::string> notes_of(const MeshPlacement& placement, const InputFile& file, bool has_origin) {
  std::vector<std::string> notes;
  if (!placement.crs_file.empty()) notes.push_back(file.name + ": the CRS is that of " + placement.crs_file);
  if (!placement.origin) return notes;
  const Point3d& p = *placement.origin;
  std::ostringstream note;
  note << file.name << ": " << std::fixed << std::setprecision(3) << "the origin " << p.x << ", " << p.y << ", " << p.z << " of "
       << placement.origin_file << (has_origin ? " is not used, as --origin is given" : " is added to its coordinates");
  notes.push_back(std::move(note).str());
  return notes;
}

}  // namespace farlod::ingest
