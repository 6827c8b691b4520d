// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/wedge_gaps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "farlod/point.hpp"
#include "horizon/wedge_sky.hpp"
#include "tests/runtime/horizon/random_places.hpp"
#include "tests/runtime/horizon/wedge_scenes.hpp"

namespace farlod {
namespace {

constexpr std::size_t wedges_around = 96;
constexpr float beyond_all = std::numeric_limits<float>::infinity();
constexpr double rounding_rad = 1e-7;
using Corners = OverhangFacets::Corners;

/// Random triangles around receivers and over some of them, and what is known of the wedges of a packet.
class GapsBetweenAzimuths : public testing::TestWithParam<SkyWeight> {
 protected:
  void scatter(int count) {
    for (int n = 0; n < count; ++n) {
      const Point3f middle{random_.between(-60.0, 60.0), random_.between(-60.0, 60.0), random_.between(2.0, 20.0)};
      Corners t;
      for (Point3f& p : t)
        p = {middle.x + random_.between(-8.0, 8.0), middle.y + random_.between(-8.0, 8.0), middle.z + random_.between(-3.0, 3.0)};
      add(t);
    }
  }
  void add(const Corners& t) {
    triangles_.push_back(t);
    facets_.add(t);
  }
  [[nodiscard]] Wedge wedge(std::size_t k) const {
    return {{ring_.cosine()[k], ring_.sine()[k]}, std::tan(turn_rad / static_cast<double>(wedges_around))};
  }
  /// The sky of a wedge above the triangles, and above a wall that stands across all of it, this steep at the first azimuth.
  [[nodiscard]] double exact_sky(std::size_t k, const ReceiverPacket& packet, std::size_t l, double wall_slope,
                                 bool with_triangles = true) {
    const Point3d eye{packet.x[l], packet.y[l], packet.z[l]};
    WedgeSky sky;
    sky.begin(wedge(k), {packet.normal_x[l], packet.normal_y[l], packet.normal_z[l]}, GetParam());
    if (wall_slope > 0.0) {
      const Point2d u = wedge(k).from;
      const auto place = [&](double aside, double up) {
        return Point3d{100.0 * u.x - aside * u.y, 100.0 * u.y + aside * u.x, 100.0 * up};
      };
      for (const Triangle3d& t :
           quadrilateral(place(-9.0, -0.1), place(29.0, -0.1), place(29.0, wall_slope), place(-9.0, wall_slope)))
        sky.add(t);
    }
    if (with_triangles)
      for (const Corners& t : triangles_) {
        Triangle3d seen;
        for (std::size_t n = 0; n < 3; ++n) seen[n] = Point3d{t[n].x, t[n].y, t[n].z} - eye;
        sky.add(seen);
      }
    return sky.sky().sky;
  }
  [[nodiscard]] ReceiverPacket receivers(const Point3f& normal) {
    std::vector<Point3f> places;
    const Point2d low{random_.between(-30.0, 30.0), random_.between(-30.0, 30.0)};
    for (int n = 0; n < 16; ++n)
      places.push_back({random_.between(low.x, low.x + 8.0), random_.between(low.y, low.y + 8.0), random_.between(0.5, 3.0)});
    return packet_of(places, normal);
  }
  [[nodiscard]] WedgeShape shape() const {
    const auto angle = static_cast<float>(turn_rad / static_cast<double>(wedges_around));
    return {angle, std::cos(angle), std::sin(angle), std::tan(angle), 1.000001F / std::cos(0.5F * angle)};
  }
  [[nodiscard]] std::vector<WedgeGaps::Sky> find(const std::vector<WedgeGaps::Gap>& gaps, const ReceiverPacket& packet) {
    WedgeGaps known(ring_);
    const PacketHorizon level(ring_);
    known.begin({&packet, 1}, {&level, 1});
    const std::span<const WedgeGaps::Sky> found = known.find(gaps, facets_, shape(), GetParam(), packet);
    return {found.begin(), found.end()};
  }

  RandomPlaces random_;
  std::vector<Corners> triangles_;
  OverhangFacets facets_;
  const AzimuthSampling ring_ = AzimuthSampling::even(wedges_around, {});
};

TEST_P(GapsBetweenAzimuths, HoldTheSkyOfTheirWedges) {
  scatter(300);
  double open = 0.0, exact = 0.0, most = 0.0;
  for (const Point3f& normal : {Point3f{0.0F, 0.0F, 1.0F}, Point3f{0.6F, 0.0F, 0.8F}, Point3f{0.0F, 1.0F, 0.0F}}) {
    const ReceiverPacket packet = receivers(normal);
    std::vector<WedgeGaps::Gap> gaps;
    for (std::uint32_t k = 0; k < wedges_around; ++k)
      for (std::uint32_t l = k % 3; l < packet_lanes; l += 3) gaps.push_back({k, l, 0.0F, beyond_all, beyond_all});
    const std::vector<WedgeGaps::Sky> found = find(gaps, packet);
    ASSERT_EQ(found.size(), gaps.size());
    std::vector<Corners> triangles;
    std::swap(triangles, triangles_);
    for (std::size_t n = 0; n < gaps.size(); ++n) {
      const double all = exact_sky(gaps[n].azimuth, packet, gaps[n].lane, 0.0);
      std::swap(triangles, triangles_);
      const double sky = exact_sky(gaps[n].azimuth, packet, gaps[n].lane, 0.0);
      std::swap(triangles, triangles_);
      ASSERT_LE(found[n].open, sky + rounding_rad) << "wedge " << gaps[n].azimuth << ", receiver " << gaps[n].lane;
      ASSERT_GE(all - found[n].hidden, sky - rounding_rad) << "wedge " << gaps[n].azimuth << ", receiver " << gaps[n].lane;
      open += found[n].open;
      exact += sky;
      most += all - found[n].hidden;
    }
    std::swap(triangles, triangles_);
  }
  EXPECT_GT(open, 0.5 * exact);
  EXPECT_LT(most, 1.6 * exact);
}

TEST_P(GapsBetweenAzimuths, HoldItAboveAnEdge) {
  scatter(90);
  const ReceiverPacket packet = receivers({0.0F, 0.0F, 1.0F});
  const WedgeShape w = shape();
  std::vector<WedgeGaps::Gap> gaps;
  std::vector<double> above_wall;
  for (std::uint32_t k = 0; k < wedges_around; ++k)
    for (std::uint32_t l = 0; l < packet_lanes; l += 5) {
      const float from = random_.between(0.05, 0.6);
      WedgeGaps::Gap gap{k, l, from, beyond_all, beyond_all};
      above_wall.push_back(exact_sky(k, packet, l, from, false));
      gap.lid = 0.9999F * from * w.cosine;
      // The wall is highest at the first azimuth: between its border and that slope all is open
      const double above = GetParam() == SkyWeight::solid_angle ? 1.0 - from / std::hypot(1.0, from) : 1.0 / (1.0 + from * from);
      gap.below = static_cast<float>(std::max(0.0, above_wall.back() - static_cast<double>(w.angle) * above));
      gaps.push_back(gap);
    }
  const std::vector<WedgeGaps::Sky> found = find(gaps, packet);
  int closed = 0, open = 0;
  for (std::size_t n = 0; n < gaps.size(); ++n) {
    const double sky = exact_sky(gaps[n].azimuth, packet, gaps[n].lane, gaps[n].from);
    ASSERT_LE(found[n].open, sky + rounding_rad) << "wedge " << gaps[n].azimuth << ", receiver " << gaps[n].lane;
    ASSERT_GE(above_wall[n] - found[n].hidden, sky - rounding_rad) << "wedge " << gaps[n].azimuth << ", " << gaps[n].lane;
    ASSERT_GE(found[n].most, sky - rounding_rad) << "wedge " << gaps[n].azimuth << ", receiver " << gaps[n].lane;
    closed += found[n].most < above_wall[n] ? 1 : 0;
    open += found[n].open > 0.999999F * static_cast<float>(above_wall[n]) ? 1 : 0;
  }
  EXPECT_GT(closed, 5) << "too few to tell";
  EXPECT_GT(open, 5) << "too few to tell";
}

INSTANTIATE_TEST_SUITE_P(Sky, GapsBetweenAzimuths, testing::Values(SkyWeight::cosine, SkyWeight::solid_angle),
                         [](const auto& suite) { return suite.param == SkyWeight::cosine ? "ByCosine" : "BySolidAngle"; });

/// A rectangle, at a wedge that no corner of it lies in.
class OneRectangle : public testing::Test {
 protected:
  static constexpr double angle = turn_rad / static_cast<double>(wedges_around);
  [[nodiscard]] static WedgeGaps::Sky find(const std::array<Point3f, 4>& quad, const Point3f& eye, const WedgeGaps::Gap& gap) {
    OverhangFacets facets;
    facets.add({quad[0], quad[1], quad[2]});
    facets.add({quad[0], quad[2], quad[3]});
    const AzimuthSampling ring = AzimuthSampling::even(wedges_around, {});
    const auto w = static_cast<float>(angle);
    const WedgeShape shape{w, std::cos(w), std::sin(w), std::tan(w), 1.000001F / std::cos(0.5F * w)};
    const std::vector<Point3f> places{eye};
    const ReceiverPacket packet = packet_of(places);
    const PacketHorizon level(ring);
    WedgeGaps known(ring);
    known.begin({&packet, 1}, {&level, 1});
    const std::array<WedgeGaps::Gap, 1> gaps{gap};
    return known.find(gaps, facets, shape, SkyWeight::cosine, packet).front();
  }
  [[nodiscard]] static WedgeGaps::Sky find_below_slab(const Point3f& eye) {
    return find({{{-5, -5, 4}, {5, -5, 4}, {5, 5, 4}, {-5, 5, 4}}}, eye, {0, 0, 0.0F, beyond_all, beyond_all});
  }
  [[nodiscard]] static double above(double t) { return angle / (1.0 + t * t); }
};

TEST_F(OneRectangle, OverheadLeavesOpenWhatIsBelowItsBorder) {
  // The border is 4 m away and 3 m above the eye: slopes of .75 cos φ
  const WedgeGaps::Sky sky = find_below_slab({1.0F, 0.3F, 1.0F});
  const double steepest = 0.75, flattest = 0.75 * std::cos(1.5 * angle);
  EXPECT_LE(sky.open, angle - above(steepest));
  EXPECT_GE(sky.open, angle - above(flattest) - 1e-5);
  EXPECT_LE(sky.hidden, above(flattest));
  EXPECT_GE(sky.hidden, above(steepest) - 1e-5 - angle * 1e-3);
}

TEST_F(OneRectangle, ThatTouchesTheEyeTellsNothing) {
  for (const float z : {3.9996F, 3.99999F}) {
    const WedgeGaps::Sky sky = find_below_slab({1.0F, 0.3F, z});
    EXPECT_EQ(sky.open, 0.0F) << z;
    EXPECT_EQ(sky.hidden, 0.0F) << z;
  }
  // What is below the level hides nothing
  EXPECT_NEAR(find_below_slab({1.0F, 0.3F, 4.02F}).open, angle, 1e-5);
}

TEST_F(OneRectangle, TakesWhatIsOpenBelowAGapWhereItReachesThere) {
  WedgeGaps::Gap gap{0, 0, 0.3F, beyond_all, beyond_all};
  gap.lid = 0.1F;
  gap.below = static_cast<float>(above(0.1) - above(0.3));
  const auto find_upright = [&](float low_m, float high_m) {
    return find({{{12, -9, low_m}, {12, 9, low_m}, {12, 9, high_m}, {12, -9, high_m}}}, {2.0F, 0.0F, 0.0F}, gap);
  };
  EXPECT_GE(find_upright(4.0F, 5.0F).open, above(0.1) - above(0.39) + above(0.501));
  EXPECT_LE(find_upright(2.0F, 5.0F).open, above(0.499));
  // From below the edge it closes the gap, and all that is below it
  EXPECT_EQ(find_upright(4.0F, 5.0F).most, find_upright(2.0F, 5.0F).most);
  // Between the triangles, a corner of both, as high as the diagonal rises in the wedge
  EXPECT_LE(find_upright(0.5F, 9.0F).most, above(0.89) + 0.0015);
}

}  // namespace
}  // namespace farlod
