// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "package/layout.hpp"
#include "package/package_reader.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/scene_builder.hpp"

// A wall to the north must appear where the format says, by our own reader and by OpenEXR alone: writer and reader could be wrong
// alike.

namespace farlod {
namespace {

constexpr std::uint32_t W = 16, H = 20;
constexpr double cell_m = 40.0, eye_m = 1.5;
constexpr double distance_m = 50.0, half_width_m = 21.0,
                 height_m = 30.0;  // of the wall, from the eye in the middle of cell (0, 0)
/// Distances lose all but 11 digits.
constexpr double half_precision = 1.0 / 2048;

class WallToTheNorth : public testing::Test {
 protected:
  WallToTheNorth() {
    scenes::SceneBuilder builder({0.5 * cell_m, 0.5 * cell_m, 0.0});
    builder.add_wall({-half_width_m, distance_m}, {half_width_m, distance_m}, 0.0, eye_m + height_m);
    builder.add_box({{-0.5, -0.5}, {0.5, 0.5}}, 0.0, 0.01);
    scenes::pack_city(builder.city(), scenes::grid_covering(builder.city(), {}, cell_m, 1, 4), folder_.path() / "wall.farlod",
                      scenes::box_maps(W, H));
  }

  /// Whether the format says that a texel of the map of cell (0, 0) is hidden.
  static bool is_hidden(std::uint32_t column, std::uint32_t row, double top) {
    if (column / W != static_cast<std::uint32_t>(BoxSide::north)) return false;
    const double across = 2.0 * (column % W + 0.5) / W - 1.0;
    return std::abs(across) * distance_m < half_width_m && top * (row + 0.5) / H < height_m / distance_m;
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(WallToTheNorth, IsInTheNorthernColumns) {
  const PackageReader package(folder_.path() / "wall.farlod");
  const BoxFarMap map = package.box_far_map({0, 0});
  const double top = map.shape().top;
  // The box is as high as the wall of the nearest cell could be, seen from the middle
  EXPECT_GE(top, height_m / distance_m);
  for (std::uint32_t row = 0; row < H; ++row)
    for (std::uint32_t column = 0; column < 4 * W; ++column) {
      const Point3d d = map.shape().direction_of({column, row});
      ASSERT_EQ(map.blocks(d), is_hidden(column, row, top)) << "row " << row << ", column " << column;
      if (!map.blocks(d)) continue;
      EXPECT_NEAR(map.distance_m(d), distance_m * norm(d), distance_m * norm(d) * half_precision);
    }
}

TEST_F(WallToTheNorth, OpenExrSeesItUpright) {
  const double top = PackageReader(folder_.path() / "wall.farlod").box_far_map({0, 0}).shape().top;
  Imf::TiledInputFile file((folder_.path() / "wall.farlod" / package::block_folder({0, 0}) / package::far_map_file).c_str());
  ASSERT_EQ(file.tileXSize(), 4 * W);
  ASSERT_EQ(file.tileYSize(), H);
  std::vector<float> sky(std::size_t{4} * W * H), distance(sky.size());
  Imf::FrameBuffer frame;
  frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, sky.data(), Imath::V2i(0, 0), 4 * W, H));
  frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, distance.data(), Imath::V2i(0, 0), 4 * W, H));
  file.setFrameBuffer(frame);
  file.readTile(0, 0);
  for (std::uint32_t pixel_row = 0; pixel_row < H; ++pixel_row)
    for (std::uint32_t column = 0; column < 4 * W; ++column) {
      const std::size_t n = std::size_t{pixel_row} * 4 * W + column;
      const bool hidden = is_hidden(column, H - 1 - pixel_row, top);
      ASSERT_EQ(sky[n], hidden ? 0.0F : 1.0F) << "pixel row " << pixel_row << ", column " << column;
      ASSERT_EQ(std::isinf(distance[n]), !hidden);
    }
}

}  // namespace
}  // namespace farlod
