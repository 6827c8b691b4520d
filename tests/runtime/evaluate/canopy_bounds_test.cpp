// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "evaluate/crowns_of_cell.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "evaluate/traced_canopy.hpp"
#include "scene/canopy_around.hpp"
#include "tests/scenes/packed_city.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "tests/scenes/scene_builder.hpp"

namespace farlod {
namespace {

struct Rule {
  const char* name;
  CanopySettings canopy;
  /// Of sums over the azimuths; by the rule `beer` that of the quadrature, too, of which each segment has .007 of its sky at the
  /// most (docs/concepts.md, "Crowns"), and nearly all have less than a tenth of that.
  double rounding;
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }

/// A field of 1,000 m with a box at two corners, and a crown on each 200 m² of it.
class FieldOfCrowns : public testing::TestWithParam<Rule> {
 protected:
  static constexpr double half_m = 500.0, crowns_per_m2 = 0.005, cell_m = 100.0;

  FieldOfCrowns() : package_(packed()) {}
  [[nodiscard]] PackageReader packed() const {
    scenes::SceneBuilder scene;
    scene.add_box({{-half_m, -half_m}, {-half_m + 4.0, -half_m + 4.0}}, 0.0, 3.0);
    scene.add_box({{half_m - 4.0, half_m - 4.0}, {half_m, half_m}}, 0.0, 3.0);
    const Grid grid = scenes::grid_covering(scene.city(), {}, cell_m, 3);
    scenes::pack_city(scene.city(), grid, folder_.path() / "a.farlod", scenes::small_maps(FarMapKind::horizon));
    CrownsOfCity crowns = scenes::crowns_for(folder_.path() / "a.farlod");
    std::mt19937_64 random(5);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    for (int n = 0; n < static_cast<int>(4.0 * half_m * half_m * crowns_per_m2); ++n) {
      const double height_m = uniform(4.0, 20.0);
      crowns.add({uniform(-half_m, half_m), uniform(-half_m, half_m)}, uniform(0.1, 0.6) * height_m, height_m, uniform(0.5, 4.0),
                 static_cast<CrownShape>(random() % crown_shape_count),
                 random() % 3 == 0 ? Foliage::evergreen : Foliage::deciduous, uniform(0.0, 1.5));
    }
    scenes::plant(crowns, folder_.path() / "a.farlod");
    return PackageReader(folder_.path() / "a.farlod");
  }
  [[nodiscard]] CrownsOfCell crowns_of(const CellReceivers& cell, const CrownMerging& merging) const {
    return {package_, cell, GetParam().canopy, azimuths_, merging, no_pixel_merging};
  }
  [[nodiscard]] static CanopyShares shares_of(CrownsOfCell& crowns, const SkyProfile& profile, const ReceiverPacket& packet) {
    CanopyShares shares;
    crowns.evaluate({&profile, 1}, {&packet, 1}, {&shares, 1}, {});
    return shares;
  }
  /// One packet in the middle of the field: on the ground or above it, and looking up, aslant or to the side.
  [[nodiscard]] static CellReceivers receivers() {
    CellReceivers cell{{0, 0}, {}};
    const std::vector<Point3f> normals{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -1, 0}};
    for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n)
      cell.receivers.push_back(
          {n, {6.0F * static_cast<float>(n), 50.0F, n % 5 == 0 ? 12.0F : 1.5F}, normals[n % normals.size()]});
    return cell;
  }
  [[nodiscard]] static ReceiverPacket packet_of(const CellReceivers& cell) {
    ReceiverPacket packet;
    for (const Receiver& r : cell.receivers) packet.add(r);
    return packet;
  }
  /// A horizon that differs from azimuth to azimuth, up to this slope.
  [[nodiscard]] SkyProfile profile_below(float highest) const {
    SkyProfile profile(azimuths_);
    std::mt19937 random(8);
    for (PacketHorizon::Row& row : profile.sky_from)
      for (float& slope : row) slope = highest * static_cast<float>(random() % 1024) / 1024.0F;
    return profile;
  }

  const AzimuthSampling azimuths_ = AzimuthSampling::even(128, {});
  scenes::TemporaryFolder folder_;
  PackageReader package_;
};

TEST_P(FieldOfCrowns, TakeAsMuchAsTheirBoundSays) {
  const CellReceivers cell = receivers();
  const ReceiverPacket packet = packet_of(cell);
  constexpr double everywhere_m = 1e5;
  CrownsOfCell all = crowns_of(cell, {everywhere_m, 25.0, everywhere_m, 100.0, everywhere_m});
  // Merged from near by, merged as for bounds, and left out from near by
  for (const CrownMerging& merging :
       {CrownMerging{20.0, 25.0, 100.0, 100.0, 3000.0}, merging_for_bounds, CrownMerging{20.0, 25.0, 100.0, 100.0, 150.0},
        CrownMerging{150.0, 25.0, 150.0, 25.0, 150.0}})
    for (const float highest : {0.0F, 0.05F, 0.4F}) {
      const SkyProfile profile = profile_below(highest);
      CrownsOfCell some = crowns_of(cell, merging);
      const CanopyShares exact = shares_of(all, profile, packet), shares = shares_of(some, profile, packet);
      const PacketHorizon::Lanes most = some.most_error(profile, packet);
      for (std::size_t l = 0; l < packet.count; ++l)
        EXPECT_LE(std::abs(static_cast<double>(shares.lost[l] - exact.lost[l])),
                  static_cast<double>(most[l]) + GetParam().rounding)
            << l << " below " << highest << ", by name up to " << merging.named_m;
    }
}

TEST_P(FieldOfCrowns, AreCertainWhereEachCountsByItself) {
  const CellReceivers cell = receivers();
  const PacketHorizon::Lanes most = crowns_of(cell, no_merging).most_error(profile_below(0.0F), packet_of(cell));
  for (const float error : most) EXPECT_EQ(error, 0.0F);
}

TEST_P(FieldOfCrowns, BoundsAreNarrow) {
  const CellReceivers cell = receivers();
  const ReceiverPacket packet = packet_of(cell);
  const PacketHorizon::Lanes open = crowns_of(cell, merging_for_bounds).most_error(profile_below(0.0F), packet);
  for (std::size_t l = 0; l < packet.count; ++l) {
    const double rise_m = 20.0 - static_cast<double>(packet.z[l]), slope = rise_m / 300.0;
    // A level receiver loses at most the square of the slope; one that looks to the side up to 2/π of it, on its side of the turn
    EXPECT_LE(static_cast<double>(open[l]), packet.normal_z[l] == 1.0F ? slope * slope : slope) << l;
    EXPECT_GT(open[l], 0.0F) << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, FieldOfCrowns,
                         testing::Values(Rule{"Umep", {}, 2e-6}, Rule{"UmepLeafOff", {CanopyRule::once, Season::leaf_off}, 2e-6},
                                         Rule{"CrownsLeafOff", {CanopyRule::each, Season::leaf_off}, 2e-6},
                                         Rule{"Beer", {CanopyRule::beer, Season::leaf_off}, 5e-4}),
                         [](const auto& rule) { return std::string(rule.param.name); });

TEST(EnclosingCrown, HoldsAllOfThem) {
  const std::vector<Crown> crowns{{10, 0, 3, 9, 2, CrownShape::spheroid, Foliage::evergreen, 0},
                                  {20, 8, 1, 7, 3, CrownShape::prism, Foliage::evergreen, 32768}};
  const Crown all = enclosing(crowns);
  EXPECT_EQ(std::tie(all.shape, all.foliage, all.turn), std::make_tuple(CrownShape::prism, Foliage::evergreen, 0));
  EXPECT_EQ(std::tie(all.bottom_m, all.top_m), std::make_tuple(1.0F, 9.0F));
  for (const Crown& c : crowns)
    for (const double side : {-1.0, 1.0}) {
      EXPECT_LE(std::abs(c.x_m + side * reach_m(c) - all.x_m), all.half_width_m);
      EXPECT_LE(std::abs(c.y_m + side * reach_m(c) - all.y_m), all.half_width_m);
    }
}

/// A sky whose azimuths are free above one slope each: the true one, that of the profile, and its bounds; crowns take a share of
/// each slice between them.
TEST(SvfTotal, OfEachSkyWithinTheBoundsLiesWithinItsOwn) {
  std::mt19937 random(3);
  const auto uniform = [&] { return static_cast<float>(random() % 4096) / 4096.0F; };
  constexpr float rounding = 1e-6F;
  for (int n = 0; n < 2000; ++n) {
    // Ends of the sky from above: what `low` has, what the profile has, the truth, and what `high` has
    float low = 0.3F * uniform(), high = low + 0.3F * uniform();
    const float drawn = low + uniform() * (high - low), truth = low + uniform() * (high - low);
    const float above = uniform(), between = uniform();  // shares that pass the crowns
    const auto lost = [&](float sky) {
      return (1.0F - above) * std::min(sky, low) + (1.0F - between) * (sky - std::min(sky, low));
    };
    const SvfInterval of_profile{low, drawn, high};
    // The answer may be known better than the profile
    const float narrow = uniform();
    const SvfInterval answer{truth - narrow * (truth - low), truth, truth + narrow * (high - truth)};
    const float error = 0.05F * uniform(), found = lost(drawn) + (2.0F * uniform() - 1.0F) * error;
    const SvfInterval total = svf_total_of({answer, of_profile}, found, error);
    EXPECT_LE(total.low, truth - lost(truth) + rounding);
    EXPECT_GE(total.high, truth - lost(truth) - rounding);
    EXPECT_LE(total.low, total.estimate);
    EXPECT_LE(total.estimate, total.high);
    EXPECT_GE(total.low, 0.0F);
    EXPECT_LE(total.high, answer.high);
  }
}

/// A canopy, 1200 m wide and 6 m up. Whole, it belongs to one cell, far from most that it hangs over; its edges are so far that
/// they hardly rise above the horizontal.
class FarCanopy : public testing::TestWithParam<Assign> {
 protected:
  FarCanopy() : package_(packed()) {}
  [[nodiscard]] PackageReader packed() const {
    scenes::SceneBuilder scene;
    for (const double x : {-601.0, 597.0}) scene.add_box({{x, x}, {x + 4, x + 4}}, 0.0, 3.0);
    scene.add_polygon({{-600, -600, 6}, {600, -600, 6}, {600, 600, 6}});
    const Grid grid = scenes::grid_covering(scene.city(), {}, 50, 1);
    scenes::pack_city(scene.city(), grid, folder_.path() / "canopy.farlod", {}, GetParam(), {{cell_}});
    return PackageReader(folder_.path() / "canopy.farlod");
  }
  [[nodiscard]] SkyAnswers answers() { return SkyAnswers(svf_, low_, high_); }

  const Cell cell_{4, -5};  // as far from all three edges as can be
  scenes::TemporaryFolder folder_;
  PackageReader package_;
  std::vector<float> svf_{0.0F}, low_{0.0F}, high_{0.0F};
};

TEST_P(FarCanopy, HidesTheSkyOverhead) {
  const CellReceivers receiver{cell_, {{0, {25.0F, 25.0F, 1.5F}}}};
  SkyEvaluator(package_, {Engine::exact}).evaluate(receiver, answers());
  const float truth = svf_[0];
  EXPECT_LT(truth, 0.01F);
  for (const Engine engine : {Engine::automatic, Engine::rays}) {
    SkyEvaluator(package_, {engine}).evaluate(receiver, answers());
    EXPECT_NEAR(svf_[0], truth, 0.01F);
    EXPECT_LE(low_[0], truth + 0.01F);
    EXPECT_GE(high_[0], truth - 0.01F);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FarCanopy, testing::Values(Assign::clip, Assign::whole),
                         [](const auto& test) { return test.param == Assign::clip ? "Clip" : "Whole"; });

}  // namespace
}  // namespace farlod
