// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "plausibility/standing_heights.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "farlod/error.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod::plausibility {
namespace {

using scenes::refusal_of;
using testing::AllOf;
using testing::HasSubstr;

double drawn(std::mt19937& random, double low, double high) { return std::uniform_real_distribution(low, high)(random); }

/// A town on ground that climbs eastwards. `lift` says how far above the lowest ground below it a building begins.
struct Town {
  double slope = 0.0;
  int side = 8;  ///< buildings along each side
  Point2d place = {};

  [[nodiscard]] double ground_m(Point2d p) const { return 500.0 + slope * p.x; }

  template <class Lift>
  void build(scenes::SceneBuilder& scene, const Lift& lift) const {
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const Point2d low = place + Point2d{30.0 * column, 30.0 * row};
        const double base_m = ground_m(low) + lift();
        scene.add_box({low, low + Point2d{12.0, 15.0}}, base_m, base_m + 9.0);
      }
  }
};

LocatedCity located(const scenes::SceneBuilder& scene) {
  LocatedCity city;
  city.city = scene.city();
  city.sources = {"town.gml"};
  return city;
}

/// What is told of a city above the ground of a town: the details of its problems.
/// `offset_m`: by which the user raised the ground to where it is.
std::string told(const LocatedCity& city, const Town& town, double extent_m = 1e5, double offset_m = 0.0) {
  Report report;
  const Box2d extent{{-extent_m, -extent_m}, {extent_m, extent_m}};
  const SurveyedGround ground{[&](Point2d p) { return town.ground_m(p); }, extent, true, offset_m};
  report_standing(city, ground, report);
  std::string details;
  for (const Problem& p : report.problems()) details += p.source + ": " + p.detail + "\n";
  return details;
}

template <class Lift>
std::string told_of(const Town& town, const Lift& lift) {
  scenes::SceneBuilder scene;
  town.build(scene, lift);
  return told(located(scene), town);
}

class OnSlopes : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Ground, OnSlopes, testing::Values(0.0, 0.1, 0.25, 0.5));

TEST_P(OnSlopes, AnOffsetIsToldWithItsHeight) {
  const Town town{GetParam()};
  std::mt19937 random(7);
  for (int offset = -60; offset <= 60; ++offset) {
    // Within these, a model may be drawn with its cellars or plinths, and on a slope one end of a house stands higher
    if (-5 < offset && offset < 4 + 12.0 * town.slope) continue;
    std::string text;
    const std::string refusal =
        refusal_of<InputError>([&] { text = told_of(town, [&] { return offset + drawn(random, -0.3, 0.3); }); });
    if (text.empty()) text = refusal;
    EXPECT_THAT(text, AllOf(HasSubstr("64 of 64 buildings stand"), HasSubstr(offset > 0 ? "above" : "below"))) << offset;
    const double proposed_m = std::stod(text.substr(text.find("--terrain-offset") + 17));
    EXPECT_NEAR(proposed_m, offset, 0.3) << text;
    const bool cannot_be = offset > 10 || offset < -10;  // floors above all ground, roofs below it
    if (cannot_be) {
      EXPECT_NE(refusal, "no refusal") << offset;
    }
  }
}

TEST_P(OnSlopes, NothingIsToldOfATownThatStandsAsTownsDo) {
  const Town town{GetParam()};
  std::mt19937 random(8);
  const auto percent = [&](double share) { return drawn(random, 0.0, 100.0) < share; };
  EXPECT_EQ(told_of(town, [&] { return drawn(random, -0.5, 0.5); }), "") << "as exact as surveys are";
  EXPECT_EQ(told_of(town, [&] { return drawn(random, -3.0, 0.0); }), "") << "cellars, some of them";
  EXPECT_EQ(told_of(town, [&] { return -3.0; }), "") << "a cellar below each";
  EXPECT_EQ(told_of(town, [&] { return 0.6; }), "") << "plinths";
  EXPECT_EQ(told_of(town, [&] { return 0.5 * 12.0 * town.slope; }), "") << "floors at the middle of the slope";
  EXPECT_EQ(told_of(town, [&] { return percent(10) ? drawn(random, 3.0, 9.0) : 0.0; }), "") << "stilts";
  EXPECT_EQ(told_of(town, [&] { return percent(20) ? drawn(random, -60.0, 60.0) : 0.0; }), "") << "wrong ones among good ones";
}

TEST(StandingHeights, ProposeAnOffsetInPlaceOfTheOneThatIsGiven) {
  const Town town;
  const auto told_with = [&](double lift_m, double offset_m) {
    scenes::SceneBuilder scene;
    town.build(scene, [&] { return lift_m; });
    return told(located(scene), town, 1e5, offset_m);
  };
  EXPECT_THAT(told_with(7.9, 0.0), HasSubstr("--terrain-offset 7.9 would raise"));
  EXPECT_THAT(told_with(7.9, -5.0), HasSubstr("--terrain-offset 2.9 instead of -5 would raise"));
  EXPECT_THAT(told_with(-7.9, 5.5), HasSubstr("--terrain-offset -2.4 instead of 5.5 would lower"));
  EXPECT_THAT(told_with(-7.98, 8.0), HasSubstr("--terrain-offset 0.0 instead of 8 would lower"));
}

TEST(StandingHeights, BuildingsThatHangEachByAnotherHeightAreCounted) {
  const Town town{0.05};
  const auto told_where_each = [&](int n_th) {
    int n = 0;
    return told_of(town, [&] { return n++ % n_th == 0 ? 3.0 + 0.1 * n : 0.0; });
  };
  EXPECT_THAT(told_where_each(2), AllOf(HasSubstr("town.gml: 32 of 64 buildings hang 2 m or more above the terrain, up to 8."),
                                        HasSubstr(" m, and not all alike, the first of them ")));
  EXPECT_THAT(told_where_each(4), HasSubstr("16 of 64 buildings hang"));
  EXPECT_EQ(told_where_each(6), "") << "on stilts, or parts above a passage";
}

TEST(StandingHeights, OneOfTwoTownsIsTold) {
  scenes::SceneBuilder scene;
  Town town{0.05};
  town.build(scene, [] { return 0.0; });
  town.place = {9000.0, 0.0};
  town.build(scene, [] { return -30.0; });
  EXPECT_THAT(told(located(scene), town), HasSubstr("town.gml: 64 of 128 buildings stand 30."));
}

TEST(StandingHeights, FewBuildingsAreToldWhereNoneCanStandSo) {
  Town town;
  town.side = 2;
  EXPECT_EQ(told_of(town, [] { return 2.5; }), "") << "four houses on piles";
  const auto refusal = [&](double lift_m) {
    return refusal_of<InputError>([&] { (void)told_of(town, [&] { return lift_m; }); });
  };
  EXPECT_THAT(refusal(45.0), HasSubstr("town.gml: 4 of 4 buildings stand 45.0 m above the ground"));
  EXPECT_THAT(refusal(-45.0), HasSubstr("town.gml: 4 of 4 buildings stand 45.0 m below the ground"));
}

TEST(StandingHeights, BuildingsThatKnowTheirHeightAboveGroundAreNotCompared) {
  const Town town;
  scenes::SceneBuilder scene;
  town.build(scene, [] { return -500.0; });
  LocatedCity city = located(scene);
  CityModel lifted;
  for (const Building& b : city.city.buildings()) {
    lifted.begin_building(b.id, HeightReference::on_ground);
    for (const Facet& f : city.city.facets_of(b)) {
      lifted.begin_facet(f.kind, f.surface);
      lifted.add_ring(city.city.ring(f, 0));
    }
  }
  city.city = std::move(lifted);
  EXPECT_EQ(told(city, town), "");
}

TEST(StandingHeights, BuildingsBeyondTheSurveyAreCounted) {
  const Town town;
  scenes::SceneBuilder scene;
  town.build(scene, [] { return 0.0; });
  const std::string told_beyond = told(located(scene), town, 100.0);
  EXPECT_THAT(told_beyond, HasSubstr("48 of 64 buildings lie beyond the terrain, the first of them "));
  EXPECT_THAT(told_beyond, HasSubstr("the ground below them is as high as the nearest of the terrain"));
}

TEST(StandingHeights, DoNotDependOnWhereASquareBegins) {
  Town town;
  town.place = {-120.0, -120.0};  // around the corner of four squares
  EXPECT_THAT(told_of(town, [] { return 4.0; }), HasSubstr("64 of 64 buildings stand 4.0 m above"));
}

}  // namespace
}  // namespace farlod::plausibility
