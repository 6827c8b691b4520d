// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "farlod/error.hpp"
#include "ingest/cityjson/cityjson_reader.hpp"

namespace farlod::ingest {
namespace {

using nlohmann::json;

constexpr double unreadable_number = std::numeric_limits<double>::quiet_NaN();

/// No city is nested this deep. nlohmann copies and deletes trees by recursion, which would overflow the stack.
constexpr std::size_t deepest_nesting = 500;

/// A member of an object; null where it has none, or is no object.
const json& member_of(const json& object, const char* name) {
  static const json nothing;
  const auto found = object.find(name);
  return found == object.end() ? nothing : *found;
}

double lod_from(const json& geometry) {
  const json& lod = member_of(geometry, "lod");
  if (lod.is_null()) return 0.0;
  if (lod.is_number()) return lod.get<double>();
  const auto& text = lod.get_ref<const std::string&>();
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::isfinite(value) ? value : 0.0;
}

std::vector<SurfaceKind> kinds_from(const json& geometry, std::vector<std::string>& ids) {
  std::vector<SurfaceKind> kinds;
  for (const json& surface : member_of(member_of(geometry, "semantics"), "surfaces")) {
    kinds.push_back(kind_of_surface_name(surface.value("type", "")));
    const json& id = member_of(surface, "id");
    ids.push_back(id.is_string() ? id.get<std::string>() : std::string());
  }
  return kinds;
}

/// Refuses numbers that are not whole: nlohmann would cut off their fraction, and its conversion is undefined for large ones.
std::int64_t whole_number_from(const json& number) {
  if (!number.is_number_integer()) throw JsonFlaw("the number of a vertex or a template is not whole");
  return number.get<std::int64_t>();
}

std::vector<std::vector<std::int64_t>> rings_from(const json& surface) {
  std::vector<std::vector<std::int64_t>> rings;
  for (const json& ring : surface.get_ref<const json::array_t&>()) {
    std::vector<std::int64_t>& rows = rings.emplace_back();
    for (const json& row : ring.get_ref<const json::array_t&>()) rows.push_back(whole_number_from(row));
  }
  return rings;
}

/// Collects the polygons of nested boundaries. `values` has the numbers of the semantics of the surfaces in the same nesting; it
/// may be null at any depth.
void add_polygons(const json& boundaries, const json& values, int nesting, const std::vector<SurfaceKind>& kinds,
                  std::vector<CityJsonPolygon>& polygons) {
  static const json nothing;
  if (!boundaries.is_array()) throw JsonFlaw("the boundaries of a geometry are not nested as its type asks for");
  const auto& list = boundaries.get_ref<const json::array_t&>();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const json& value = values.is_array() && i < values.size() ? values[i] : nothing;
    if (nesting > 0) {
      add_polygons(list[i], value, nesting - 1, kinds, polygons);
      continue;
    }
    const auto row = value.is_number_unsigned() ? value.get<std::size_t>() : kinds.size();
    CityJsonPolygon& polygon = polygons.emplace_back(CityJsonPolygon{rings_from(list[i])});
    if (row >= kinds.size()) continue;
    polygon.kind = kinds[row];
    polygon.semantics = static_cast<std::uint32_t>(row);
  }
}

CityJsonGeometry geometry_from(const json& j) {
  CityJsonGeometry geometry{j.at("type").get<std::string>(), lod_from(j), {}, std::nullopt};
  if (geometry.type == "GeometryInstance") {
    geometry.instance = {static_cast<std::size_t>(whole_number_from(j.at("template"))),
                         j.at("transformationMatrix").get<std::array<double, 16>>(), whole_number_from(j.at("boundaries").at(0))};
  } else if (const std::optional<int> nesting = nesting_of(geometry.type)) {
    // The numbers of the semantics of the surfaces are nested like the boundaries
    const json& semantics = member_of(member_of(j, "semantics"), "values");
    add_polygons(j.at("boundaries"), semantics, *nesting, kinds_from(j, geometry.semantic_ids), geometry.polygons);
  }
  return geometry;
}

CityJsonObject object_from(std::string id, const json& j) {
  CityJsonObject object;
  object.id = std::move(id);
  try {
    object.type = j.at("type").get<std::string>();
    object.parents = j.value("parents", std::vector<std::string>());
    object.children = j.value("children", std::vector<std::string>());
    if (const json& height = member_of(member_of(j, "attributes"), "measuredHeight"); height.is_number())
      object.measured_height_m = height.get<double>();
    for (const json& geometry : member_of(j, "geometry")) object.geometries.push_back(geometry_from(geometry));
  } catch (const std::exception& flaw) {
    object.malformed = plain(flaw.what());
    object.geometries.clear();
  }
  return object;
}

/// The CRS as the versions of CityJSON and its predecessors write it: a URL, a URN, "EPSG:n" or n alone, {"epsg": n}, or a name
/// as in GeoJSON. Empty when it is none of these.
std::string crs_definition_of(const json& crs) {
  if (crs.is_string()) return crs.get<std::string>();
  if (crs.is_number_unsigned()) return "EPSG:" + std::to_string(crs.get<std::uint64_t>());
  if (!crs.is_object()) return {};
  if (const json& code = member_of(crs, "epsg"); !code.is_null()) return crs_definition_of(code);
  return crs_definition_of(member_of(member_of(crs, "properties"), "name"));
}

std::string reference_system_of(const json& file) {
  for (const json* holder : {&member_of(file, "metadata"), &file})
    for (const char* key : {"referenceSystem", "crs"})
      if (std::string definition = crs_definition_of(member_of(*holder, key)); !definition.empty()) return definition;
  return {};
}

/// One JSON text of CityJSON: a file, or a line of a sequence. The transform of the file is not applied to the vertices yet.
struct CityJsonText {
  std::vector<CityJsonObject> objects;
  std::vector<Point3d> vertices;
  json rest = json::object();  ///< the other members, by name
};

/// Collects vertices and objects while a CityJSON text is parsed. A tree of the whole text would need ten times the memory of the
/// vertices, and would lose the order of the objects and those with a repeated id.
class CityJsonCollector : public nlohmann::json_sax<json> {
 public:
  /// `text`: what is parsed. `has_places`: attributes can be inserted into its file.
  CityJsonCollector(const PlacedBuffer& text, bool has_places) : buffer_(text), has_places_(has_places) {}

  bool null() override { return take(json()); }
  bool boolean(bool value) override { return take(json(value)); }
  bool number_integer(number_integer_t value) override { return take_number(value); }
  bool number_unsigned(number_unsigned_t value) override { return take_number(value); }
  bool number_float(number_float_t value, const string_t&) override { return take_number(value); }
  bool string(string_t& value) override { return take(json(std::move(value))); }
  bool binary(binary_t&) override { return true; }

  bool start_object(std::size_t) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (depth_ == 1) begin_member(name);
    if (depth_ == 2 && stack_.empty()) object_ = name;
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& flaw) override {
    is_json_ = false;
    return fail(plain(flaw.what()));
  }

  [[nodiscard]] const std::string& flaw() const { return flaw_; }
  [[nodiscard]] bool is_json() const { return is_json_; }
  [[nodiscard]] CityJsonText text() { return std::move(text_); }

 private:
  /// The member of the outermost object that is being parsed.
  enum class Member { vertices, objects, other };

  bool in_vertices() const { return depth_ >= 2 && kind_ == Member::vertices; }
  bool among_objects() const { return depth_ == 2 && kind_ == Member::objects; }
  bool finds_places() const { return has_places_ && kind_ == Member::objects; }

  void begin_member(const std::string& name) {
    member_ = name;
    kind_ = name == "vertices" ? Member::vertices : name == "CityObjects" ? Member::objects : Member::other;
  }

  template <class Number>
  bool take_number(Number value) {
    if (!in_vertices()) return take(json(value), buffer_.at() - 1);  // a number ends where the next byte is none of it
    vertex_.push_back(static_cast<double>(value));
    return true;
  }

  bool take(json value) { return take(std::move(value), buffer_.at()); }

  /// `at`: behind its last byte.
  bool take(json value, std::uint64_t at) {
    if (depth_ == 0) return fail("it is no JSON object");
    if (finds_places()) places_.value(key_, at);
    if (in_vertices())
      vertex_.push_back(unreadable_number);
    else if (!stack_.empty())
      attach(std::move(value));
    else
      complete(std::move(value));
    return true;
  }

  bool open(json container) {
    if (depth_ == 0 && !container.is_object()) return fail("it is no JSON object");
    if (depth_ == deepest_nesting) return fail("it is nested deeper than any city");
    const bool is_ours = depth_ == 0 || in_vertices() || (depth_ == 1 && kind_ != Member::other);
    ++depth_;
    if (in_vertices() && depth_ == 3) vertex_.clear();
    if (is_ours) return true;
    if (finds_places()) places_.open(key_, container.is_object(), buffer_.at());
    if (stack_.empty()) {
      tree_ = std::move(container);
      stack_.push_back(&tree_);
    } else {
      stack_.push_back(attach(std::move(container)));
    }
    return true;
  }

  bool close() {
    if (in_vertices() && depth_ == 3) add_vertex();
    --depth_;
    if (stack_.empty()) return true;
    if (finds_places()) places_.close(buffer_.at());
    stack_.pop_back();
    if (stack_.empty()) complete(std::move(tree_));
    return true;
  }

  json* attach(json value) {
    json& top = *stack_.back();
    if (top.is_array()) return &top.emplace_back(std::move(value));
    return &(top[key_] = std::move(value));
  }

  void complete(json value) {
    if (among_objects()) {
      CityJsonObject& object = text_.objects.emplace_back(object_from(object_, value));
      if (has_places_) object.places = places_.take();
    } else if (depth_ == 1 && member_ != "appearance") {
      text_.rest[member_] = std::move(value);
    }
  }

  void add_vertex() {
    const bool is_point = vertex_.size() == 3;
    text_.vertices.push_back(is_point ? Point3d{vertex_[0], vertex_[1], vertex_[2]}
                                      : Point3d{unreadable_number, unreadable_number, unreadable_number});
  }

  bool fail(std::string what) {
    flaw_ = std::move(what);
    return false;
  }

  const PlacedBuffer& buffer_;
  bool has_places_;
  CityJsonPlaceFinder places_;
  CityJsonText text_;
  std::string member_, object_, key_, flaw_;
  Member kind_ = Member::other;
  bool is_json_ = true;
  std::size_t depth_ = 0;
  std::vector<double> vertex_;
  json tree_;
  std::vector<json*> stack_;
};

class CityJsonFile {
 public:
  CityJsonFile(const InputFile& file, LodChoice lod, CityModelBuilder& builder)
      : file_(file), has_places_(has_byte_places(file)), lod_(lod), builder_(builder) {}

  /// The first text has the CRS and the transform. In a sequence, the features follow, one a line. Without one, the first text is
  /// a feature, and they are in another file.
  void read() {
    const std::unique_ptr<std::istream> source = open_input(file_);
    PlacedBuffer buffer(*source);
    std::istream stream(&buffer);
    stream.exceptions(std::ios::badbit);  // so that what the source throws passes through
    CityJsonText first = parse(buffer, Behind::may_follow);
    const bool is_feature = member_of(first.rest, "type") == "CityJSONFeature";
    is_feature ? take_header_of_another_file() : take_header(first);
    add_to_model(first);
    stream >> std::ws;
    const bool is_over = stream.peek() == std::istream::traits_type::eof();
    if (!is_over || is_feature) format = package::CityFileFormat::cityjsonseq;
    if (is_over) return;
    if (stream.peek() != '{') throw SyntaxFlaw("there is more text behind its end");
    std::string line;
    std::uint64_t begin = buffer.at();
    for (number_ = 2; std::getline(stream, line); ++number_, begin = buffer.at())
      if (line.find_first_not_of(" \t\r") != line.npos) take_feature(line, begin);
  }

  /// Nothing where attributes cannot be inserted.
  [[nodiscard]] std::optional<PlacedFile> placed() const {
    if (!has_places_) return std::nullopt;
    return PlacedFile{file_.on_disk, format, CityJsonPlaceFinder::forms()};
  }

  std::string reference_system;
  package::CityFileFormat format = package::CityFileFormat::cityjson;
  ObjectAccount account;

 private:
  /// Whether another text may follow.
  enum class Behind { may_follow, nothing };

  /// Parses the first JSON text in a buffer, and leaves the buffer at its end.
  CityJsonText parse(PlacedBuffer& buffer, Behind behind) {
    std::istream text(&buffer);
    CityJsonCollector collector(buffer, has_places_);
    if (json::sax_parse(text, &collector, json::input_format_t::json, behind == Behind::nothing)) return collector.text();
    if (collector.is_json()) throw JsonFlaw(collector.flaw());
    throw SyntaxFlaw(collector.flaw());
  }

  void take_header(const CityJsonText& text) {
    if (member_of(text.rest, "type") != "CityJSON") throw JsonFlaw("it does not say \"type\": \"CityJSON\"");
    if (text.rest.contains("transform")) {
      scale_ = text.rest.at("transform").at("scale").get<std::array<double, 3>>();
      translate_ = text.rest.at("transform").at("translate").get<std::array<double, 3>>();
    }
    reference_system = reference_system_of(text.rest);
    if (text.rest.contains("geometry-templates")) take_templates(text.rest.at("geometry-templates"));
  }

  void take_header_of_another_file() {
    const std::unique_ptr<std::istream> source = open_input(metadata_of_feature(file_));
    PlacedBuffer buffer(*source);
    take_header(parse(buffer, Behind::nothing));
  }

  void take_templates(const json& j) {
    for (const json& geometry : j.at("templates")) templates_.geometries.push_back(geometry_from(geometry));
    for (const auto& p : j.at("vertices-templates").get<std::vector<std::array<double, 3>>>())
      templates_.vertices.push_back({p[0], p[1], p[2]});
  }

  /// A line that is not JSON is reported. The other features of the city are read.
  void take_feature(std::string& line, std::uint64_t begin) {
    try {
      PlacedBuffer buffer(line, begin);
      CityJsonText text = parse(buffer, Behind::nothing);
      if (member_of(text.rest, "type") != "CityJSONFeature") throw JsonFlaw("it is no CityJSONFeature");
      add_to_model(text);
    } catch (const JsonFlaw& flaw) {
      builder_.add_problem_at("line " + std::to_string(number_), ProblemCode::malformed_feature, flaw.what());
    }
  }

  void add_to_model(CityJsonText& text) {
    for (Point3d& p : text.vertices)
      p = {p.x * scale_[0] + translate_[0], p.y * scale_[1] + translate_[1], p.z * scale_[2] + translate_[2]};
    add_objects(text.objects, text.vertices, templates_, lod_, builder_, account);
  }

  const InputFile& file_;
  bool has_places_;
  LodChoice lod_;
  CityModelBuilder& builder_;
  std::size_t number_ = 1;
  std::array<double, 3> scale_{1.0, 1.0, 1.0}, translate_{};
  CityJsonTemplates templates_;
};

}  // namespace

SourceCity read_cityjson(const InputFile& file, LodChoice lod, Report& report) {
  CityModelBuilder builder(file.name, report);
  CityJsonFile reader(file, lod, builder);
  try {
    reader.read();
  } catch (const SyntaxFlaw& flaw) {
    throw InputError(file.name + " is not JSON: " + flaw.what() + ". Was it cut short? The validator cjval tells more.");
  } catch (const JsonFlaw& flaw) {
    throw InputError(file.name + " is not CityJSON: " + flaw.what() + ". The validator cjval tells more.");
  } catch (const json::exception& flaw) {
    throw InputError(file.name + " is not CityJSON: " + plain(flaw.what()) + ". The validator cjval tells more.");
  }
  if (builder.buildings_met() == 0 && reader.account.relief_points.empty())
    throw InputError(file.name + " holds no Building, Bridge, Tunnel, OtherConstruction or TINRelief" +
                     said(reader.account.skipped) + ". Is it another theme of the city model?");
  return {.source = file.name,
          .crs = {reader.reference_system, false, false},
          .city = builder.take_city(),
          .relief_points = std::move(reader.account.relief_points),
          .skipped = std::move(reader.account.skipped),
          .placed = reader.placed()};
}

}  // namespace farlod::ingest
