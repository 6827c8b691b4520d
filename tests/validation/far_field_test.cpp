// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "validation/city_study.hpp"

namespace farlod::validation {
namespace {

/// What is promised of far maps of the kind `horizon` with N = 3, on the ground.
struct Promise {
  double mean, p99, max;
};
constexpr Promise at_50_m{0.0010, 0.005, 0.010}, at_100_m{0.0006, 0.003, 0.006};
/// The same with c = 50 m, on roofs and façades.
constexpr Promise on_surfaces{0.0015, 0.008, 0.015};
constexpr double most_bytes_a_cell = 24e3;
/// What the paper says of its map, with cells of 50 and of 100 m.
constexpr double papers_error_at_50_m = 0.10, papers_error_at_100_m = 0.05;

void expect_kept(const Promise& promise, const ErrorSummary& e) {
  EXPECT_LE(e.mean_abs_error, promise.mean);
  EXPECT_LE(e.p99_abs_error, promise.p99);
  EXPECT_LE(e.max_abs_error, promise.max);
}

CityStudy study_of_town() {
  Extent extent = quick_extent();
  extent.generated_size_m = 800.0;
  extent.neighborhoods = {3};
  const StudiedCity city = generated_city(extent.generated_size_m);
  return study_far_field(city, choose_sites(city, extent), extent);
}

void expect_ours_better_than_the_papers_and_that_than_nothing(const CityStudy& study) {
  for (const FarFieldRow& row : study.rows) {
    EXPECT_LT(row.ground.horizon.mean_abs_error, row.ground.box.mean_abs_error);
    EXPECT_LT(row.ground.box.mean_abs_error, row.ground.dropped.mean_abs_error);
    EXPECT_GT(row.ground.dropped.bias, 0.0);
  }
}

void expect_the_papers_map_keeps_the_papers_promise(const CityStudy& study) {
  EXPECT_LT(study.rows[0].ground.box.max_abs_error, papers_error_at_50_m);
  EXPECT_LT(study.rows[1].ground.box.max_abs_error, papers_error_at_100_m);
}

void expect_ours_keeps_its_own(const CityStudy& study) {
  expect_kept(at_50_m, study.rows[0].ground.horizon);
  expect_kept(at_100_m, study.rows[1].ground.horizon);
  expect_kept(on_surfaces, study.rows[0].roofs->horizon);
  expect_kept(on_surfaces, study.rows[0].facades->horizon);
  EXPECT_LE(study.rows[0].bytes_a_cell, most_bytes_a_cell);
}

/// Both sides trace the same rays: nothing of their sampling is left. Fewer rays show how much that is.
void expect_no_error_of_rays(const CityStudy& study) {
  for (const FarFieldRow& row : study.rows)
    EXPECT_LT(row.ground.horizon.mean_abs_error, 0.1 * row.ground_rays.front().horizon.mean_abs_error);
}

void expect_exact_answers_within_the_bounds(const CityStudy& study) {
  for (const FarFieldRow& row : study.rows) EXPECT_EQ(row.ground.bounds.outside, 0U);
  EXPECT_EQ(study.rows[0].roofs->bounds.outside, 0U);
  EXPECT_EQ(study.rows[0].facades->bounds.outside, 0U);
}

/// One test, since each runs in a process of its own, and the study takes seconds.
TEST(FarFieldOfATown, IsAsGoodAsPromised) {
  const CityStudy study = study_of_town();
  ASSERT_EQ(study.rows.size(), 2U);
  expect_ours_better_than_the_papers_and_that_than_nothing(study);
  expect_the_papers_map_keeps_the_papers_promise(study);
  expect_ours_keeps_its_own(study);
  expect_no_error_of_rays(study);
  expect_exact_answers_within_the_bounds(study);
}

}  // namespace
}  // namespace farlod::validation
