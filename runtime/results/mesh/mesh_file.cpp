// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <ostream>
#include <string_view>
#include <tuple>

#include "farlod/error.hpp"
#include "farlod/point.hpp"
#include "results/atomic_file.hpp"
#include "results/picture/picture.hpp"
#include "results/spool_file.hpp"
#include "results/table/blocks_of_city.hpp"
#include "results/table/sky_table_csv.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

/// The name of a group is one word.
std::string group_of(const MeshPart& part) {
  std::string name = part.building ? part.id : "ground";
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }, '_');
  return name.empty() ? "building_" + std::to_string(*part.building) : name;
}

/// What the vertices of a file are joined to; the numbers are those of glTF.
enum class GlbPrimitive : std::uint8_t { points = 0, triangles = 4 };

/// A file of binary glTF 2.0: coloured vertices, which are points, or three each a triangle. Vertices wait on disk until the file
/// is complete. Their coordinates count from an origin, with the axes of glTF: x to the east, y upwards, z to the south. All
/// functions throw OutputError.
class GlbFile {
 public:
  /// The origin, the CRS and what made the file are in `asset.extras`.
  GlbFile(GlbPrimitive primitive, const Point3d& origin_m, const TableFrame& frame, const std::filesystem::path& path);

  void add(const Point3d& p_projected, Colour colour);
  /// The file appears now.
  void commit();

 private:
  void flush();
  [[nodiscard]] std::string json() const;

  GlbPrimitive primitive_;
  Point3d origin_m_;
  std::string asset_;
  std::filesystem::path path_;
  SpoolFile spool_;
  std::string waiting_;  ///< bytes that are not in the spool yet
  std::uint64_t vertices_ = 0;
  std::array<float, 3> low_{}, high_{};  ///< of all vertices
};

constexpr std::size_t bytes_of_vertex = 3 * sizeof(float) + 4 * sizeof(std::uint16_t);
constexpr std::size_t bytes_at_once = 1 << 16;
// All lengths of the format are of 32 bits; a megabyte is for what is not vertices
constexpr std::uint64_t most_bytes_of_vertices = std::numeric_limits<std::uint32_t>::max() - (std::uint64_t{1} << 20U);

/// glTF takes colours of vertices without the transfer function of sRGB (IEC 61966-2-1).
std::uint16_t linear(std::uint8_t channel) {
  const double v = channel / 255.0, light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(light * std::numeric_limits<std::uint16_t>::max()));
}

void append_member(std::string& json, std::string_view name, std::string_view text) {
  json += ", ";
  append_json_text(json, name);
  json += ": ";
  append_json_text(json, text);
}

std::string asset_of(const Point3d& origin_m, const TableFrame& frame) {
  std::string json = "{\"version\": \"2.0\"";
  if (!frame.provenance.software.empty()) append_member(json, "generator", frame.provenance.software);
  json += ", \"extras\": {\"origin_m\": [" + shortest_decimal(origin_m.x) + ", " + shortest_decimal(origin_m.y) + ", " +
          shortest_decimal(origin_m.z) + "]";
  append_member(json, "axes", "metres from origin_m (easting, northing, height): x east, y up, z south");
  if (frame.epsg) append_member(json, "crs", "EPSG:" + std::to_string(*frame.epsg));
  if (!frame.crs_wkt.empty()) append_member(json, "crs_wkt", frame.crs_wkt);
  for (const auto& [name, value] : entries_of(frame.provenance)) append_member(json, name, value);
  return json + "}}";
}

/// Exactly the floats: the shortest decimal of a double reads back as it.
std::string array_of(const std::array<float, 3>& v) {
  const auto text = [](float x) { return shortest_decimal(static_cast<double>(x)); };
  return "[" + text(v[0]) + ", " + text(v[1]) + ", " + text(v[2]) + "]";
}

GlbFile::GlbFile(GlbPrimitive primitive, const Point3d& origin_m, const TableFrame& frame, const std::filesystem::path& path)
    : primitive_(primitive), origin_m_(origin_m), asset_(asset_of(origin_m, frame)), path_(path), spool_(path) {}

void GlbFile::add(const Point3d& p_projected, Colour colour) {
  if ((vertices_ + 1) * bytes_of_vertex > most_bytes_of_vertices)
    throw OutputError(path_, "it would be larger than 4 GiB, which no GLB can be: choose a part of the city, or another format");
  const Point3d p = p_projected - origin_m_;
  const std::array<float, 3> place{static_cast<float>(p.x), static_cast<float>(p.z), static_cast<float>(-p.y)};
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k] = vertices_ == 0 ? place[k] : std::min(low_[k], place[k]);
    high_[k] = vertices_ == 0 ? place[k] : std::max(high_[k], place[k]);
    append_bytes(waiting_, place[k]);
  }
  for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) append_bytes(waiting_, linear(channel));
  append_bytes(waiting_, std::numeric_limits<std::uint16_t>::max());
  ++vertices_;
  if (waiting_.size() >= bytes_at_once) flush();
}

void GlbFile::flush() {
  (void)spool_.append(std::as_bytes(std::span(waiting_)));
  waiting_.clear();
}

std::string GlbFile::json() const {
  const std::string bytes = std::to_string(vertices_ * bytes_of_vertex), count = std::to_string(vertices_);
  std::string json = "{\"asset\": " + asset_ + ", \"scene\": 0, \"scenes\": [";
  if (vertices_ == 0) return json + "{}]}";
  const char* const sides = primitive_ == GlbPrimitive::triangles ? "\"doubleSided\": true, " : "";
  json += R"({"nodes": [0]}], "nodes": [{"mesh": 0}], "extensionsUsed": ["KHR_materials_unlit"], )";
  json +=
      std::string(R"("materials": [{)") + sides +
      R"("pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.9}, "extensions": {"KHR_materials_unlit": {}}}], )";
  json += R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}, "material": 0, "mode": )" +
          std::to_string(static_cast<int>(primitive_)) + "}]}], ";
  json += R"("buffers": [{"byteLength": )" + bytes + "}], ";
  json += R"("bufferViews": [{"buffer": 0, "byteLength": )" + bytes + R"(, "byteStride": )" + std::to_string(bytes_of_vertex) +
          R"(, "target": 34962}], )";
  json += R"("accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" + count + R"(, "min": )" +
          array_of(low_) + R"(, "max": )" + array_of(high_) + "}, ";
  json += R"({"bufferView": 0, "byteOffset": 12, "componentType": 5123, "normalized": true, "type": "VEC4", "count": )" + count;
  return json + "}]}";
}

void GlbFile::commit() {
  flush();
  const std::uint64_t binary = vertices_ * bytes_of_vertex;
  write_atomically(path_, [&](std::ostream& out) {
    out << glb_head(json(), binary);
    std::vector<char> part(bytes_at_once);
    for (std::uint64_t done = 0; done < binary; done += part.size()) {
      part.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes_at_once, binary - done)));
      spool_.read(done, std::as_writable_bytes(std::span(part)));
      out.write(part.data(), static_cast<std::streamsize>(part.size()));
    }
  });
}

Colour colour_of(const std::optional<double>& svf) { return svf ? colour_of_svf(*svf) : nodata_colour; }

/// Whole metres in the middle of the points that have a height, as low as the lowest of them.
Point3d origin_of(const PointRows& rows) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (std::size_t n = 0; n < rows.count; ++n) {
    const PointRow row = rows.row(n);
    if (!row.height_m || !row.has_place()) continue;
    low = {std::min(low.x, row.p_projected.x), std::min(low.y, row.p_projected.y), std::min(low.z, *row.height_m)};
    high = {std::max(high.x, row.p_projected.x), std::max(high.y, row.p_projected.y), 0.0};
  }
  if (low.x > high.x) return {};
  return {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), std::floor(low.z)};
}

/// Whole metres in the middle of the city, at the height from which its heights count on disk.
Point3d origin_of(const Package& package) {
  const Box2d& outline = package.description().outline_projected;
  return {std::round(0.5 * (outline.low.x + outline.high.x)), std::round(0.5 * (outline.low.y + outline.high.y)),
          std::round(inventory_of(package).height_origin_m)};
}

/// Finds the mean of a surface by its building and its number.
class MeanOfSurface {
 public:
  explicit MeanOfSurface(std::span<const SurfaceMean> surfaces) {
    for (const SurfaceMean& surface : surfaces) ordered_.push_back(&surface);
    std::ranges::sort(ordered_, {}, key);
  }
  [[nodiscard]] std::optional<double> operator()(const std::string& building, std::uint32_t surface) const {
    const auto found = std::ranges::lower_bound(ordered_, std::tie(building, surface), {}, key);
    return found != ordered_.end() && key(*found) == std::tie(building, surface) ? (*found)->svf_mean : std::nullopt;
  }

 private:
  static std::tuple<const std::string&, const std::uint32_t&> key(const SurfaceMean* s) { return {s->building, s->surface}; }

  std::vector<const SurfaceMean*> ordered_;
};

}  // namespace

std::string glb_head(std::string json, std::uint64_t binary_bytes) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t head = 12, chunk_head = 8;
  const std::uint64_t all = head + chunk_head + json.size() + (binary_bytes > 0 ? chunk_head + binary_bytes : 0);
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(all));
  append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  if (binary_bytes == 0) return bytes;
  append_bytes(bytes, static_cast<std::uint32_t>(binary_bytes));
  return bytes.append("BIN\0", 4);
}

void write_obj(const std::vector<MeshPart>& parts, Point2d offset_m, const std::vector<std::string>& remarks,
               const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& file) {
    for (const std::string& remark : remarks) file << "# " << remark << '\n';
    file << fmt::format("# Offset: add {:.0f} to x and {:.0f} to y; z is the height above sea level\n", offset_m.x, offset_m.y);
    std::size_t first = 1;  // OBJ counts from 1
    const MeshPart* last = nullptr;
    for (const MeshPart& part : parts) {
      if (last == nullptr || last->building != part.building) file << "g " << group_of(part) << '\n';
      last = &part;
      std::string text;
      for (const Point3d& p : part.vertices_projected)
        fmt::format_to(std::back_inserter(text), "v {:.4f} {:.4f} {:.4f}\n", p.x - offset_m.x, p.y - offset_m.y, p.z);
      for (const MeshTriangle& t : part.triangles)
        fmt::format_to(std::back_inserter(text), "f {} {} {}\n", first + t.vertices[0], first + t.vertices[1],
                       first + t.vertices[2]);
      first += part.vertices_projected.size();
      file << text;
    }
  });
}

void write_points_glb(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  GlbFile file(GlbPrimitive::points, origin_of(rows), frame, path);
  for (std::size_t n = 0; n < rows.count; ++n) {
    const PointRow row = rows.row(n);
    if (row.height_m && row.has_place()) file.add({row.p_projected.x, row.p_projected.y, *row.height_m}, colour_of(row.svf));
  }
  file.commit();
}

std::vector<std::filesystem::path> SurfacesGlb::commit(std::span<const SurfaceMean> surfaces,
                                                       std::span<const BuildingMean> buildings) {
  const std::filesystem::path csv = std::filesystem::path(path_).replace_extension(".csv");
  std::vector<std::filesystem::path> files{path_, table_beside(csv, ".surfaces"), table_beside(csv, ".buildings")};
  write_surfaces_csv(surfaces, frame_.columns, files[1]);
  write_buildings_csv(buildings, frame_.columns, files[2]);
  write_mesh(surfaces);  // the file of -o appears last
  return files;
}

void SurfacesGlb::write_mesh(std::span<const SurfaceMean> surfaces) const {
  GlbFile file(GlbPrimitive::triangles, frame_.package != nullptr ? origin_of(*frame_.package) : Point3d{}, frame_, path_);
  const MeanOfSurface mean_of(surfaces);
  const auto add_block = [&](const CellRectangle& block) {
    for (const MeshPart& part : geometry_of(*frame_.package, block))
      for (const MeshTriangle& triangle : part.triangles) {
        if (!part.building) break;  // the ground is no surface that has a mean
        const Colour colour = colour_of(mean_of(part.id, triangle.surface));
        for (const std::uint32_t vertex : triangle.vertices) file.add(part.vertices_projected[vertex], colour);
      }
  };
  if (frame_.package != nullptr) for_each_block(inventory_of(*frame_.package), add_block);
  file.commit();
}

}  // namespace farlod
