// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "generator/block_site.hpp"
#include "generator/plan_features.hpp"

namespace farlod {
namespace {

constexpr double park_share = 0.035, hall_share = 0.035, slab_share = 0.05;
/// Cities with fewer blocks have no park.
constexpr std::int64_t least_blocks_with_park = 9;
/// Closed street fronts need room for four corner buildings and those between them.
constexpr double least_edge_of_street_fronts_m = 48.0;
constexpr double fewest_urban = 0.1, mostly_urban = 0.28;

using BuildBlock = void (*)(BlockSite&);

/// Draws the kind of a block. A single random number decides, so that each kind has its share.
[[nodiscard]] BuildBlock draw_kind(BlockSite& site, const CityLayout& layout) {
  const double draw = site.random.unit();
  const double urban_draw = site.random.unit();
  const double u = site.urbanity;
  const bool roomy = std::min(site.width_m(), site.depth_m()) >= least_edge_of_street_fronts_m;
  if (draw < park_share && layout.block_count() >= least_blocks_with_park) return build_park;
  if (u >= UrbanField::core_urbanity) return build_core;
  if (site.settings.hillside) return roomy && urban_draw < 0.5 ? build_street_fronts : build_terraces;
  if (roomy && u < 0.35 && draw > 1.0 - hall_share) return build_halls;
  if (roomy && u > 0.06 && draw > 1.0 - hall_share - slab_share) return build_slabs;
  return roomy && urban_draw < smooth_step(fewest_urban, mostly_urban, u) ? build_street_fronts : build_detached_houses;
}

}  // namespace

Box2d plan_rectangle(const BuildingPlan& plan) {
  Box2d box;
  box.add(plan.lot.plan_from_lot({0.0, 0.0}));
  box.add(plan.lot.plan_from_lot({plan.width_m, plan.depth_m}));
  return box;
}

std::vector<Point2d> footprint_ring(const BuildingPlan& plan) {
  const double w = plan.width_m, d = plan.depth_m, t = plan.wing_m;
  if (plan.shape == FootprintShape::l_shape) return {{0, 0}, {w, 0}, {w, t}, {t, t}, {t, d}, {0, d}};
  return {{0, 0}, {w, 0}, {w, d}, {0, d}};
}

double base_m(const UrbanField& field, const BuildingPlan& plan) {
  const Box2d box = plan_rectangle(plan);
  const double south_m = std::min(field.ground_m(box.low), field.ground_m({box.high.x, box.low.y}));
  const double north_m = std::min(field.ground_m(box.high), field.ground_m({box.low.x, box.high.y}));
  return std::floor(std::min(south_m, north_m) * 100.0) / 100.0;
}

std::vector<BuildingPlan> plans_of_block(const CitySettings& settings, CityBlock block) {
  const CityLayout layout(settings);
  const Box2d rectangle = layout.rectangle(block);
  const Point2d centre = 0.5 * (rectangle.low + rectangle.high);
  BlockSite site{settings,
                 rectangle,
                 UrbanField(settings).urbanity(centre),
                 KeyedRandom({settings.seed, key_of(RandomStream::block), key_of(block.i), key_of(block.j)}),
                 {}};
  const BuildBlock build = draw_kind(site, layout);
  build(site);
  divide_into_parts(settings, block, site.plans);
  let_floors_project(settings, block, site.plans);
  return std::move(site.plans);
}

}  // namespace farlod
