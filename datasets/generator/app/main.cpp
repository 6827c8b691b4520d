// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "console/named_files.hpp"
#include "console/run_program.hpp"
#include "farlod/box.hpp"
#include "farlod/error.hpp"
#include "generator/app/city_options.hpp"
#include "generator/city_layout.hpp"
#include "generator/city_settings.hpp"
#include "generator/city_writer.hpp"
#include "generator/generated_building.hpp"
#include "generator/generated_city.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {
namespace {

/// A tree of a generated city. All lengths are in whole millimetres.
struct GeneratedTree {
  PlanPointMm place{};  ///< city frame
  std::int64_t height_mm = 0, crown_mm = 0, trunk_mm = 0;
  bool is_evergreen = false;
};

/// Writes trees as points of GeoJSON in the CRS of the city, with `height`, `crown_diameter`, `trunk_height` and `leaf_cycle`.
/// The file gets its name at the end. All members throw OutputError.
class TreeWriter {
 public:
  TreeWriter(const std::filesystem::path& path, const CityHeader& header);
  void add(const GeneratedTree& tree);
  void end();

 private:
  CityHeader header_;
  CityTextFile file_;
  bool is_first_ = true;
};

/// Along a kerb: from tree to tree at least, and what may be added to it; from the kerb towards the street.
constexpr double kerb_spacing_m = 6.0, kerb_slack_m = 6.0, from_kerb_m = 1.0;
/// A yard has about one place for a tree in so many square metres; in how many of them one stands, in yards and in parks.
constexpr double yard_place_m2 = 120.0, yard_place_share = 0.35, park_place_share = 0.9, from_house_m = 2.0;
/// A block with fewer buildings is a park.
constexpr std::size_t least_buildings = 3;

double share_of_side(int side) { return side % 2 == 1 ? 0.9 : 0.4; }  // sides 1 and 3 lie along avenues

GeneratedTree tree_at(Point2d p_plan, KeyedRandom& random, const PlanRotation& rotation) {
  const double height_m = on_plan_grid_m(random.between(5.0, 18.0));
  const Point2d p_city = rotation.city_from_plan(p_plan);
  GeneratedTree tree;
  tree.place = {millimetres(p_city.x), millimetres(p_city.y)};
  tree.height_mm = millimetres(height_m);
  tree.crown_mm = millimetres(on_plan_grid_m(height_m * random.between(0.35, 0.75)));
  tree.trunk_mm = millimetres(on_plan_grid_m(height_m * random.between(0.15, 0.35)));
  tree.is_evergreen = random.chance(0.15);
  return tree;
}

/// The rectangle around each footprint, in the plan, widened.
std::vector<Box2d> houses_in_plan(std::span<const GeneratedBuilding> buildings, const PlanRotation& rotation) {
  std::vector<Box2d> houses;
  for (const GeneratedBuilding& building : buildings) {
    Box2d box;
    for (const PointMm& p : building.vertices)
      box.add(rotation.plan_from_city({1e-3 * static_cast<double>(p.x), 1e-3 * static_cast<double>(p.y)}));
    const Point2d margin{from_house_m, from_house_m};
    houses.push_back({box.low - margin, box.high + margin});
  }
  return houses;
}

bool is_in_any(const std::vector<Box2d>& boxes, Point2d p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box2d& box) {
    return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
  });
}

/// The trees along the kerbs of a block, and in its yards or its park. They depend on nothing but the settings and the block.
///   (1) along avenues stands a row, along other streets some; none is nearer than 6 m to another one of its side
///   (2) in yards, none stands in the footprint of a building, or within 2 m of the rectangle around it
std::vector<GeneratedTree> trees_of_block(const CitySettings& settings, CityBlock block,
                                          std::span<const GeneratedBuilding> buildings) {
  const PlanRotation rotation(settings.rotation_deg);
  const Box2d rectangle = CityLayout(settings).rectangle(block);
  KeyedRandom random({settings.seed, key_of(RandomStream::trees), key_of(block.i), key_of(block.j)});
  std::vector<GeneratedTree> trees;
  for (int side = 0; side < 4; ++side) {
    const LotFrame frame = side_frame(rectangle, side);
    for (double u = kerb_spacing_m; u < side_length_m(rectangle, side) - kerb_spacing_m;
         u += kerb_spacing_m + kerb_slack_m * random.unit())
      if (random.chance(share_of_side(side)))
        trees.push_back(tree_at(frame.plan_from_lot({on_plan_grid_m(u), -from_kerb_m}), random, rotation));
  }
  const std::vector<Box2d> houses = houses_in_plan(buildings, rotation);
  const double share = buildings.size() < least_buildings ? park_place_share : yard_place_share;
  const Point2d size = rectangle.high - rectangle.low;
  const auto places = static_cast<int>(size.x * size.y / yard_place_m2);
  for (int n = 0; n < places; ++n) {
    const Point2d p{on_plan_grid_m(random.between(rectangle.low.x, rectangle.high.x)),
                    on_plan_grid_m(random.between(rectangle.low.y, rectangle.high.y))};
    if (random.chance(share) && !is_in_any(houses, p)) trees.push_back(tree_at(p, random, rotation));
  }
  return trees;
}

TreeWriter::TreeWriter(const std::filesystem::path& path, const CityHeader& header) : header_(header), file_(path) {
  // As footprints: RFC 7946 removed the member `crs`, and GDAL reads it
  fmt::format_to(std::back_inserter(file_.text()),
                 R"({{"type":"FeatureCollection","name":"{} trees",)"
                 "\n"
                 R"("crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{}"}}}},)"
                 "\n\"features\":[",
                 header_.name, header_.epsg);
}

void TreeWriter::add(const GeneratedTree& tree) {
  std::string& text = file_.text();
  text += is_first_ ? "\n" : ",\n";
  is_first_ = false;
  text += R"({"type":"Feature","properties":{"height":)";
  append_metres(text, tree.height_mm);
  text += R"(,"crown_diameter":)";
  append_metres(text, tree.crown_mm);
  text += R"(,"trunk_height":)";
  append_metres(text, tree.trunk_mm);
  text += tree.is_evergreen ? R"(,"leaf_cycle":"evergreen")" : R"(,"leaf_cycle":"deciduous")";
  text += R"(},"geometry":{"type":"Point","coordinates":[)";
  append_metres(text, header_.centre_easting_mm + tree.place[0]);
  text += ',';
  append_metres(text, header_.centre_northing_mm + tree.place[1]);
  text += "]}}";
  file_.drain();
}

void TreeWriter::end() {
  file_.text() += "\n]}\n";
  file_.commit();
}

void count(const GeneratedBuilding& building, CityCounts& counts) {
  ++counts.buildings;
  counts.polygons += building.facets.size();
  counts.towers += building.kind == BuildingKind::tower ? 1 : 0;
  counts.bridges += building.kind == BuildingKind::bridge ? 1 : 0;
  counts.tallest_m = std::max(counts.tallest_m, building.height_m());
}

/// Writes the trees of one block after the other, as its buildings are done.
class TreesBeside {
 public:
  TreesBeside(const CityOptions& options, const CityHeader& header) : settings_(options.settings), layout_(options.settings) {
    if (!options.trees.empty()) writer_.emplace(options.trees, header);
  }
  void add(const GeneratedBuilding& building) {
    if (writer_) of_block_.push_back(building);
  }
  /// `done`: blocks so far.
  void end_block(std::int64_t done) {
    if (!writer_) return;
    for (const GeneratedTree& tree : trees_of_block(settings_, layout_.block_at(done - 1), of_block_)) {
      writer_->add(tree);
      ++count_;
    }
    of_block_.clear();
  }
  std::uint64_t end() {
    if (writer_) writer_->end();
    return count_;
  }

 private:
  const CitySettings& settings_;
  CityLayout layout_;
  std::optional<TreeWriter> writer_;
  std::vector<GeneratedBuilding> of_block_;
  std::uint64_t count_ = 0;
};

[[nodiscard]] CityCounts write_city(const CityOptions& options) {
  CityCounts counts;
  const auto start = std::chrono::steady_clock::now();
  CityHeader header = header_of(options.settings, options.output);
  header.obj_from_centre = options.obj_from_centre;
  TreesBeside trees(options, header);
  const auto writer = make_city_writer(options.format, options.output, header);
  ProgressLine progress("Building", options.run.verbosity);
  const auto blocks = static_cast<std::size_t>(CityLayout(options.settings).block_count());
  writer->begin();
  visit_city(options.settings, {.building =
                                    [&](const GeneratedBuilding& building) {
                                      writer->add(building);
                                      trees.add(building);
                                      count(building, counts);
                                    },
                                .block_done =
                                    [&](std::int64_t done) {
                                      trees.end_block(done);
                                      progress.update(static_cast<std::size_t>(done), blocks);
                                    }});
  counts.trees = trees.end();
  counts.bytes = writer->end();
  counts.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return counts;
}

void print_counts(const CityOptions& options, const CityCounts& counts) {
  if (options.run.verbosity == Verbosity::quiet) return;
  if (counts.trees > 0) fmt::print("{}: {} trees\n", options.trees.string(), counts.trees);
  fmt::print("{}: {} buildings, {} polygons, tallest {:.1f} m, {:.1f} MiB, {:.1f} s\n", options.output.string(), counts.buildings,
             counts.polygons, counts.tallest_m, static_cast<double>(counts.bytes) / 1048576.0, counts.seconds);
}

int run(const CityOptions& options) {
  const std::array<NamedOutput, 3> outputs{
      {{{"-o", options.output}}, {{"--trees", options.trees}}, {{"--summary", options.run.summary_file}}}};
  require_writable(outputs, {});
  const CityCounts counts = write_city(options);
  write_text(options.run.summary_file, city_summary_json(options, counts));
  print_counts(options, counts);
  return exit_done;
}

}  // namespace

}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  return run_program({.name = "farlod-city", .when_out_of_memory = "Make a smaller city."}, [&] {
    const ParsedCityOptions parsed = parse_city_options(argc, argv);
    return parsed.options ? run(*parsed.options) : parsed.exit_code;
  });
}
