// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/validation/paper_experiment.hpp"

#include <gtest/gtest.h>

#include "tests/scenes/generated_town.hpp"

namespace farlod {
namespace {

TEST(PaperExperiment, ErrorsStayBelowThePapers) {
  CitySettings settings;
  settings.size_m = 1200;
  settings.tower_share = 0.3;
  settings.rotation_deg = 20;
  PaperExperiment experiment;
  experiment.bearing_deg = 20;
  experiment.receivers = 500;
  const std::vector<PaperRow> rows = run_paper_experiment(scenes::generated_town(settings), experiment);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_LT(rows[0].delivered.max_abs_error, 0.10);  // the paper, c = 50 m, N = 3
  EXPECT_LT(rows[1].delivered.max_abs_error, 0.05);  // the paper, c = 100 m, N = 3
  for (const PaperRow& row : rows) {
    // The far field is there to be seen, and the map sees most of it
    EXPECT_GT(row.dropped.bias, 0.0);
    EXPECT_LT(row.far_map.mean_abs_error, 0.5 * row.dropped.mean_abs_error);
  }
}

}  // namespace
}  // namespace farlod
