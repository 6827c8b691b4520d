// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "receivers/receiver.hpp"

namespace farlod {

std::optional<float> standing_height_m(const VerticalProfile& profile, HeightAbove above, float height_m) {
  const std::optional<float> from_m = above == HeightAbove::ground            ? profile.ground_m()
                                      : above == HeightAbove::highest_surface ? profile.highest_m()
                                                                              : 0.0F;
  return from_m ? std::optional(*from_m + height_m) : std::nullopt;
}

std::optional<Point3f> stand(const VerticalProfile& profile, float x_cell, float y_cell, HeightAbove above, float height_m) {
  const auto z_m = standing_height_m(profile, above, height_m);
  if (!z_m || profile.is_buried(*z_m)) return std::nullopt;
  return Point3f{x_cell, y_cell, *z_m};
}

std::optional<Point3f> stand(const PointLocator& locator, float x_cell, float y_cell, HeightAbove above, float height_m) {
  return stand(locator.at(x_cell, y_cell), x_cell, y_cell, above, height_m);
}

}  // namespace farlod
