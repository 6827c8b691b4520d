// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/point.hpp"

namespace farlod::acceptance {

/// A square building. Its sides run along the streets of the town.
struct Block {
  std::string id;
  Point2d centre;  ///< town frame: metres from the town's middle, turned by `town_bearing`
  double edge_m, height_m;
};

/// EPSG:32632; its easting is that of the central meridian, whose longitude is 9° without any rounding.
inline constexpr Point2d town_middle{500000.0, 5500000.0};
inline constexpr Angle town_bearing = Angle::degrees(20.0);
inline constexpr const char* town_crs = "EPSG:32632";

/// Six by six blocks of 36 m along streets of 24 m, 8 to 20 m high, but for a tower of 90 m. 360 m from end to end.
inline constexpr double town_pitch_m = 60.0, town_edge_m = 36.0, town_half_m = 180.0, tower_height_m = 90.0;
[[nodiscard]] std::vector<Block> small_town();
[[nodiscard]] Block tower_of(const std::vector<Block>& town);

/// From the town's frame to EPSG:32632.
[[nodiscard]] Point2d p_projected(Point2d p_town);
/// "X,Y" or "X,Y,Z", for --at.
[[nodiscard]] std::string text_of(Point2d p);
[[nodiscard]] std::string text_of(const Point3d& p);

/// GeoJSON in EPSG:32632, coordinates in whole millimetres, heights in the field `height`.
[[nodiscard]] std::string footprints_geojson(const std::vector<Block>& blocks);

/// An ESRI ASCII grid around the town's middle, with pixel centres at whole steps from it. `height_m` gets metres from the
/// middle; -9999 is no data.
[[nodiscard]] std::string ascii_grid(const std::function<double(Point2d)>& height_m, double step_m = 10.0, double half_m = 500.0,
                                     Point2d middle = town_middle);

class WorkFolder;
/// Writes `town.geojson`, and `a.farlod` as `farlod-pack town.geojson -o a.farlod` with these settings makes it. A town of this
/// name is packed once for all tests; each gets a copy, which it may change.
void add_packed_town(const WorkFolder& folder, const std::string& name, const std::vector<Block>& blocks,
                     const std::string& settings = "");

/// A box of 20 m × 20 m × 10 m at the town's middle, as an OBJ file. It does not say its CRS.
[[nodiscard]] std::string box_obj();

}  // namespace farlod::acceptance
