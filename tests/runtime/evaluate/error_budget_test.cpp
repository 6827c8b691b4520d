// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/error_budget.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

TEST(ErrorBudget, AsManyRaysAsItTakesAndNoMore) {
  for (const double error : {0.05, 0.01, 0.005, 0.001, 0.0001}) {
    const std::size_t rays = rays_for_sampling_error(error);
    EXPECT_LE(sampling_error(rays), error);
    EXPECT_GT(sampling_error(rays - 1), error);
  }
}

TEST(ErrorBudget, AsManyAzimuthsAsItTakesAndNoMore) {
  for (const double error : {0.05, 0.011, 0.007, 0.0013, 0.0001}) {
    const std::size_t azimuths = azimuths_for_error(error);
    EXPECT_LE(azimuth_error(azimuths), error);
    EXPECT_GT(azimuth_error(azimuths - 1), error);
  }
}

// Receivers of the generated city of docs/validation.md: the largest errors seen
TEST(ErrorBudget, CoversWhatWasMeasured) {
  EXPECT_GE(sampling_error(500), 0.0246);
  EXPECT_GE(sampling_error(1000), 0.0107);
  EXPECT_GE(sampling_error(4000), 0.0047);
}

}  // namespace
}  // namespace farlod
