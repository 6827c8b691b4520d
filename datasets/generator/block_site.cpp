// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/block_site.hpp"

#include <algorithm>
#include <cmath>

namespace farlod {
namespace {

constexpr double storey_m = 3.1;
constexpr double lowest_arcaded_wall_m = 9.0, arcade_depth_m = 3.0, arcade_height_m = 4.2;

}  // namespace

std::vector<LotSpan> cut_into_lots(KeyedRandom& random, LotSpan side, double narrowest_m, double widest_m) {
  const double mean_m = 0.5 * (narrowest_m + widest_m);
  const int count = std::max(1, static_cast<int>(std::lround(side.width_m / mean_m)));
  const double even_m = side.width_m / count;
  const double shift_m = std::min(0.5 * (widest_m - narrowest_m), 0.4 * even_m);
  std::vector<LotSpan> lots;
  double begin_m = side.begin_m;
  for (int k = 1; k <= count; ++k) {
    const double draw = random.between(-0.5, 0.5);
    const double end_m = on_plan_grid_m(side.begin_m + k * even_m + (k < count ? draw * shift_m : 0.0));
    lots.push_back({begin_m, on_plan_grid_m(end_m - begin_m)});
    begin_m = end_m;
  }
  return lots;
}

LotFrame moved(const LotFrame& lot, double u_m, double v_m) {
  const Point2d corner = lot.plan_from_lot({on_plan_grid_m(u_m), on_plan_grid_m(v_m)});
  return {{on_plan_grid_m(corner.x), on_plan_grid_m(corner.y)}, lot.side};
}

void set_storeys(BlockSite& site, BuildingPlan& plan, int storeys) {
  const double parapet_m = site.random.between(0.2, 1.1);
  plan.storeys = storeys;
  plan.wall_m = on_plan_grid_m(site.settings.height_scale * (storeys * storey_m + parapet_m));
}

void set_pitched_roof(BlockSite& site, BuildingPlan& plan, double gabled_share) {
  const bool gabled = site.random.chance(gabled_share);
  const double pitch = site.random.between(0.6, 1.0);
  const double span_m = plan.shape == FootprintShape::l_shape ? plan.wing_m : std::min(plan.width_m, plan.depth_m);
  // An L has its own way of joining two ridges, with gables at both ends
  plan.roof = gabled || plan.shape == FootprintShape::l_shape ? RoofShape::gabled : RoofShape::hipped;
  plan.roof_rise_m = on_plan_grid_m(0.5 * span_m * pitch);
}

void maybe_add_arcade(BlockSite& site, BuildingPlan& plan, double share) {
  const bool drawn = site.random.chance(share);
  const bool possible =
      plan.shape == FootprintShape::rectangle && plan.wall_m >= lowest_arcaded_wall_m && plan.depth_m >= 3.0 * arcade_depth_m;
  if (!site.settings.overhangs || !drawn || !possible) return;
  plan.arcade_depth_m = arcade_depth_m;
  plan.arcade_height_m = arcade_height_m;
  plan.roof = RoofShape::flat;
  plan.roof_rise_m = 0.0;
}

}  // namespace farlod
