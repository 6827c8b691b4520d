// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/mesh/mesh_buildings.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"
#include "ingest/files/input_file.hpp"
#include "ingest/mesh/ground_sheets.hpp"
#include "ingest/mesh/mesh_classes.hpp"
#include "ingest/mesh/planar_faces.hpp"

namespace farlod::ingest {
namespace {

/// The faces of each building, in the order of the file.
struct FacesByBuilding {
  std::vector<std::uint32_t> faces;
  std::vector<std::size_t> begin;  ///< of each building in `faces`, and one past the last
  std::vector<std::string> ids;
};

bool is_in_range(const Mesh& mesh, std::int64_t corner) {
  return corner >= 0 && corner < static_cast<std::int64_t>(mesh.vertices.size());
}

/// For each face, the first face of its connected component. Faces are connected if they share a point.
std::vector<std::uint32_t> components(const Mesh& mesh, const std::vector<bool>& is_building) {
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

FacesByBuilding group_faces(const Mesh& mesh, const std::vector<bool>& is_building) {
  const bool has_objects = mesh.objects.size() > 2, has_names = mesh.objects.size() > 1 || mesh.groups.size() > 1;
  const bool by_object = has_objects || mesh.groups.size() == 1;
  std::vector<std::uint32_t> keys;
  if (has_names)
    for (const MeshFace& face : mesh.faces) keys.push_back(by_object ? face.object : face.group);
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

Point3d placed(const MeshFrame& frame, const Point3d& p) { return frame.origin + upright(frame.up, p); }

/// "line 12"
std::string place_of(const Mesh& mesh, std::uint64_t line) { return std::string(mesh.places) + ' ' + std::to_string(line); }

class MeshBuildings {
 public:
  MeshBuildings(const Mesh& mesh, const MeshFrame& frame, CityModelBuilder& builder)
      : mesh_(mesh), frame_(frame), builder_(builder) {}

  void add(const std::string& id, std::span<const std::uint32_t> faces) {
    builder_.begin_building(id);
    gather(faces);
    const std::vector<std::uint32_t> surface = number_planar_faces(corners_);
    for (std::size_t k = 0; k < corners_.face_count(); ++k) {
      const std::string name = "of " + place_of(mesh_, mesh_.faces[kept_[k]].line);
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
      const MeshFace& face = mesh_.faces[f];
      const auto numbers = std::span(mesh_.corners).subspan(face.first_corner, face.corner_count);
      if (!std::all_of(numbers.begin(), numbers.end(), [&](std::int64_t corner) { return is_in_range(mesh_, corner); })) {
        builder_.add_problem(ProblemCode::vertex_index_out_of_range,
                             "the face of " + place_of(mesh_, face.line) + " names a vertex that is not among the " +
                                 std::to_string(mesh_.vertices.size()) + " of the file",
                             {}, "polygon of " + place_of(mesh_, face.line) + ", ring 0 (outer)");
        continue;
      }
      for (const std::int64_t corner : numbers)
        corners_.points.push_back(placed(frame_, mesh_.vertices[static_cast<std::size_t>(corner)]));
      corners_.end_face();
      kept_.push_back(f);
    }
  }

  const Mesh& mesh_;
  const MeshFrame frame_;
  CityModelBuilder& builder_;
  FaceCorners corners_;
  std::vector<std::uint32_t> kept_;
  Rings rings_;
};

void report_unread(const Mesh& mesh, CityModelBuilder& builder) {
  for (const std::uint64_t line : mesh.malformed_lines)
    builder.add_problem_at(place_of(mesh, line), ProblemCode::malformed_feature, "a face's corners are not vertex numbers");
  if (mesh.unread_elements > 0)
    builder.add_problem_at(
        place_of(mesh, mesh.first_unread_line), ProblemCode::unsupported_geometry,
        std::to_string(mesh.unread_elements) + " points, lines or curved surfaces from here on; only faces are read");
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
void add_in_batches(const Mesh& mesh, const FacesByBuilding& sorted, const MeshFrame& frame, const std::stop_token& stop,
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
    MeshBuildings buildings(mesh, frame, batch.builder);
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

bool is_called_alike(const MeshFace& a, const MeshFace& b) {
  return a.object == b.object && a.group == b.group && a.material == b.material;
}

/// Corners that are no points are left out: one NaN would make all of the ground around it unknown.
void add_ground(const Mesh& mesh, const MeshFace& face, const MeshFrame& frame, CityModelBuilder& builder,
                std::vector<Point3d>& points) {
  for (const std::int64_t corner : std::span(mesh.corners).subspan(face.first_corner, face.corner_count)) {
    if (!is_in_range(mesh, corner)) continue;
    const Point3d p = placed(frame, mesh.vertices[static_cast<std::size_t>(corner)]);
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
      points.push_back(p);
    else
      builder.add_problem_at(place_of(mesh, face.line), ProblemCode::unreadable_coordinate, "a corner of the ground is no point");
  }
}

/// Sorts out what is no building: the corners of ground become points of a relief, other faces are counted.
std::vector<bool> sort_out(const Mesh& mesh, const MeshFrame& frame, std::span<const std::string> ground_names,
                           CityModelBuilder& builder, MeshRest& rest) {
  const MeshClasses classes(mesh, ground_names);
  std::vector<bool> is_building;
  const MeshFace* last = nullptr;
  std::uint64_t* count = nullptr;  // of the faces that are called as the last one
  for (const MeshFace& face : mesh.faces) {
    const MeshClass face_class = classes.of(face);
    is_building.push_back(face_class == MeshClass::building);
    if (face_class == MeshClass::building) continue;
    if (last == nullptr || !is_called_alike(*last, face))
      count = face_class == MeshClass::other ? &rest.skipped["faces of " + classes.name_of(face)]
                                             : &rest.ground_faces[classes.name_of(face)];
    last = &face;
    ++*count;
    if (face_class != MeshClass::ground) continue;
    add_ground(mesh, face, frame, builder, rest.relief_points);
  }
  return is_building;
}

/// Takes ground out of the buildings that its name does not tell.
void sort_out_sheets(const Mesh& mesh, const MeshFrame& frame, const FacesByBuilding& sorted, CityModelBuilder& builder,
                     std::vector<bool>& is_building, MeshRest& rest) {
  for (const std::size_t b : find_ground_sheets(mesh, frame.up, {sorted.faces, sorted.begin}))
    for (std::size_t k = sorted.begin[b]; k < sorted.begin[b + 1]; ++k) {
      const std::uint32_t face = sorted.faces[k];
      is_building[face] = false;
      add_ground(mesh, mesh.faces[face], frame, builder, rest.relief_points);
      ++rest.sheet_faces[sorted.ids[b]];
    }
}

}  // namespace

MeshRest add_buildings(const Mesh& mesh, const MeshFrame& frame, std::span<const std::string> ground_names,
                       CityModelBuilder& builder, const std::stop_token& stop) {
  report_unread(mesh, builder);
  MeshRest rest;
  std::vector<bool> is_building = sort_out(mesh, frame, ground_names, builder, rest);
  FacesByBuilding sorted = group_faces(mesh, is_building);
  sort_out_sheets(mesh, frame, sorted, builder, is_building, rest);
  if (!rest.sheet_faces.empty()) sorted = group_faces(mesh, is_building);
  add_in_batches(mesh, sorted, frame, stop, builder);
  return rest;
}

}  // namespace farlod::ingest
