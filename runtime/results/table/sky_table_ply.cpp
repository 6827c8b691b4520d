// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_table_ply.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include "results/atomic_file.hpp"
#include "results/picture/picture.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

/// A comment ends with its line.
std::string in_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string header_of(std::size_t vertices, const TableFrame& frame) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  for (const auto& [name, value] : entries_of(frame.provenance)) text += "comment " + in_one_line(name + ": " + value) + "\n";
  if (frame.epsg) text += "comment crs: EPSG:" + std::to_string(*frame.epsg) + "\n";
  text += "element vertex " + std::to_string(vertices) + "\n";
  for (const char* name : {"x", "y", "z"}) text.append("property double ").append(name).append("\n");
  for (const char* name : {"nx", "ny", "nz"}) text.append("property float ").append(name).append("\n");
  for (const std::string& name : names_of(frame.columns)) text += "property float " + name + "\n";
  for (const char* name : {"red", "green", "blue"}) text.append("property uchar ").append(name).append("\n");
  return text + "end_header\n";
}

/// Number of bytes that are kept before they are written.
constexpr std::size_t bytes_in_memory = 1 << 16;

class Vertices {
 public:
  Vertices(std::ostream& out, std::size_t count, const TableFrame& frame) : out_(out), frame_(frame) {
    bytes_ = header_of(count, frame);
  }

  template <class Row>
  void add(const Point3d& p, Angle azimuth, Angle tilt, const Row& row) {
    for (const double number : {p.x, p.y, p.z}) append_bytes(bytes_, number);
    const double level = std::sin(tilt.radians()), bearing = azimuth.radians() - frame_.convergence.radians();
    for (const double number : {level * std::sin(bearing), level * std::cos(bearing), std::cos(tilt.radians())})
      append_bytes(bytes_, static_cast<float>(number));
    add_answer(row.svf);
    if (frame_.columns.bounds == BoundsColumns::yes) {
      add_answer(row.low);
      add_answer(row.high);
    }
    for (std::size_t k = 0; k < frame_.columns.further.size(); ++k) append_bytes(bytes_, further_value(row.further, k));
    const Colour colour = row.svf ? colour_of_svf(*row.svf) : nodata_colour;
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) append_bytes(bytes_, part);
    if (bytes_.size() >= bytes_in_memory) flush();
  }
  void flush() {
    out_ << bytes_;
    bytes_.clear();
  }

 private:
  void add_answer(const std::optional<double>& value) {
    append_bytes(bytes_, value ? static_cast<float>(*value) : std::numeric_limits<float>::quiet_NaN());
  }

  std::ostream& out_;
  const TableFrame& frame_;
  std::string bytes_;
};

bool has_vertex(const PointRow& row) { return row.has_place() && row.height_m; }

}  // namespace

void write_points_ply(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < rows.count; ++n) count += has_vertex(rows.row(n)) ? 1 : 0;
  write_atomically(path, [&](std::ostream& out) {
    Vertices vertices(out, count, frame);
    for (std::size_t n = 0; n < rows.count; ++n) {
      const PointRow row = rows.row(n);
      if (!has_vertex(row)) continue;
      vertices.add({row.p_projected.x, row.p_projected.y, *row.height_m}, Angle::degrees(row.azimuth_deg.value_or(0.0)),
                   Angle::degrees(row.tilt_deg.value_or(0.0)), row);
    }
    vertices.flush();
  });
}

void write_receivers_ply(SurfaceSpool& receivers, const TableFrame& frame, const std::filesystem::path& path) {
  write_atomically(path, [&](std::ostream& out) {
    Vertices vertices(out, receivers.size(), frame);
    receivers.for_each([&](const SurfacePoint& row) { vertices.add(row.p_projected, row.azimuth, row.tilt, row); });
    vertices.flush();
  });
}

}  // namespace farlod
