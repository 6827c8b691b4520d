// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/city_trees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "farlod/box.hpp"
#include "generator/keyed_random.hpp"

namespace farlod {
namespace {

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

}  // namespace

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

}  // namespace farlod
