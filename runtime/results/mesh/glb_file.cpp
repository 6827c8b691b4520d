// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/mesh/glb_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "farlod/error.hpp"
#include "results/atomic_file.hpp"
#include "results/decimal.hpp"
#include "results/json_text.hpp"

namespace farlod {
namespace {

static_assert(std::endian::native == std::endian::little, "vertices are written as they lie in memory");

constexpr std::size_t bytes_of_vertex = 3 * sizeof(float) + 4 * sizeof(std::uint16_t);
constexpr std::size_t bytes_at_once = 1 << 16;
// All lengths of the format are of 32 bits; a megabyte is for what is not vertices
constexpr std::uint64_t most_bytes_of_vertices = std::numeric_limits<std::uint32_t>::max() - (std::uint64_t{1} << 20U);

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

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

}  // namespace

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
    append(waiting_, place[k]);
  }
  for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) append(waiting_, linear(channel));
  append(waiting_, std::numeric_limits<std::uint16_t>::max());
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
  std::string json_chunk = json();
  json_chunk.resize((json_chunk.size() + 3) / 4 * 4, ' ');
  const std::uint64_t binary = vertices_ * bytes_of_vertex, chunk_head = 8, head = 12;
  const std::uint64_t all = head + chunk_head + json_chunk.size() + (binary > 0 ? chunk_head + binary : 0);
  write_atomically(path_, [&](std::ostream& out) {
    std::string bytes = "glTF";
    append(bytes, std::uint32_t{2});
    append(bytes, static_cast<std::uint32_t>(all));
    append(bytes, static_cast<std::uint32_t>(json_chunk.size()));
    bytes += "JSON" + json_chunk;
    if (binary > 0) {
      append(bytes, static_cast<std::uint32_t>(binary));
      bytes.append("BIN\0", 4);
    }
    out << bytes;
    std::vector<char> part(bytes_at_once);
    for (std::uint64_t done = 0; done < binary; done += part.size()) {
      part.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes_at_once, binary - done)));
      spool_.read(done, std::as_writable_bytes(std::span(part)));
      out.write(part.data(), static_cast<std::streamsize>(part.size()));
    }
  });
}

}  // namespace farlod
