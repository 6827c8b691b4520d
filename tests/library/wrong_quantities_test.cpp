// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "farlod/error.hpp"
#include "tests/library/library_calls.hpp"
#include "tests/library/packed_sample.hpp"

// Quantities and regions that a caller gets wrong: each ends with InvalidArgument, whatever the run.

namespace farlod::library {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class WrongQuantities : public testing::Test {
 protected:
  static void SetUpTestSuite() { sample_ = new PackedSample; }
  static void TearDownTestSuite() {
    delete sample_;
    sample_ = nullptr;
  }
  template <class Change>
  static void expect_refused(const std::vector<Named>& calls, const std::string& name, const Change& change) {
    for (const Named& named : calls) {
      Arguments arguments(sample_->folder());
      change(arguments);
      EXPECT_THROW(named.call(arguments), InvalidArgument) << named.name << ": " << name;
    }
  }
  static inline PackedSample* sample_ = nullptr;
  const std::vector<Named> all_{points_into, points, tiles, raster, surfaces};
};

TEST_F(WrongQuantities, AreRefused) {
  const auto with = [](auto member, auto value) { return [=](Arguments& a) { a.settings.further.*member = value; }; };
  const auto sun = [](const SunPosition& position) { return [=](Arguments& a) { a.settings.further.sun = {position}; }; };
  using Q = Quantities;
  expect_refused(all_, "too few horizons", with(&Q::horizons, std::size_t{3}));
  expect_refused(all_, "too many horizons", with(&Q::horizons, std::size_t{3601}));
  expect_refused(all_, "no such patches", with(&Q::sky_patches, static_cast<SkyPatchSet>(9)));
  expect_refused(all_, "a sun nowhere", sun({Angle::degrees(nan), {}, 1.0}));
  expect_refused(all_, "a sun in the ground", sun({{}, Angle::degrees(-91.0), 1.0}));
  expect_refused(all_, "a sun of no time", sun({{}, {}, -1.0}));
  for (const auto member : {&Q::directional, &Q::svf_solid, &Q::hidden})
    expect_refused(all_, "by solid angle", [=](Arguments& a) {
      a.settings.weight = SkyWeight::solid_angle;
      a.settings.further.*member = true;
    });
}

TEST_F(WrongQuantities, BoundsAreOfWhatIsComputed) {
  expect_refused(all_, "bounds of svf_total without svf_total", [](Arguments& a) {
    a.settings.further.svf_total_bounds = true;
    a.settings.bounds = true;
    a.low = a.high = a.svf;
  });
}

TEST_F(WrongQuantities, NeedRoomForThemselvesAndNoOther) {
  expect_refused({points_into}, "no room for quantities", [](Arguments& a) { a.settings.further.directional = true; });
  expect_refused({points_into}, "room that nobody asked for", [](Arguments& a) { a.further.resize(2); });
}

TEST_F(WrongQuantities, RegionsMayBeEmpty) {
  Arguments arguments(sample_->folder());
  arguments.settings.region = std::make_shared<const Region>(std::vector<Region::Ring>{});
  const PointAnswers answers = evaluate_points(arguments.package, {arguments.x, arguments.y}, {}, arguments.settings);
  EXPECT_EQ(answers.summary.outside_of_region, arguments.x.size());
  EXPECT_EQ(answers.summary.receivers + answers.summary.no_data, 0U);
  const Raster map = evaluate_raster(arguments.package, arguments.plan, {}, arguments.settings);
  EXPECT_EQ(map.summary.receivers, 0U);
  EXPECT_EQ(map.summary.outside_of_region + map.summary.beyond_grid, arguments.plan.columns * arguments.plan.rows);
}

}  // namespace
}  // namespace farlod::library
