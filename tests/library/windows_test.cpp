// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/raster.hpp"
#include "tests/library/packed_sample.hpp"

namespace farlod::library {
namespace {

class Windows : public testing::Test {
 protected:
  static void SetUpTestSuite() { sample_ = new PackedSample; }
  static void TearDownTestSuite() {
    delete sample_;
    sample_ = nullptr;
  }
  static inline PackedSample* sample_ = nullptr;

  Package package_{sample_->folder()};
  /// A step that is no sum of powers of two, so that coordinates are rounded.
  RasterPlan plan_ = plan_raster(package_, 1.7);
};

/// Pixels whose bits are not those of the whole raster.
std::size_t differences(const std::vector<float>& window, const RasterWindow& place, const std::vector<float>& whole,
                        std::size_t whole_columns) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < place.rows; ++row)
    for (std::size_t column = 0; column < place.columns; ++column) {
      const float ours = window[row * place.columns + column];
      const float theirs = whole[(place.row + row) * whole_columns + place.column + column];
      count += std::bit_cast<std::uint32_t>(ours) != std::bit_cast<std::uint32_t>(theirs) ? 1 : 0;
    }
  return count;
}

TEST_F(Windows, HaveThePixelsOfTheWholeToTheBit) {
  EvaluationSettings settings;
  settings.bounds = true;
  settings.further.hidden = true;
  const Raster whole = evaluate_raster(package_, plan_, {}, settings);
  std::size_t receivers = 0, no_data = 0;
  constexpr std::size_t columns = 23, rows = 31;
  for (std::size_t row = 0; row < plan_.rows; row += rows)
    for (std::size_t column = 0; column < plan_.columns; column += columns) {
      const RasterWindow place{column, row, std::min(columns, plan_.columns - column), std::min(rows, plan_.rows - row)};
      const Raster window = evaluate_window(package_, plan_, place, {}, settings);
      EXPECT_EQ(differences(window.svf, place, whole.svf, plan_.columns), 0U) << column << ", " << row;
      EXPECT_EQ(differences(window.low, place, whole.low, plan_.columns), 0U);
      EXPECT_EQ(differences(window.high, place, whole.high, plan_.columns), 0U);
      for (std::size_t band = 0; band < whole.further.size(); ++band)
        EXPECT_EQ(differences(window.further[band], place, whole.further[band], plan_.columns), 0U);
      receivers += window.summary.receivers;
      no_data += window.summary.no_data;
    }
  EXPECT_EQ(receivers, whole.summary.receivers);
  EXPECT_EQ(no_data, whole.summary.no_data + whole.summary.beyond_grid);
}

TEST_F(Windows, TellTheirOwnPlanAndFigures) {
  const RasterWindow place{10, 20, 30, 5};
  const Raster window = evaluate_window(package_, plan_, place);
  EXPECT_EQ(window.plan.columns, place.columns);
  EXPECT_EQ(window.plan.rows, place.rows);
  EXPECT_NEAR(window.plan.centre_m(0, 0).x, plan_.centre_m(place.column, place.row).x, 1e-9);
  EXPECT_NEAR(window.plan.centre_m(0, 0).y, plan_.centre_m(place.column, place.row).y, 1e-9);
  ASSERT_TRUE(window.summary.svf_max);
  EXPECT_EQ(*window.summary.svf_max,
            static_cast<double>(*std::ranges::max_element(window.svf, [](float a, float b) { return std::isnan(a) || a < b; })));
}

TEST_F(Windows, BeyondTheRasterAreRefused) {
  const std::size_t columns = plan_.columns, rows = plan_.rows, most = static_cast<std::size_t>(-1);
  for (const RasterWindow& wrong :
       {RasterWindow{0, 0, 0, 1}, RasterWindow{0, 0, 1, 0}, RasterWindow{columns, 0, 1, 1}, RasterWindow{0, rows, 1, 1},
        RasterWindow{1, 0, columns, 1}, RasterWindow{0, 1, 1, rows}, RasterWindow{1, 1, most, 1}, RasterWindow{1, 1, 1, most}})
    EXPECT_THROW((void)evaluate_window(package_, plan_, wrong), InvalidArgument);
}

}  // namespace
}  // namespace farlod::library
