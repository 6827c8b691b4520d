// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/crowns_of_city.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "base/expects.hpp"
#include "package/crown_layout.hpp"

namespace farlod {
namespace {

/// In 65536ths of a right angle: turned by a right angle, a square is what it was.
std::uint16_t steps_of_turn(double turn_rad) {
  constexpr double right_angle_rad = std::numbers::pi / 2.0, steps = 65536.0;
  const double turned_rad = std::fmod(std::fmod(turn_rad, right_angle_rad) + right_angle_rad, right_angle_rad);
  return static_cast<std::uint16_t>(static_cast<std::uint32_t>(std::lround(turned_rad / right_angle_rad * steps)) & 0xFFFFU);
}

bool holds(const Grid& grid, Point2d p_grid) {
  const auto& [low, high] = grid.rectangle();
  return low.x <= p_grid.x && p_grid.x < high.x && low.y <= p_grid.y && p_grid.y < high.y;
}

/// −0 is 0, so that equal crowns have equal bytes.
float without_sign_of_0(double coordinate_m) { return static_cast<float>(coordinate_m) + 0.0F; }

auto key_of(const CrownsOfCity::OwnedCrown& c) {
  return std::tuple(c.cell, c.crown.y_m, c.crown.x_m, c.crown.bottom_m, c.crown.top_m, c.crown.half_width_m, c.crown.shape,
                    c.crown.foliage, c.crown.turn);
}

}  // namespace

void CrownsOfCity::add(Point2d axis_grid, double bottom_m, double top_m, double half_width_m, CrownShape shape, Foliage foliage,
                       double turn_rad_grid) {
  FARLOD_EXPECTS(std::isfinite(bottom_m) && std::isfinite(top_m) && std::isfinite(half_width_m) && std::isfinite(turn_rad_grid));
  FARLOD_EXPECTS(std::isfinite(axis_grid.x) && std::isfinite(axis_grid.y) && bottom_m < top_m && half_width_m > 0.0);
  const double low_m = bottom_m - height_origin_m_, high_m = top_m - height_origin_m_;
  if (!holds(grid_, axis_grid) || std::max({-low_m, high_m, half_width_m}) > package::farthest_crown_m) {
    ++outside_;
    return;
  }
  const Cell cell = grid_.cell_of(axis_grid);
  const Point2d p_cell = axis_grid - grid_.corner_of(cell);
  Crown crown{without_sign_of_0(p_cell.x),
              without_sign_of_0(p_cell.y),
              without_sign_of_0(low_m),
              without_sign_of_0(high_m),
              std::max(static_cast<float>(half_width_m), std::numeric_limits<float>::min()),
              shape,
              foliage,
              shape == CrownShape::prism ? steps_of_turn(turn_rad_grid) : std::uint16_t{0}};
  // Thinner than a float can tell: as thin as it can
  if (!(crown.bottom_m < crown.top_m)) crown.top_m = std::nextafter(crown.bottom_m, std::numeric_limits<float>::infinity());
  crowns_.push_back({grid_.cells.index_of(cell), crown});
  is_in_order_ = false;
}

const PagedArray<CrownsOfCity::OwnedCrown>& CrownsOfCity::in_order() {
  if (!is_in_order_)
    std::sort(crowns_.begin(), crowns_.end(), [](const OwnedCrown& a, const OwnedCrown& b) { return key_of(a) < key_of(b); });
  is_in_order_ = true;
  return crowns_;
}

}  // namespace farlod
