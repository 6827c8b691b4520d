// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "farlod/plan_view.hpp"
#include "results/picture/drawing.hpp"
#include "results/picture/raster_preview.hpp"

namespace farlod {

/// The grid of a package as lines on a map.
struct GridLines {
  std::array<Point2d, 4> corners_projected{};  ///< from the south-west corner of the grid frame, counter-clockwise
  std::int64_t columns = 0, rows = 0;          ///< of cells
  double cell_edge_m = 0.0;
};

/// Places that a file names, such as a report of problems.
struct MarkedPlaces {
  std::string file;  ///< as captions call it; empty: there is none
  std::vector<Point2d> places_projected;
};

/// What a picture of a whole city shows.
struct CityScenery {
  RasterPlan plan;  ///< its pixels are those of the map
  PlanHeights heights;
  GridLines grid;
  MarkedPlaces marked;
  std::string package, crs, place;       ///< as the captions call them; no place where it is not known
  bool is_surface_model = false;         ///< its buildings are a part of its only surface
  std::vector<float> crown_tops_m = {};  ///< above sea level, at the same pixels, NaN where there is no crown; empty: no trees
};

/// What the colours of a city stand for.
struct CityScale {
  double top_m = 0.0;        ///< above the ground: what has the darkest colour, as has all above it; 0 without any building
  double highest_m = 0.0;    ///< the highest pixel, above its ground
  std::size_t highest_at{};  ///< its number
  double low_m = 0.0, high_m = 0.0;  ///< elevations of the ground
};

/// A few towers do not decide: the scale ends where one building pixel in a hundred is higher, at the next multiple of 5 m.
[[nodiscard]] CityScale scale_of(const PlanHeights& heights);

/// The colour of a pixel: that of a building's height, or that of the ground before it is lit, or white where there is neither.
[[nodiscard]] Colour colour_in_city(double ground_m, double highest_m, const CityScale& scale);

/// The colour of crowns, which is that of a picture of the sky: neither a height nor an elevation has it.
[[nodiscard]] Colour colour_of_crowns();

/// Where the parts of the picture lie.
[[nodiscard]] PreviewLayout city_layout(const RasterPlan& plan);

/// The city from above, by the highest surface at each pixel: buildings by their height above the ground, the ground by its
/// elevation, crowns, both lit from the north-west, the grid, and places.
[[nodiscard]] Drawing draw_city(const CityScenery& scenery);

}  // namespace farlod
