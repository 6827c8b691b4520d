// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "farlod/point.hpp"

namespace farlod::scenes {

/// Triangles, z up, to be written as files of several formats.
struct TriangleMesh {
  std::vector<Point3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

template <class Number>
void append_bytes(std::string& bytes, Number number) {
  std::array<char, sizeof number> raw{};
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

template <class Number>
void append_big_endian(std::string& bytes, Number number) {
  append_bytes(bytes, number);
  std::reverse(bytes.end() - sizeof number, bytes.end());
}

inline std::string words_of(const Point3d& p) {
  std::ostringstream text;
  text.precision(17);
  text << p.x << ' ' << p.y << ' ' << p.z;
  return text.str();
}

inline std::string obj_of(const TriangleMesh& mesh) {
  std::string text;
  for (const Point3d& p : mesh.vertices) text += "v " + words_of(p) + '\n';
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  return text;
}

/// A solid of STL as text.
inline std::string stl_text_of(const TriangleMesh& mesh, const std::string& name = "town") {
  std::string text = "solid " + name + '\n';
  for (const auto& triangle : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t corner : triangle) text += "   vertex " + words_of(mesh.vertices[corner]) + '\n';
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + '\n';
}

inline std::string stl_of(const TriangleMesh& mesh) {
  std::string bytes = "solid in name only";
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    bytes.append(3 * sizeof(float), '\0');
    for (const std::uint32_t corner : triangle) {
      const Point3d& p = mesh.vertices[corner];
      for (const double coordinate : {p.x, p.y, p.z}) append_bytes(bytes, static_cast<float>(coordinate));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

/// The head of a PLY file, whose vertices have a colour besides.
inline std::string ply_head_of(const TriangleMesh& mesh, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment made by a test\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty double x\nproperty float64 y\nproperty double z\nproperty uchar red\nelement face " +
         std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text_of(const TriangleMesh& mesh) {
  std::string text = ply_head_of(mesh, "ascii");
  for (const Point3d& p : mesh.vertices) text += words_of(p) + " 255\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
  return text;
}

inline std::string ply_of(const TriangleMesh& mesh, bool is_big_endian) {
  std::string bytes = ply_head_of(mesh, is_big_endian ? "binary_big_endian" : "binary_little_endian");
  const auto append = [&](auto number) { is_big_endian ? append_big_endian(bytes, number) : append_bytes(bytes, number); };
  for (const Point3d& p : mesh.vertices) {
    for (const double coordinate : {p.x, p.y, p.z}) append(coordinate);
    append(std::uint8_t{255});
  }
  for (const auto& triangle : mesh.triangles) {
    append(std::uint8_t{3});
    for (const std::uint32_t corner : triangle) append(static_cast<std::int32_t>(corner));
  }
  return bytes;
}

/// A file of binary glTF of a JSON text and what it refers to.
inline std::string glb_of(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_bytes(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

/// What a GLB file has in its binary part: the points with y up, then the corners of triangles.
inline std::string glb_binary_of(const TriangleMesh& mesh) {
  std::string binary;
  for (const Point3d& p : mesh.vertices)
    for (const double coordinate : {p.x, p.z, -p.y}) append_bytes(binary, static_cast<float>(coordinate));
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) append_bytes(binary, corner);
  return binary;
}

/// The lists of a GLB file that lead to these bytes: accessor 0 has the points, 1 the corners.
inline std::string glb_lists_of(const TriangleMesh& mesh) {
  const std::size_t point_bytes = 12 * mesh.vertices.size(), corner_bytes = 12 * mesh.triangles.size();
  return R"("asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(point_bytes + corner_bytes) +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(point_bytes) + R"(},{"buffer":0,"byteOffset":)" +
         std::to_string(point_bytes) + R"(,"byteLength":)" + std::to_string(corner_bytes) +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" + std::to_string(mesh.vertices.size()) +
         R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" + std::to_string(3 * mesh.triangles.size()) + "}]";
}

/// The mesh as the one node of a GLB file, which has these further members, such as `"translation":[1,2,3]`.
inline std::string glb_of(const TriangleMesh& mesh, const std::string& of_node = "", const std::string& of_file = "") {
  return glb_of("{" + glb_lists_of(mesh) + of_file +
                    R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":[{"mesh":0)" + of_node +
                    R"(}],"scenes":[{"nodes":[0]}]})",
                glb_binary_of(mesh));
}

}  // namespace farlod::scenes
