// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/tile_glb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/expects.hpp"
#include "results/mesh/mesh_file.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/picture.hpp"
#include "results/value_text.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t ramp_texels = 256;

enum ComponentType : int { unsigned_byte = 5121, unsigned_int = 5125, single_float = 5126 };

/// The colours of view factors, from 0 at the left.
const std::string& ramp_png() {
  static const std::string png = [] {
    Picture ramp({ramp_texels, 1}, nodata_colour);
    for (std::size_t n = 0; n < ramp_texels; ++n)
      ramp.set({n, 0}, colour_of_svf(static_cast<double>(n) / static_cast<double>(ramp_texels - 1)));
    return png_of({.size = ramp.size(), .title = {}, .shapes = {Image{{}, ramp}}});
  }();
  return png;
}

/// The middle of the texel that has the colour of a value.
float ramp_place(float svf) {
  constexpr float texels = ramp_texels;
  return (svf * (texels - 1.0F) + 0.5F) / texels;
}

/// A glTF file in the making: its JSON, and the bytes that buffer views are of.
class GlbText {
 public:
  explicit GlbText(Json json) : json_(std::move(json)) {}

  Json& json() { return json_; }
  std::size_t add_view(const std::string& bytes) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
    bytes_ += bytes;
    return json_["bufferViews"].size() - 1;
  }
  /// An accessor for an attribute of vertices.
  std::size_t add_accessor(const std::vector<float>& numbers, const char* type, std::size_t components) {
    std::string bytes;
    for (const float number : numbers) append_bytes(bytes, number);
    const std::size_t view = add_view(bytes);
    json_["bufferViews"][view]["target"] = 34962;  // ARRAY_BUFFER
    json_["accessors"].push_back({{"bufferView", view},
                                  {"componentType", static_cast<int>(single_float)},
                                  {"type", type},
                                  {"count", numbers.size() / components}});
    return json_["accessors"].size() - 1;
  }
  [[nodiscard]] std::string file() && {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    if (!bytes_.empty()) json_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    return glb_head(json_.dump(), bytes_.size()) + bytes_;
  }

 private:
  Json json_;
  std::string bytes_;
};

/// Attributes of the vertices of a primitive: three for each facet.
struct Vertices {
  std::vector<float> positions, ramp_places, values, features;

  [[nodiscard]] bool empty() const { return positions.empty(); }
};

/// With the axes of glTF.
Vertices vertices_of(const TileSurfaces& surfaces, std::span<const float> svf, bool have_value, const Point3d& middle_local) {
  Vertices v;
  for (std::size_t n = 0; n < svf.size(); ++n) {
    if (std::isnan(svf[n]) == have_value) continue;
    const TileFacet& facet = surfaces.facets[n];
    for (const Point3d& corner : facet.corners_local) {
      const Point3d p = corner - middle_local;
      for (const double x : {p.x, p.z, -p.y}) v.positions.push_back(static_cast<float>(x));
      v.features.push_back(static_cast<float>(facet.feature));
      if (!have_value) continue;
      v.ramp_places.insert(v.ramp_places.end(), {ramp_place(svf[n]), 0.5F});
      v.values.push_back(svf[n]);
    }
  }
  return v;
}

void add_bounds(const std::vector<float>& positions, Json& accessor) {
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (std::size_t n = 0; n < positions.size(); ++n) {
    low[n % 3] = std::min(low[n % 3], positions[n]);
    high[n % 3] = std::max(high[n % 3], positions[n]);
  }
  accessor["min"] = low;
  accessor["max"] = high;
}

void add_primitive(const Vertices& v, std::size_t features, int material, GlbText& glb) {
  if (v.empty()) return;
  Json attributes;
  attributes["POSITION"] = glb.add_accessor(v.positions, "VEC3", 3);
  add_bounds(v.positions, glb.json()["accessors"].back());
  if (!v.values.empty()) {
    attributes["TEXCOORD_0"] = glb.add_accessor(v.ramp_places, "VEC2", 2);
    attributes["_SVF"] = glb.add_accessor(v.values, "SCALAR", 1);
  }
  attributes["_FEATURE_ID_0"] = glb.add_accessor(v.features, "SCALAR", 1);
  const Json feature_ids = {{"featureIds", {{{"featureCount", features}, {"attribute", 0}, {"propertyTable", 0}}}}};
  glb.json()["meshes"][0]["primitives"].push_back(
      {{"attributes", attributes}, {"material", material}, {"mode", 4}, {"extensions", {{"EXT_mesh_features", feature_ids}}}});
}

/// Texts one after the other, and where each begins.
Json add_texts(const std::vector<std::string>& texts, GlbText& glb) {
  std::string values, offsets;
  append_bytes(offsets, std::uint32_t{0});
  for (const std::string& text : texts) {
    values += text;
    append_bytes(offsets, static_cast<std::uint32_t>(values.size()));
  }
  // A buffer view has a byte at least
  const std::size_t of_values = glb.add_view(values.empty() ? std::string(1, '\0') : values);
  return {{"values", of_values}, {"stringOffsets", glb.add_view(offsets)}, {"stringOffsetType", "UINT32"}};
}

void add_property_table(const std::vector<TileFeature>& features, GlbText& glb) {
  std::vector<std::string> buildings, kinds;
  std::string surfaces;
  for (const TileFeature& feature : features) {
    buildings.push_back(feature.building);
    kinds.emplace_back(word_for(surface_kind_words, feature.kind));
    append_bytes(surfaces, feature.surface);
  }
  Json properties;
  properties["building"] = add_texts(buildings, glb);
  properties["surface"] = {{"values", glb.add_view(surfaces)}};
  properties["kind"] = add_texts(kinds, glb);
  const Json text = {{"type", "STRING"}, {"required", true}};
  const Json number = {{"type", "SCALAR"}, {"componentType", "UINT32"}, {"required", true}};
  const Json of_class = {{"properties", {{"building", text}, {"surface", number}, {"kind", text}}}};
  glb.json()["extensions"]["EXT_structural_metadata"] = {
      {"schema", {{"id", "farlod"}, {"classes", {{"surface", of_class}}}}},
      {"propertyTables", {{{"class", "surface"}, {"count", features.size()}, {"properties", properties}}}}};
}

Json materials() {
  const auto grey = [](std::uint8_t channel) { return std::pow(channel / 255.0, 2.2); };
  const Json unlit = {{"KHR_materials_unlit", Json::object()}};
  const Json with_value = {{"name", "svf"},
                           {"doubleSided", true},
                           {"extensions", unlit},
                           {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}};
  const Json without = {
      {"name", "no data"},
      {"doubleSided", true},
      {"extensions", unlit},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {grey(nodata_colour.red), grey(nodata_colour.green), grey(nodata_colour.blue), 1.0}},
        {"metallicFactor", 0}}}};
  return {with_value, without};
}

Point3d middle_of(const TileSurfaces& surfaces) {
  const Point3d first = surfaces.facets.front().corners_local.front();
  Point3d low = first, high = first;
  for (const TileFacet& facet : surfaces.facets)
    for (const Point3d& c : facet.corners_local) {
      low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
      high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
    }
  return 0.5 * (low + high);
}

}  // namespace

std::string glb_of(const TileSurfaces& surfaces, std::span<const float> svf) {
  FARLOD_EXPECTS(svf.size() == surfaces.facets.size());
  GlbText glb({{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {Json::object()}}});
  if (surfaces.facets.empty()) return std::move(glb).file();
  const Point3d middle = middle_of(surfaces);
  Json& json = glb.json();
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0}, {"translation", {middle.x, middle.z, -middle.y}}}};
  json["extensionsUsed"] = {"KHR_materials_unlit", "EXT_mesh_features", "EXT_structural_metadata"};
  json["materials"] = materials();
  json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  json["samplers"] = {{{"magFilter", 9729}, {"minFilter", 9729}, {"wrapS", 33071}, {"wrapT", 33071}}};
  json["images"] = {{{"bufferView", glb.add_view(ramp_png())}, {"mimeType", "image/png"}}};
  json["meshes"] = {{{"primitives", Json::array()}}};
  add_primitive(vertices_of(surfaces, svf, true, middle), surfaces.features.size(), 0, glb);
  add_primitive(vertices_of(surfaces, svf, false, middle), surfaces.features.size(), 1, glb);
  add_property_table(surfaces.features, glb);
  return std::move(glb).file();
}

}  // namespace farlod
