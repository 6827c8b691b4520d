// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/crowns_everywhere.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>

namespace farlod::plausibility {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What is told of a raster of 40 × 40 cells of 2 m in a grid, of which the northern half lies beyond it. `height_m`
/// gives the height of the crown in a column and row.
template <class Height>
std::string told_of_canopy(const Height& height_m) {
  CanopyRaster canopy;
  canopy.source = "canopy.tif";
  canopy.first = {1.0, 79.0};
  canopy.column_step = {2.0, 0.0};
  canopy.row_step = {0.0, -2.0};
  canopy.columns = canopy.rows = 40;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) canopy.top_m.push_back(height_m(column, row));
  Grid grid;
  grid.cell_edge_m = 40.0;
  grid.cells = {0, 0, 2, 1};
  Report report;
  report_crowns_everywhere(canopy, grid, report);
  std::string details;
  for (const Problem& p : report.problems())
    details += std::to_string(static_cast<int>(p.code)) + " " + p.source + ": " + p.detail;
  return details;
}

TEST(CrownsEverywhere, AreToldOfASurfaceModelInThePlaceOfACanopy) {
  EXPECT_THAT(told_of_canopy([](int column, int) { return 49.0F + static_cast<float>(column); }),
              AllOf(HasSubstr("212 canopy.tif: 800 of 800 cells of the canopy have a crown, 49.0 to 88.0 m high"),
                    HasSubstr("--canopy-absolute"), HasSubstr("a surface model in the place of the canopy")));
}

TEST(CrownsEverywhere, AreNotToldOfAParkWithGaps) {
  EXPECT_EQ(told_of_canopy([](int column, int row) { return column % 4 == 0 && row % 4 == 0 ? 0.0F : 12.0F; }), "");
  EXPECT_EQ(told_of_canopy([](int, int) { return 0.3F; }), "") << "grass";
  constexpr float no_data = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(told_of_canopy([](int column, int) { return column < 20 ? no_data : 12.0F; }), "") << "no data between crowns";
}

}  // namespace
}  // namespace farlod::plausibility
