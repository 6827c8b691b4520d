// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>
#include <cstring>
#include <istream>
#include <memory>
#include <string>

#include "farlod/error.hpp"
#include "ingest/files/file_format.hpp"
#include "ingest/mesh/mesh_scanners.hpp"
#include "ingest/mesh/words.hpp"

namespace farlod::ingest {
namespace {

// Binary: 80 bytes for anything, the number of triangles, and of each its normal, three corners and two bytes
constexpr std::size_t stl_title_bytes = 80, stl_head_bytes = 84, stl_triangle_bytes = 50, stl_normal_bytes = 12;
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

template <class Number>
Number number_in_stl(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

void require_all(bool is_all, const std::string& name, const Mesh& mesh) {
  if (!is_all)
    throw InputError(name + " ends after " + std::to_string(mesh.faces.size()) +
                     " triangles: it is cut short, or it is not an STL file.");
}

void scan_text_stl(std::istream& text, const std::string& name, Mesh& mesh) {
  std::string line;
  std::vector<std::int64_t> corners;
  while (std::getline(text, line)) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "solid") {
      mesh.objects.emplace_back(trimmed(rest));
    } else if (word == "vertex") {
      Point3d p;
      for (double* coordinate : {&p.x, &p.y, &p.z}) *coordinate = coordinate_from(take_word(rest));
      corners.push_back(static_cast<std::int64_t>(mesh.vertices.size()));
      mesh.vertices.push_back(p);
    } else if (word == "endloop") {
      mesh.add_face(corners);
      corners.clear();
    }
  }
  require_all(corners.empty(), name, mesh);
}

void scan_binary_stl(std::istream& bytes, const std::string& name, Mesh& mesh) {
  std::array<char, stl_head_bytes> head{};
  bytes.read(head.data(), head.size());
  const auto triangles = number_in_stl<std::uint32_t>(head.data() + stl_title_bytes);
  std::array<char, stl_triangle_bytes> triangle{};
  while (bytes && mesh.faces.size() < triangles && bytes.read(triangle.data(), triangle.size())) {
    const auto first = static_cast<std::int64_t>(mesh.vertices.size());
    for (const char* p = triangle.data() + stl_normal_bytes; p != triangle.data() + 4 * stl_normal_bytes; p += stl_normal_bytes)
      mesh.vertices.push_back({number_in_stl<float>(p), number_in_stl<float>(p + 4), number_in_stl<float>(p + 8)});
    mesh.add_face(std::array{first, first + 1, first + 2});
  }
  require_all(bytes && mesh.faces.size() == triangles, name, mesh);
}

}  // namespace

Mesh scan_stl(const InputFile& file) {
  constexpr std::size_t enough_bytes = std::size_t{1} << 12;
  const bool is_text = is_text_stl(read_beginning(file, enough_bytes));
  Mesh mesh;
  mesh.places = "face";
  const std::unique_ptr<std::istream> stream = open_input(file);
  is_text ? scan_text_stl(*stream, file.name, mesh) : scan_binary_stl(*stream, file.name, mesh);
  mesh.forget_lone_object();
  return mesh;
}

}  // namespace farlod::ingest
