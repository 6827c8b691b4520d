// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/obj/obj_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <memory>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/cancellation.hpp"
#include "farlod/error.hpp"
#include "ingest/obj/obj_classes.hpp"
#include "ingest/obj/obj_mesh.hpp"

namespace farlod::ingest {
namespace {

/// The faces of each building, in the order of the file.
struct FacesByBuilding {
  std::vector<std::uint32_t> faces;
  std::vector<std::size_t> begin;  ///< of each building in `faces`, and one past the last
  std::vector<std::string> ids;
};

bool is_in_range(const ObjMesh& mesh, std::int64_t corner) {
  return corner >= 0 && corner < static_cast<std::int64_t>(mesh.vertices.size());
}

/// For each face, the first face of its connected component. Faces are connected if they share a point.
std::vector<std::uint32_t> components(const ObjMesh& mesh, const std::vector<bool>& is_building) {
  const std::vector<std::uint32_t> point_of = weld(mesh.vertices);
  std::vector<std::uint32_t> first_face(mesh.vertices.size(), 0xFFFFFFFF), roots;
  DisjointSets sets(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (std::uint32_t c = 0; is_building[f] && c < mesh.faces[f].corner_count; ++c) {
      const std::int64_t corner = mesh.corners[mesh.faces[f].first_corner + c];
      if (!is_in_range(mesh, corner)) continue;
      std::uint32_t& first = first_face[point_of[static_cast<std::size_t>(corner)]];
      if (first == 0xFFFFFFFF) first = f;
      sets.join(first, f);
    }
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) roots.push_back(sets.find(f));
  return roots;
}

/// Sorts the faces of buildings by a key; buildings come in the order of their first face.
FacesByBuilding sort_by(const std::vector<std::uint32_t>& key_of_face, const std::vector<bool>& is_building,
                        std::size_t key_count) {
  FacesByBuilding sorted;
  constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<std::uint32_t> building_of_key(key_count, none), building_of_face(key_of_face.size(), none);
  std::uint32_t buildings = 0;
  for (std::size_t f = 0; f < key_of_face.size(); ++f) {
    if (!is_building[f]) continue;
    std::uint32_t& building = building_of_key[key_of_face[f]];
    if (building == none) building = buildings++;
    building_of_face[f] = building;
  }
  sorted.begin.assign(buildings + 1, 0);
  for (const std::uint32_t b : building_of_face)
    if (b != none) ++sorted.begin[b + 1];
  std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
  sorted.faces.resize(sorted.begin.back());
  std::vector<std::size_t> next = sorted.begin;
  for (std::uint32_t f = 0; f < key_of_face.size(); ++f)
    if (building_of_face[f] != none) sorted.faces[next[building_of_face[f]]++] = f;
  return sorted;
}

FacesByBuilding group_faces(const ObjMesh& mesh, const std::vector<bool>& is_building) {
  const bool has_objects = mesh.objects.size() > 2, has_names = mesh.objects.size() > 1 || mesh.groups.size() > 1;
  const bool by_object = has_objects || mesh.groups.size() == 1;
  std::vector<std::uint32_t> keys;
  if (has_names)
    for (const ObjFace& face : mesh.faces) keys.push_back(by_object ? face.object : face.group);
  else
    keys = components(mesh, is_building);
  FacesByBuilding sorted = sort_by(keys, is_building, std::max({mesh.faces.size(), mesh.groups.size(), mesh.objects.size()}));
  for (std::size_t b = 0; b + 1 < sorted.begin.size(); ++b) {
    const std::uint32_t key = keys[sorted.faces[sorted.begin[b]]];
    const std::string name = !has_names ? "" : by_object ? mesh.objects[key] : mesh.groups[key];
    sorted.ids.push_back(!name.empty() ? name : has_names ? "unnamed" : "component " + std::to_string(b + 1));
  }
  return sorted;
}

Point3d placed(const ObjFrame& frame, const Point3d& p) {
  return frame.origin + (frame.up == UpAxis::y ? Point3d{p.x, -p.z, p.y} : p);
}

class ObjBuildings {
 public:
  ObjBuildings(const ObjMesh& mesh, const ObjFrame& frame, CityModelBuilder& builder)
      : mesh_(mesh), frame_(frame), builder_(builder) {}

  void add(const std::string& id, std::span<const std::uint32_t> faces) {
    builder_.begin_building(id);
    gather(faces);
    const std::vector<std::uint32_t> surface = number_planar_faces(corners_);
    for (std::size_t k = 0; k < corners_.face_count(); ++k) {
      const std::string name = "of line " + std::to_string(mesh_.faces[kept_[k]].line);
      rings_.resize(1);
      rings_[0].assign(corners_.face(k).begin(), corners_.face(k).end());
      builder_.add_polygon(rings_, RingEnd::implied, {.kind = SurfaceKind::unknown, .surface = surface[k], .name = name});
    }
    builder_.end_building("none of its faces is usable");
  }

 private:
  void gather(std::span<const std::uint32_t> faces) {
    corners_ = {};
    kept_.clear();
    for (const std::uint32_t f : faces) {
      const ObjFace& face = mesh_.faces[f];
      const auto numbers = std::span(mesh_.corners).subspan(face.first_corner, face.corner_count);
      if (!std::all_of(numbers.begin(), numbers.end(), [&](std::int64_t corner) { return is_in_range(mesh_, corner); })) {
        builder_.add_problem(ProblemCode::vertex_index_out_of_range,
                             "the face of line " + std::to_string(face.line) + " names a vertex that is not among the " +
                                 std::to_string(mesh_.vertices.size()) + " of the file",
                             {}, "polygon of line " + std::to_string(face.line) + ", ring 0 (outer)");
        continue;
      }
      for (const std::int64_t corner : numbers)
        corners_.points.push_back(placed(frame_, mesh_.vertices[static_cast<std::size_t>(corner)]));
      corners_.end_face();
      kept_.push_back(f);
    }
  }

  const ObjMesh& mesh_;
  const ObjFrame frame_;
  CityModelBuilder& builder_;
  FaceCorners corners_;
  std::vector<std::uint32_t> kept_;
  Rings rings_;
};

void report_unread(const ObjMesh& mesh, CityModelBuilder& builder) {
  for (const std::uint64_t line : mesh.malformed_lines)
    builder.add_problem_at("line " + std::to_string(line), ProblemCode::malformed_feature,
                           "a face's corners are not vertex numbers");
  if (mesh.unread_elements > 0)
    builder.add_problem_at(
        "line " + std::to_string(mesh.first_unread_line), ProblemCode::unsupported_geometry,
        std::to_string(mesh.unread_elements) + " points, lines or curved surfaces from here on; only faces (f) are read");
}

/// Buildings that follow each other, as a city and a report of their own.
struct BuildingBatch {
  BuildingBatch(std::size_t first_building, std::size_t past_last, const std::string& source)
      : begin(first_building), end(past_last), builder(source, report, RepeatedIds::reported_by_append) {}

  std::size_t begin, end;
  Report report;
  CityModelBuilder builder;
};

/// Builds the buildings on all threads, and appends them in their order.
void add_buildings(const ObjMesh& mesh, const FacesByBuilding& sorted, const ObjFrame& frame, const std::stop_token& stop,
                   CityModelBuilder& builder) {
  constexpr std::size_t faces_of_a_batch = 4096;
  std::vector<std::unique_ptr<BuildingBatch>> in_flight(places_for_threads());
  std::size_t next = 0, let_go_at = 0;
  const auto begin = [&](std::size_t place) {
    throw_if_cancelled(stop);
    const std::size_t first = next;
    while (next < sorted.ids.size() && sorted.begin[next] < sorted.begin[first] + faces_of_a_batch) ++next;
    if (first == next) return false;
    in_flight[place] = std::make_unique<BuildingBatch>(first, next, builder.source());
    return true;
  };
  const auto build = [&](std::size_t place) {
    BuildingBatch& batch = *in_flight[place];
    ObjBuildings buildings(mesh, frame, batch.builder);
    for (std::size_t b = batch.begin; b < batch.end; ++b)
      buildings.add(sorted.ids[b], std::span(sorted.faces).subspan(sorted.begin[b], sorted.begin[b + 1] - sorted.begin[b]));
  };
  const auto append = [&](std::size_t place) {
    const std::unique_ptr<BuildingBatch> batch = std::move(in_flight[place]);
    builder.append(std::move(batch->builder));
    if (batch->end < let_go_at) return;
    mesh.let_go();
    let_go_at = batch->end + CityModel::buildings_held;
  };
  run_in_order(in_flight.size(), {begin, build, append});
}

}  // namespace

namespace {

/// Sorts out what is no building: the corners of ground become points of a relief, other faces are counted.
std::vector<bool> sort_out(const ObjMesh& mesh, const ObjFrame& frame, ObjRest& rest) {
  const ObjClasses classes(mesh);
  std::vector<bool> is_building;
  for (const ObjFace& face : mesh.faces) {
    const ObjClass face_class = classes.of(face);
    is_building.push_back(face_class == ObjClass::building);
    if (face_class == ObjClass::other) ++rest.skipped["faces of " + classes.name_of(face)];
    if (face_class != ObjClass::ground) continue;
    for (const std::int64_t corner : std::span(mesh.corners).subspan(face.first_corner, face.corner_count))
      if (is_in_range(mesh, corner)) rest.relief_points.push_back(placed(frame, mesh.vertices[static_cast<std::size_t>(corner)]));
  }
  return is_building;
}

}  // namespace

ObjRest read_obj(const InputFile& file, const ObjFrame& frame, CityModelBuilder& builder, const std::stop_token& stop) {
  const ObjMesh mesh = scan_obj(*open_input(file), stop);
  report_unread(mesh, builder);
  if (mesh.faces.empty())
    throw InputError(file.name + " holds " + std::to_string(mesh.vertices.size()) +
                     " vertices and no face: it is not an OBJ file, or it is a point cloud. Export it as a polygon mesh.");
  ObjRest rest;
  const std::vector<bool> is_building = sort_out(mesh, frame, rest);
  add_buildings(mesh, group_faces(mesh, is_building), frame, stop, builder);
  return rest;
}

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

  ObjPlacement search() {
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
  ObjPlacement found_;
};

}  // namespace

ObjPlacement find_obj_placement(const InputFile& file) { return PlacementSearch(file).search(); }

std::vector<std::string> notes_of(const ObjPlacement& placement, const InputFile& file, bool has_origin) {
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
