// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <istream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "ingest/mesh/mesh_scanners.hpp"

namespace farlod::ingest {
namespace {

using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

/// What ends the reading of a GLB file: why.
struct GlbRefusal {
  std::string why;
};

std::uint64_t whole_number(const json& value) {
  constexpr std::uint64_t most = std::uint64_t{1} << 40;  // sums and products of two of them, as sizes are, do not overflow
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= most) throw GlbRefusal{"a number of its JSON is wrong"};
  return value.get<std::uint64_t>();
}

std::uint64_t whole_number_of(const json& object, const char* key, std::uint64_t otherwise) {
  return object.contains(key) ? whole_number(object[key]) : otherwise;
}

/// The element of a list of the file that a member of an object names.
const json& referred(const json& file, const char* list, const json& index) {
  const std::uint64_t n = whole_number(index);
  if (!file.contains(list) || n >= file[list].size()) throw GlbRefusal{std::string("one of its ") + list + " is missing"};
  return file[list][n];
}

template <std::size_t n>
std::array<double, n> numbers_of(const json& object, const char* key, const std::array<double, n>& otherwise) {
  return object.contains(key) ? object[key].get<std::array<double, n>>() : otherwise;
}

/// p ↦ (x, y, z)·p + origin.
struct Affine {
  Point3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

  [[nodiscard]] Point3d turned(const Point3d& p) const { return p.x * x + p.y * y + p.z * z; }
  [[nodiscard]] Point3d operator()(const Point3d& p) const { return turned(p) + origin; }
  [[nodiscard]] Affine operator()(const Affine& a) const { return {turned(a.x), turned(a.y), turned(a.z), (*this)(a.origin)}; }
};

/// Section 3.5.3 of glTF 2.0: a matrix, column by column, or a scale, a rotation (quaternion) and a translation.
Affine transform_of(const json& node) {
  if (node.contains("matrix")) {
    const auto m = node["matrix"].get<std::array<double, 16>>();
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  const auto [x, y, z, w] = numbers_of<4>(node, "rotation", {0, 0, 0, 1});
  const auto s = numbers_of<3>(node, "scale", {1, 1, 1}), t = numbers_of<3>(node, "translation", {0, 0, 0});
  return {s[0] * Point3d{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          s[1] * Point3d{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          s[2] * Point3d{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
          {t[0], t[1], t[2]}};
}

/// A type of numbers of an accessor. Normalized ones count from 0 or -1 to 1 (KHR_mesh_quantization).
struct GlbType {
  std::uint64_t code, bytes;
  double most;
  double (*value)(const char* bytes);
};

template <class Number>
double value_of_glb(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

constexpr std::array glb_types{
    GlbType{5120, 1, 127.0, value_of_glb<std::int8_t>},          GlbType{5121, 1, 255.0, value_of_glb<std::uint8_t>},
    GlbType{5122, 2, 32767.0, value_of_glb<std::int16_t>},       GlbType{5123, 2, 65535.0, value_of_glb<std::uint16_t>},
    GlbType{5125, 4, 4294967295.0, value_of_glb<std::uint32_t>}, GlbType{5126, 4, 1.0, value_of_glb<float>}};

/// Numbers that lie in the binary part, in rows of equal length.
struct GlbRows {
  std::uint64_t count = 0, step = 0;
  const char* first = nullptr;
  GlbType type{};
  bool is_normalized = false;

  [[nodiscard]] double number(std::uint64_t row, std::uint64_t column) const {
    const double value = type.value(first + row * step + column * type.bytes);
    return is_normalized ? std::max(value / type.most, -1.0) : value;
  }
  [[nodiscard]] Point3d point(std::uint64_t row) const { return {number(row, 0), number(row, 1), number(row, 2)}; }
};

class GlbScanner {
 public:
  GlbScanner(const json& file, std::string_view binary) : file_(file), binary_(binary) {
    mesh_.places = "face";
    mesh_.up = UpAxis::y;
  }

  Mesh scan() {
    require_plain_triangles();
    if (const auto rtc = file_.value("/extensions/CESIUM_RTC/center"_json_pointer, json()); !rtc.is_null()) {
      const auto centre = rtc.get<std::array<double, 3>>();
      mesh_.origin = {centre[0], centre[1], centre[2]};
    }
    was_met_.assign(file_.value("nodes", json::array()).size(), false);
    for (const json& root : roots()) visit_below(root);
    require_map_coordinates();
    mesh_.forget_lone_object();
    return std::move(mesh_);
  }

 private:
  void require_plain_triangles() const {
    for (const json& name : file_.value("extensionsRequired", json::array()))
      for (const char* other : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"})
        if (name == other) throw GlbRefusal{std::string("it needs ") + other + ": export it without that, as Blender does"};
  }

  /// Tiles of 3D Tiles lie about the middle of the Earth, in several levels of detail.
  void require_map_coordinates() const {
    constexpr double least_radius_m = 6.3e6, largest_radius_m = 6.4e6, above_all_m = 1e4;
    if (mesh_.vertices.empty()) return;
    const Point3d& q = mesh_.vertices[0];
    const Point3d p = mesh_.origin + Point3d{q.x, -q.z, q.y};
    if (least_radius_m < norm(p) && norm(p) < largest_radius_m && std::abs(p.z) > above_all_m)
      throw GlbRefusal{"it lies in geocentric coordinates, as tiles of 3D Tiles do: take the data that these were made of"};
  }

  /// The nodes of the scene; of a file without scenes, all that are no child.
  [[nodiscard]] json roots() const {
    if (file_.contains("scenes")) return referred(file_, "scenes", file_.value("scene", json(0U))).value("nodes", json::array());
    std::vector<bool> is_child(was_met_.size(), false);
    for (const json& node : file_.value("nodes", json::array()))
      for (const json& child : node.value("children", json::array()))
        if (const std::uint64_t n = whole_number(child); n < is_child.size()) is_child[n] = true;
    json roots = json::array();
    for (std::size_t n = 0; n < is_child.size(); ++n)
      if (!is_child[n]) roots.push_back(n);
    return roots;
  }

  /// The file may be damaged: a node that is met again is left out.
  void visit_below(const json& root) {
    std::vector<std::pair<std::uint64_t, Affine>> waiting{{whole_number(root), Affine()}};
    while (!waiting.empty()) {
      const auto [n, above] = waiting.back();
      waiting.pop_back();
      const json& node = referred(file_, "nodes", n);
      if (was_met_[n]) continue;
      was_met_[n] = true;
      const Affine placed = above(transform_of(node));
      if (node.contains("mesh")) add_mesh(node, placed);
      const json children = node.value("children", json::array());
      for (auto child = children.rbegin(); child != children.rend(); ++child) waiting.emplace_back(whole_number(*child), placed);
    }
  }

  void add_mesh(const json& node, const Affine& placed) {
    const json& mesh = referred(file_, "meshes", node["mesh"]);
    mesh_.objects.push_back(node.value("name", mesh.value("name", "")));
    for (const json& primitive : mesh.at("primitives")) {
      const bool has_material = primitive.contains("material");
      mesh_.materials.push_back(has_material ? referred(file_, "materials", primitive["material"]).value("name", "") : "");
      add_primitive(primitive, placed);
    }
  }

  void add_primitive(const json& primitive, const Affine& placed) {
    constexpr std::uint64_t triangles = 4, strip = 5, fan = 6;
    const std::uint64_t mode = whole_number_of(primitive, "mode", triangles);
    if (mode < triangles || mode > fan) {
      if (mesh_.unread_elements++ == 0) mesh_.first_unread_line = mesh_.faces.size() + 1;
      return;
    }
    const GlbRows points = rows_of(primitive.at("attributes").at("POSITION"), 3);
    const bool has_indices = primitive.contains("indices");
    const GlbRows indices = has_indices ? rows_of(primitive["indices"], 1) : GlbRows{.count = points.count};
    // A small file may name a large mesh many times
    const std::uint64_t most = binary_.size() + 10'000'000;
    if (mesh_.vertices.size() + points.count > most || mesh_.corners.size() + 3 * indices.count > 3 * most)
      throw GlbRefusal{"it repeats its meshes more often than a city does"};
    const auto first = static_cast<std::int64_t>(mesh_.vertices.size());
    for (std::uint64_t n = 0; n < points.count; ++n) mesh_.vertices.push_back(placed(points.point(n)));
    // An index that leads out of the primitive leads into none
    const auto corner = [&](std::uint64_t n) {
      const double index = has_indices ? indices.number(n, 0) : static_cast<double>(n);
      return 0.0 <= index && index < static_cast<double>(points.count) ? first + static_cast<std::int64_t>(index) : -1;
    };
    for (std::uint64_t n = 2; n < indices.count; n += mode == triangles ? 3 : 1) {
      const bool is_odd = mode == strip && n % 2 == 1;
      const std::uint64_t a = mode == fan ? 0 : n - 2;
      mesh_.add_face(std::array{corner(is_odd ? n - 1 : a), corner(is_odd ? a : n - 1), corner(n)});
    }
  }

  [[nodiscard]] GlbRows rows_of(const json& index, std::uint64_t columns) const {
    const json& accessor = referred(file_, "accessors", index);
    if (accessor.contains("sparse") || !accessor.contains("bufferView")) throw GlbRefusal{"it has sparse accessors"};
    const json& view = referred(file_, "bufferViews", accessor["bufferView"]);
    const json& buffer = referred(file_, "buffers", view.at("buffer"));
    if (buffer.contains("uri") || view["buffer"] != 0) throw GlbRefusal{"its coordinates lie in another file"};
    const std::uint64_t code = whole_number(accessor.at("componentType"));
    const auto* const type = std::ranges::find(glb_types, code, &GlbType::code);
    if (type == glb_types.end()) throw GlbRefusal{"it has numbers of an unknown type"};
    const std::uint64_t row_bytes = columns * type->bytes, step = whole_number_of(view, "byteStride", row_bytes);
    const std::uint64_t count = whole_number(accessor.at("count")), from = whole_number_of(accessor, "byteOffset", 0);
    const std::uint64_t begin = from + whole_number_of(view, "byteOffset", 0);
    if (count > 0 && (step == 0 || count > binary_.size() || begin + row_bytes > binary_.size() ||
                      (count - 1) > (binary_.size() - begin - row_bytes) / step))
      throw GlbRefusal{"it is cut short"};
    return {count, step, binary_.data() + (count > 0 ? begin : 0), *type, accessor.value("normalized", false)};
  }

  const json& file_;
  std::string_view binary_;
  std::vector<bool> was_met_;
  Mesh mesh_;
};

/// The next part of a file, and its kind; shorter than it says where the file ends. Empty after the last.
std::optional<std::pair<std::string, std::string>> next_part(std::istream& stream) {
  std::array<char, 8> head{};
  if (!stream.read(head.data(), head.size())) return std::nullopt;
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, head.data(), sizeof bytes);
  constexpr std::size_t piece_bytes = std::size_t{1} << 20;
  std::string part;
  while (stream && part.size() < bytes) {
    const std::size_t known = part.size();
    part.resize(known + std::min(piece_bytes, bytes - known));
    stream.read(part.data() + known, static_cast<std::streamsize>(part.size() - known));
    part.resize(known + static_cast<std::size_t>(stream.gcount()));
  }
  return std::pair(std::string(head.data() + 4, 3), std::move(part));
}

}  // namespace

Mesh scan_glb(const InputFile& file) {
  constexpr std::streamsize head_bytes = 12;
  const std::unique_ptr<std::istream> stream = open_input(file);
  stream->ignore(head_bytes);
  std::string head, binary;
  while (auto part = next_part(*stream)) {
    if (part->first == "JSO")
      head = std::move(part->second);
    else if (part->first == "BIN")
      binary = std::move(part->second);
  }
  try {
    return GlbScanner(json::parse(head), binary).scan();
  } catch (const GlbRefusal& refusal) {
    throw InputError(file.name + " cannot be read as GLB: " + refusal.why + ".");
  } catch (const json::exception&) {
    throw InputError(file.name + " cannot be read as GLB: its JSON is not as glTF 2.0 has it.");
  }
}

}  // namespace farlod::ingest
