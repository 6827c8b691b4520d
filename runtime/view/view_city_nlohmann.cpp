// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_city.hpp"

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "farlod/error.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "farlod/version.hpp"
#include "results/picture/picture.hpp"
#include "results/value_text.hpp"
#include "view/canopy_columns.hpp"
#include "view/tile_glb.hpp"
#include "view/tile_surfaces.hpp"

namespace farlod {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_bytes_of_tiles = std::size_t{256} << 20U;
constexpr std::size_t tiles_made_ahead = 16;
constexpr const char* of_glb = "model/gltf-binary";
constexpr const char* of_bytes = "application/octet-stream";

/// A request that makes no sense, or asks for what is not there.
struct BadRequest {
  int status;
  std::string what;
};

Json json_of(const Point3d& p) { return {p.x, p.y, p.z}; }
Json json_of(Point2d p) { return {p.x, p.y}; }
Json json_of(Colour c) { return {c.red, c.green, c.blue}; }
Json json_of(CellPlace c) { return {c.i, c.j}; }
Json json_of(const CellRectangle& c) {
  return {{"i_begin", c.i_begin}, {"j_begin", c.j_begin}, {"i_end", c.i_end}, {"j_end", c.j_end}};
}
Json number_or_null(float value) { return std::isnan(value) ? Json(nullptr) : Json(value); }

ViewReply json_reply(const Json& json) { return {.body = json.dump() + "\n"}; }
ViewReply error_reply(int status, const std::string& what) {
  return {.status = status, .body = Json{{"error", what}}.dump() + "\n"};
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

template <class Number>
std::optional<Number> wanted(const ViewQuery& query, std::string_view name) {
  const auto found = query.find(name);
  if (found == query.end()) return std::nullopt;
  const std::optional<Number> number = number_in<Number>(found->second);
  if (!number) throw BadRequest{400, std::string(name) + " is not a number"};
  return number;
}

template <class Number>
Number needed(const ViewQuery& query, std::string_view name) {
  const std::optional<Number> number = wanted<Number>(query, name);
  if (!number) throw BadRequest{400, std::string(name) + " is missing"};
  return *number;
}

/// The numbers between a head and a tail with separators between them: `tiles/3/4/5.glb`.
std::optional<TileAddress> address_in(std::string_view path, std::string_view head, char separator, std::string_view tail) {
  if (!path.starts_with(head) || !path.ends_with(tail) || path.size() < head.size() + tail.size()) return std::nullopt;
  std::string_view rest = path.substr(head.size(), path.size() - head.size() - tail.size());
  std::array<std::uint32_t, 3> numbers{};
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const std::size_t end = n + 1 < numbers.size() ? rest.find(separator) : rest.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = number_in<std::uint32_t>(rest.substr(0, end));
    if (!number) return std::nullopt;
    numbers[n] = *number;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return TileAddress{numbers[0], numbers[1], numbers[2]};
}

Json grid_json(const ViewFrame& frame, const PackageDescription& d) {
  return {{"bearing_deg", frame.grid_axes.bearing.degrees()},
          {"convergence_deg", frame.convergence.degrees()},
          {"cell_edge_m", frame.cell_edge_m},
          {"neighborhood", d.neighborhood},
          {"i_begin", frame.cells.i_begin},
          {"j_begin", frame.cells.j_begin},
          {"i_end", frame.cells.i_end},
          {"j_end", frame.cells.j_end},
          {"corner_m", json_of(frame.corner_local)}};
}

Json colours_json() {
  constexpr int steps = 256;
  Json colours = Json::array();
  for (int n = 0; n < steps; ++n) colours.push_back(json_of(colour_of_svf(n / (steps - 1.0))));
  return colours;
}

Json results_json(const std::vector<ResultLayer>& results) {
  Json list = Json::array();
  for (const ResultLayer& layer : results) {
    Json json = {{"name", layer.name},         {"form", name_of(layer.form)},
                 {"quantity", layer.quantity}, {"url", "results/" + std::to_string(list.size())},
                 {"count", layer.count},       {"range", layer.range()},
                 {"unit", layer.unit()}};
    if (layer.form == ResultForm::raster) {
      json["width"] = layer.width;
      json["height"] = layer.height;
      json["local_from_pixel"] = layer.local_from_pixel;
    }
    list.push_back(std::move(json));
  }
  return list;
}

/// The cell of a place, where there is one.
Json cell_of(const ViewFrame& frame, const Point3d& p_projected) {
  const Point2d p = frame.grid_from_local(horizontal(frame.local_from_projected(p_projected)));
  const CellPlace cell{frame.cells.i_begin + static_cast<std::int32_t>(std::floor(p.x / frame.cell_edge_m)),
                       frame.cells.j_begin + static_cast<std::int32_t>(std::floor(p.y / frame.cell_edge_m))};
  return frame.cells.contains(cell) ? json_of(cell) : Json(nullptr);
}

Json far_json(const ViewFrame& frame, const std::optional<FarView>& far) {
  if (!far || far->horizon.estimate.empty()) return nullptr;
  Json edges = Json::array();
  for (const FarEdge& edge : far->horizon.edges) {
    const Point3d a = frame.local_from_projected(edge.a_projected), b = frame.local_from_projected(edge.b_projected);
    edges.push_back({a.x, a.y, a.z, b.x, b.y, b.z});
  }
  return {{"eye_m", json_of(frame.local_from_projected(far->eye_projected))},
          {"first_azimuth_deg", far->horizon.first_azimuth.degrees()},
          {"low", far->horizon.low},
          {"estimate", far->horizon.estimate},
          {"high", far->horizon.high},
          {"edges", edges}};
}

Json near_json(const CellContents& contents) {
  Json cells = Json::array();
  for (const NeighborCell& near : contents.near_cells)
    cells.push_back({{"cell", json_of(near.cell)}, {"triangles", near.triangles}});
  return cells;
}

Json corners_json(const ViewFrame& frame, const CellContents& contents) {
  Json corners = Json::array();
  for (const Point2d& corner : contents.corners_projected)
    corners.push_back(json_of(corner - horizontal(frame.origin_projected)));
  return corners;
}

}  // namespace

std::shared_ptr<const std::string> TileCache::get(const TileAddress& tile, const std::function<std::string()>& make) {
  std::unique_lock lock(mutex_);
  nobody_makes_it_.wait(lock, [&] { return !being_made_.contains(tile); });
  const auto found = entries_.find(tile);
  if (found != entries_.end()) {
    uses_.splice(uses_.begin(), uses_, found->second.use);
    return found->second.glb;
  }
  being_made_.insert(tile);
  lock.unlock();
  std::shared_ptr<const std::string> made;
  std::exception_ptr failure;
  try {
    made = std::make_shared<const std::string>(make());
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  being_made_.erase(tile);
  nobody_makes_it_.notify_all();
  if (failure) std::rethrow_exception(failure);
  keep(tile, made);
  return made;
}

void TileCache::keep(const TileAddress& tile, const std::shared_ptr<const std::string>& made) {
  uses_.push_front(tile);
  entries_[tile] = {made, uses_.begin()};
  bytes_ += made->size();
  let_go();
}

void TileCache::let_go() {
  while (bytes_ > most_bytes_ && uses_.size() > 1) {
    const auto oldest = entries_.find(uses_.back());
    bytes_ -= oldest->second.glb->size();
    entries_.erase(oldest);
    uses_.pop_back();
  }
}

ViewCity::ViewCity(const Package& package, std::string name, const ViewFrame& frame, const EcefFromLocal& ecef_from_local,
                   std::vector<ResultLayer> results)
    : package_(package),
      name_(std::move(name)),
      ecef_from_local_(ecef_from_local),
      frame_(frame),
      tree_(frame_),
      results_(std::move(results)),
      has_crowns_(inventory_of(package).crowns.all() > 0),
      tiles_(most_bytes_of_tiles) {}

ViewReply ViewCity::answer(std::string_view path, const ViewQuery& query) const {
  try {
    return answer_or_throw(path, query);
  } catch (const BadRequest& bad) {
    return error_reply(bad.status, bad.what);
  } catch (const InvalidArgument& error) {
    return error_reply(400, error.what());
  } catch (const std::exception& error) {
    return error_reply(500, error.what());
  }
}

ViewReply ViewCity::answer_or_throw(std::string_view path, const ViewQuery& query) const {
  if (path == "view.json") return {.body = description(true)};
  if (path == "at") return at(query);
  if (path == "hemisphere") return hemisphere(query);
  if (path == "cell") return cell(query);
  if (path == "crowns" && has_crowns_) return {.type = of_bytes, .body = crowns()};
  if (std::optional<ViewReply> file = file_of_tileset(path)) return *std::move(file);
  if (std::optional<ViewReply> file = file_of_result(path)) return *std::move(file);
  throw BadRequest{404, "There is nothing at this address."};
}

std::optional<ViewReply> ViewCity::file_of_tileset(std::string_view path) const {
  if (path == "tileset.json") return ViewReply{.body = tileset(tree_)};
  if (const auto root = address_in(path, "subtrees/", '.', ".subtree")) {
    if (root->level % levels_of_subtree != 0 || !tree_.contains(*root)) throw BadRequest{404, "There is no such subtree."};
    return ViewReply{.type = of_bytes, .body = subtree_file(tree_, *root)};
  }
  const auto tile_address = address_in(path, "tiles/", '/', ".glb");
  if (!tile_address) return std::nullopt;
  if (!tree_.has_content(*tile_address)) throw BadRequest{404, "There is no such tile."};
  tile_was_asked_for_ = true;
  return ViewReply{.type = of_glb, .body = *tiles_.get(*tile_address, [&] { return tile(*tile_address); })};
}

std::optional<ViewReply> ViewCity::file_of_result(std::string_view path) const {
  constexpr std::string_view folder = "results/", ending = ".json";
  if (!path.starts_with(folder)) return std::nullopt;
  path.remove_prefix(folder.size());
  const bool is_labels = path.ends_with(ending);
  if (is_labels) path.remove_suffix(ending.size());
  const auto number = number_in<std::size_t>(path);
  if (!number || *number >= results_.size()) throw BadRequest{404, "There is no such result."};
  const ResultLayer& layer = results_[*number];
  return is_labels ? ViewReply{.body = labels_json(layer)} : ViewReply{.type = of_bytes, .body = layer.bytes()};
}

const std::string& ViewCity::crowns() const {
  std::call_once(crowns_are_made_, [&] { crowns_ = canopy_columns_of(package_, frame_).bytes(); });
  return crowns_;
}

std::string ViewCity::tile(const TileAddress& address) const {
  const TileSurfaces surfaces = surfaces_of(package_, frame_, tree_, address);
  const bool is_large = address.level < tree_.level_of_cells();
  return glb_of(surfaces, values_of(package_, frame_, surfaces, is_large ? azimuths_of_larger_tiles : azimuths_of_cells));
}

void ViewCity::make_first_tiles(const std::stop_token& stop) const {
  for (const TileAddress& address : tree_.largest_tiles_from_the_middle(tiles_made_ahead)) {
    if (stop.stop_requested() || tile_was_asked_for_) return;
    try {
      (void)tiles_.get(address, [&] { return tile(address); });
    } catch (const std::exception&) {
      return;
    }
  }
}

std::string ViewCity::tileset(const TileTree& tree) const { return tileset_json(frame_, tree, ecef_from_local_); }

std::string ViewCity::description(bool can_answer) const {
  const PackageDescription& d = package_.description();
  const Json json = {{"software", std::string("farlod-view ") + software_version},
                     {"name", name_},
                     {"crs", d.crs_name},
                     {"epsg", d.epsg ? Json(*d.epsg) : Json(nullptr)},
                     {"origin_m", json_of(frame_.origin_projected)},
                     {"can_answer", can_answer},
                     {"grid", grid_json(frame_, d)},
                     {"heights_m", {frame_.low_local, frame_.high_local}},
                     {"counts",
                      {{"buildings", d.buildings},
                       {"polygons", d.polygons},
                       {"triangles", d.triangles},
                       {"crowns", inventory_of(package_).crowns.all()}}},
                     {"far_map_kind", d.far_map_kind},
                     {"receiver_height_m", Placing{}.height_m},
                     {"colours", colours_json()},
                     {"nodata_colour", json_of(nodata_colour)},
                     {"results", results_json(results_)},
                     {"tileset", "tileset.json"}};
  return json.dump() + "\n";
}

ViewReply ViewCity::at(const ViewQuery& query) const {
  const auto start = std::chrono::steady_clock::now();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double x = needed<double>(query, "x"), y = needed<double>(query, "y");
  const double z = wanted<double>(query, "z").value_or(none);
  const Angle azimuth = Angle::degrees(wanted<double>(query, "azimuth").value_or(0.0));
  const Angle tilt = Angle::degrees(wanted<double>(query, "tilt").value_or(0.0));
  EvaluationSettings settings;
  settings.bounds = package_.description().far_map_kind == "horizon";
  const PointAnswers answer = evaluate_points(package_, {{&x, 1}, {&y, 1}, {&z, 1}, {&azimuth, 1}, {&tilt, 1}}, {}, settings);
  const float svf = answer.svf.front();
  const auto bound = [](const std::vector<float>& values) {
    return values.empty() ? Json(nullptr) : number_or_null(values.front());
  };
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return json_reply({{"svf", number_or_null(svf)},
                     {"text", std::isnan(svf) ? Json(nullptr) : Json(svf_decimal(svf))},
                     {"low", bound(answer.low)},
                     {"high", bound(answer.high)},
                     {"x_m", x},
                     {"y_m", y},
                     {"z_m", std::isnan(answer.height_m.front()) ? Json(nullptr) : Json(answer.height_m.front())},
                     {"cell", cell_of(frame_, {x, y, 0.0})},
                     {"seconds", seconds}});
}

ViewReply ViewCity::hemisphere(const ViewQuery& query) const {
  const Point2d place{needed<double>(query, "x"), needed<double>(query, "y")};
  const std::optional<Hemisphere> sky = look_up(package_, place, wanted<double>(query, "z"));
  if (!sky) return {.status = 204, .type = of_bytes};
  std::string body;
  for (const SkyPart part : sky->parts) body.push_back(static_cast<char>(part));
  body.append(reinterpret_cast<const char*>(sky->horizon.data()), sky->horizon.size() * sizeof(float));
  return {.type = of_bytes, .body = std::move(body)};
}

ViewReply ViewCity::cell(const ViewQuery& query) const {
  const CellPlace place{needed<std::int32_t>(query, "i"), needed<std::int32_t>(query, "j")};
  if (!frame_.cells.contains(place)) throw BadRequest{404, "There is no such cell."};
  const CellContents c = inspect_cell(package_, place);
  const auto above_origin = [&](const std::optional<double>& z) {
    return z ? Json(*z - frame_.origin_projected.z) : Json(nullptr);
  };
  return json_reply({{"cell", json_of(place)},
                     {"corners_m", corners_json(frame_, c)},
                     {"triangles", c.triangles},
                     {"vertices", c.vertices},
                     {"buildings", c.buildings},
                     {"grounded_edges", c.grounded_edges},
                     {"overhang_edges", c.overhang_edges},
                     {"tile_bytes", c.tile_bytes},
                     {"far_map_bytes", c.far_map_bytes},
                     {"explicit_edges", c.explicit_edges},
                     {"neighborhood", json_of(c.neighborhood)},
                     {"near_cells", near_json(c)},
                     {"low_m", above_origin(c.low_m)},
                     {"high_m", above_origin(c.high_m)},
                     {"far", far_json(frame_, far_view_of(package_, place))}});
}

std::string labels_json(const ResultLayer& layer) {
  return Json(layer.labels).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace farlod
