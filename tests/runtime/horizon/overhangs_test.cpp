// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/overhangs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "evaluate/visibility.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/horizon_engine.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/sky_partition.hpp"
#include "receivers/point_receivers.hpp"
#include "tests/analytic/oracles.hpp"
#include "tests/analytic/tolerance.hpp"
#include "tests/package/far_horizon_by_hand.hpp"
#include "tests/runtime/horizon/grazing_rays.hpp"
#include "tests/runtime/horizon/packed_overhangs.hpp"
#include "tests/runtime/horizon/packet_by_packet.hpp"
#include "tests/runtime/horizon/town_by_hand.hpp"

namespace farlod {
namespace {

using TriangleCorners = OverhangGeometry::TriangleCorners;

/// A receiver this near to the outline of a triangle may count as below it or not.
constexpr double border_m = 0.003;

/// How far inside of a triangle's outline a place lies, seen from above; negative outside of it.
double depth_inside(const TriangleCorners& t, const Point3f& p) {
  double least = 1e9, area = 0.0;
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    area += double{a.x} * b.y - double{b.x} * a.y;
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const Point3f &a = t[n], &b = t[(n + 1) % 3];
    const Point2d along{double{b.x} - a.x, double{b.y} - a.y}, to{double{p.x} - a.x, double{p.y} - a.y};
    const double left = (along.x * to.y - along.y * to.x) / norm(along);
    least = std::min(least, area > 0.0 ? left : -left);
  }
  return least;
}

std::vector<TriangleCorners> random_triangles(RandomPlaces& random, int count) {
  std::vector<TriangleCorners> triangles;
  for (int n = 0; n < count; ++n) {
    const Point3f a = random.place(30.0, 3.0, 20.0);
    const auto beside = [&] {
      return Point3f{a.x + random.between(-8.0, 8.0), a.y + random.between(-8.0, 8.0), a.z + random.between(-2.0, 2.0)};
    };
    const Point3f b = beside();
    triangles.push_back({a, b, beside()});
  }
  return triangles;
}

std::vector<Point3f> random_eyes(RandomPlaces& random) {
  const Point3f low = random.place(25.0, 0.0, 8.0);
  std::vector<Point3f> eyes;
  for (int n = 0; n < 16; ++n)
    eyes.push_back({low.x + random.between(0.0, 6.0), low.y + random.between(0.0, 6.0), low.z + random.between(0.0, 3.0)});
  return eyes;
}

TEST(OverhangGeometry, CoversThoseWhoStandBelow) {
  RandomPlaces random;
  int below = 0, beside = 0;
  for (int n = 0; n < 200; ++n) {
    const std::vector<TriangleCorners> triangles = random_triangles(random, 4);
    const std::vector<Point3f> eyes = random_eyes(random);
    const std::uint32_t bits = PackedOverhangs(triangles).geometry().receivers_below(packet_of(eyes));
    for (std::size_t l = 0; l < eyes.size(); ++l) {
      bool must = false, may = false;
      for (const TriangleCorners& t : triangles) {
        const double depth = depth_inside(t, eyes[l]);
        const auto [low, high] = std::minmax({t[0].z, t[1].z, t[2].z});
        must = must || (depth > border_m && low > eyes[l].z);
        may = may || (depth > -border_m && high > eyes[l].z);
      }
      const bool is_covered = ((bits >> l) & 1U) != 0;
      EXPECT_TRUE(is_covered || !must) << n << ", " << l;
      EXPECT_TRUE(may || !is_covered) << n << ", " << l;
      below += must ? 1 : 0;
      beside += may ? 0 : 1;
    }
  }
  EXPECT_GT(std::min(below, beside), 50) << "too few to tell";
}

TEST(OverhangGeometry, AVerticalWallCoversNobodyBesideIt) {
  const std::vector<TriangleCorners> wall{{{{5.0F, 0.0F, 2.0F}, {5.0F, 8.0F, 2.0F}, {5.0F, 8.0F, 9.0F}}}};
  const std::vector<Point3f> eyes{{4.9F, 4.0F, 1.0F}, {5.1F, 4.0F, 1.0F}};
  EXPECT_EQ(PackedOverhangs(wall).geometry().receivers_below(packet_of(eyes)), 0U);
}

/// A receiver 1 cm off the jamb of a door that lies on the border of its cell.
TEST(OverhangGeometry, CoversThoseWhoStandOffAWallOnTheBorderOfTheirCell) {
  const std::vector<TriangleCorners> lintel{{{{5.0F, 19.0F, 2.0F}, {7.0F, 20.0F, 2.0F}, {5.0F, 20.0F, 2.0F}}}};
  const std::vector<Point3f> eyes{{5.5F, -surface_offset_m, 1.0F}, {5.5F, -surface_offset_m, 3.0F}, {5.5F, 0.5F, 1.0F}};
  const PackedOverhangs packed(lintel, Assign::clip, PackedOverhangs::south_of_it);
  EXPECT_EQ(packed.geometry().receivers_below(packet_of(eyes)), 0b001U);
}

/// The roles of edges by their definition, ray by ray: above the upper borders all is free, and between the highest lower border
/// and the highest upper one all is hidden.
TEST(OverhangGeometry, RaysMeetWhatFloatsBelowItsUpperBordersAndAboveTheLowerOnes) {
  RandomPlaces random;
  const DirectionSampling sampling(SkyPartition(SkyWeight::solid_angle, 500).directions());
  std::size_t free_above = 0, hidden_between = 0, open = 0;
  for (int n = 0; n < 300; ++n) {
    TownByHand town;
    for (const TriangleCorners& t : random_triangles(random, 1 + n % 3)) town.add_floating(t);
    const PackedOverhangs packed(town.overhanging());
    OverhangGeometry overhangs = packed.geometry();
    const std::vector<Point3f> eyes = random_eyes(random);
    const ReceiverPacket packet = packet_of(eyes);
    PacketHorizon upper(sampling.azimuths()), lower(sampling.azimuths());
    upper.raise(town.silhouettes().near.overhangs, packet);
    upper.close(overhangs.receivers_below(packet));
    lower.raise(town.silhouettes().near.undersides, packet);
    for (std::size_t l = 0; l < eyes.size(); ++l)
      for (std::size_t k = 0; k < sampling.size(); ++k) {
        const RayVerdict ray = verdict(overhangs.scene().occluder, eyes[l], sampling.direction(k));
        const bool is_above_upper = ((upper.below(k, sampling.slopes()[k]) >> l) & 1U) != 0;
        const bool is_above_lower = ((lower.below(k, sampling.slopes()[k]) >> l) & 1U) != 0;
        ++(is_above_upper ? free_above : is_above_lower ? hidden_between : open);
        if (ray.grazes || !(is_above_upper || is_above_lower)) continue;
        EXPECT_EQ(ray.is_free, is_above_upper) << n << ", receiver " << l << ", ray " << k;
      }
  }
  EXPECT_GT(std::min({free_above, hidden_between, open}), 500U) << "too few to tell";
}

TEST(OverhangGeometry, ItsSceneIsWhatOverhangsAlone) {
  RandomPlaces random;
  const std::vector<TriangleCorners> triangles = random_triangles(random, 7);
  const PackedOverhangs packed(triangles);
  OverhangGeometry overhangs = packed.geometry();
  EXPECT_EQ(overhangs.scene().occluder.triangle_count(), 7U);
  EXPECT_EQ(&overhangs.scene().occluder, &overhangs.scene().occluder) << "it is made once";
}

TEST(OverhangGeometry, NothingHangsFromNothing) {
  const PackedOverhangs packed({});
  OverhangGeometry none = packed.geometry();
  EXPECT_EQ(none.scene().occluder.triangle_count(), 0U);
  const std::vector<Point3f> eyes{{5.0F, 5.0F, 1.0F}};
  EXPECT_EQ(none.receivers_below(packet_of(eyes)), 0U);
}

// What overhangs, in scenes whose sky view factors are known in closed form, and in others that are traced ray by ray. Edges are
// drawn by hand.

constexpr float eye_m = 1.5F;
constexpr std::size_t scene_azimuths = 1024;
constexpr Point3f level_normal{0.0F, 0.0F, 1.0F};

/// The mean over the circle from the middles of equal parts errs in each part by its variation there at the most. Of these scenes
/// the sky at an azimuth, at most 1, rises and falls twice.
constexpr double azimuth_rounding = 4.0 / static_cast<double>(scene_azimuths);

/// Two ways of adding up the sky of a thousand azimuths, one of them in a hundred parts for each, as floats. At
/// most each addition rounds by 3e-8; what is seen is a hundredth of that.
constexpr double summing_error = 0.01 * 1024 * 128 * 6e-8;

struct Known {
  Point3f p;
  double svf;
};
struct Scene {
  std::string name;
  TownByHand town;
  std::vector<Known> known;
  double extra_error = 0.0;              ///< of a finite scene that stands for an endless one
  double most_width = azimuth_rounding;  ///< of the bounds
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

/// What a level rectangle hides of the sky, h above the eye; places are relative to the eye. Signed parts of quadrants.
double hidden_by_rectangle(double west, double south, double east, double north, double h) {
  const auto quadrant = [h](double a, double b) {
    const double part = oracles::court_quadrant_cos(std::abs(a), std::abs(b), h);
    return (a < 0.0) != (b < 0.0) ? -part : part;
  };
  return quadrant(east, north) - quadrant(west, north) - quadrant(east, south) + quadrant(west, south);
}

/// A soffit that covers all with x < 10, cut off far away: what lies beyond hides no more than an endless wall of its height.
Scene half_plane() {
  constexpr double far_m = 1000.0, height_m = 6.0;
  Scene scene{"HalfPlane", {}, {}, 4.0 * (1.0 - oracles::wall_cos(height_m - eye_m, far_m - 20.0))};
  scene.town.add_slab({10.0 - far_m, -far_m}, {far_m, 2.0 * far_m}, height_m);
  for (const double e : {9.5, 6.0, 3.0, 0.5, -0.5, -3.0, -8.0})
    scene.known.push_back(
        {{static_cast<float>(10.0 - e), 5.0F, eye_m}, oracles::overhang_cos(height_m - eye_m, std::abs(e), e > 0.0)});
  return scene;
}

/// A slab that floats 5 m above the ground.
Scene floating_slab() {
  Scene scene{"FloatingSlab", {}, {}};
  const Point2d low{6.0, 8.0}, size{7.0, 4.0};
  scene.town.add_slab(low, size, 5.0);
  for (const Point2d p : {Point2d{8.0, 9.0}, {12.5, 11.5}, {2.0, 2.0}, {8.0, 3.0}, {15.0, 10.0}, {19.0, 19.0}}) {
    const Point2d sw = low - p, ne = low + size - p;
    scene.known.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), eye_m},
                           1.0 - hidden_by_rectangle(sw.x, sw.y, ne.x, ne.y, 5.0 - eye_m)});
  }
  return scene;
}

/// An endless arcade: a soffit 4 m high from a wall at x = 4 to an open front at x = 10.
Scene arcade_without_pillars() {
  constexpr float far_m = 1000.0F, height_m = 4.0F;
  Scene scene{"Arcade", {}, {}, 4.0 * (1.0 - oracles::wall_cos(height_m - eye_m, far_m - 20.0))};
  const Point3f a{10, -far_m, height_m}, b{10, far_m, height_m}, c{4, far_m, height_m}, d{4, -far_m, height_m};
  scene.town.add_facet({a, b, c, d}, false);
  scene.town.add_facet({{{4, -far_m, 0}, {4, far_m, 0}, c, d}}, false);
  scene.town.add_border_of_slab(a, b);
  scene.town.add_border_of_slab(b, c);
  scene.town.add_border_of_slab(d, a);
  scene.town.add_edge({d, c, {AdjacentSlopes::straight_down, 0}, EdgeRole::grounded});
  for (const double e : {5.5, 3.0, 0.5})
    scene.known.push_back({{static_cast<float>(10.0 - e), 5.0F, eye_m}, oracles::overhang_cos(height_m - eye_m, e, true)});
  // In front of it, it is a wall as high as its roof's edge, and below that the wall of its back
  for (const double e : {1.0, 4.0}) {
    const double h = height_m - eye_m, above = oracles::wall_cos(h, e), back = oracles::wall_cos(h, e + 6.0);
    scene.known.push_back({{static_cast<float>(10.0 + e), 5.0F, eye_m}, above});
    EXPECT_LT(above, back);
  }
  return scene;
}

/// Three walls and a roof 6 m high over 12 × 8 m; the south is open.
Scene open_shell() {
  constexpr float height_m = 6.0F;
  Scene scene{"OpenShell", {}, {}, 0.0, 0.15};
  const Point3f sw{4, 6, height_m}, se{16, 6, height_m}, ne{16, 14, height_m}, nw{4, 14, height_m};
  const auto foot = [](Point3f p) { return Point3f{p.x, p.y, 0.0F}; };
  scene.town.add_facet({sw, se, ne, nw}, false);
  for (const auto& [a, b] : {std::pair{se, ne}, {ne, nw}, {nw, sw}}) {
    scene.town.add_facet({foot(a), foot(b), b, a}, false);
    scene.town.add_edge({a, b, {0, AdjacentSlopes::straight_down}, EdgeRole::grounded});
  }
  scene.town.add_border_of_slab(sw, se);
  const double h = height_m - eye_m;
  for (const Point2d p : {Point2d{10.0, 10.0}, {5.0, 7.0}, {15.5, 13.5}, {8.0, 6.5}})
    // The sky is seen where a wall in the place of the opening would hide it
    scene.known.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), eye_m},
                           1.0 - oracles::finite_wall_cos(h, p.y - 6.0, p.x - 4.0, 16.0 - p.x)});
  return scene;
}

/// A gallery whose front stands on pillars, a bridge, and slabs one above the other: no closed form.
Scene gallery_and_bridges() {
  Scene scene{"GalleryAndBridges", {}, {}};
  scene.town.add_slab({2.0, 12.0}, {16.0, 5.0}, 4.0);
  scene.town.add_box({2.0, 17.0}, {16.0, 6.0}, 9.0);
  for (const double x : {2.0, 6.0, 10.0, 14.0, 17.6}) scene.town.add_box({x, 12.0}, {0.4, 0.4}, 4.0);
  scene.town.add_beam({-10.0, 4.0}, {40.0, 2.0}, 6.0, 7.0);
  scene.town.add_slab({5.0, -6.0}, {9.0, 3.0}, 5.0);
  scene.town.add_slab({3.0, -8.0}, {14.0, 7.0}, 8.0);
  return scene;
}

class OverhangScenes : public testing::TestWithParam<Scene> {
 protected:
  [[nodiscard]] std::vector<SvfInterval> evaluate(const std::vector<Point3f>& places, bool wants_bounds) const {
    const PackedOverhangs packed(GetParam().town.overhanging());
    OverhangGeometry overhangs = packed.geometry();
    const AzimuthSampling ring = AzimuthSampling::even(scene_azimuths, {});
    FarHorizonByHand far({});
    CellSilhouettes silhouettes = GetParam().town.silhouettes();
    silhouettes.number_borders();
    HorizonEngine engine(ring, SkyWeight::cosine, far.map(), silhouettes, overhangs, 0.0F, JumpPlaces::between_azimuths);
    std::vector<Receiver> receivers;
    for (const Point3f& p : places) receivers.push_back({receivers.size(), p, level_normal});
    std::vector<SvfInterval> intervals(places.size());
    const Evaluate answer = wants_bounds ? Evaluate{&HorizonEngine::evaluate_with_bounds} : Evaluate{&HorizonEngine::evaluate};
    (void)packet_by_packet(engine, receivers, intervals, answer);
    return intervals;
  }
};

TEST_P(OverhangScenes, HaveTheirKnownSkyViewFactors) {
  std::vector<Point3f> places;
  for (const Known& known : GetParam().known) places.push_back(known.p);
  const std::vector<SvfInterval> plain = evaluate(places, false), bounded = evaluate(places, true);
  const double tolerance = azimuth_rounding + GetParam().extra_error;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double expected = GetParam().known[n].svf;
    EXPECT_NEAR(plain[n].estimate, expected, tolerance) << n;
    EXPECT_NEAR(bounded[n].estimate, plain[n].estimate, summing_error) << n;
    EXPECT_LE(bounded[n].low, expected + tolerance) << n;
    EXPECT_GE(bounded[n].high, expected - tolerance) << n;
    EXPECT_LE(bounded[n].high - bounded[n].low, GetParam().most_width) << n;
  }
}

/// Of so many exact rays, and what they leave unseen: a border of the sky of 8π on the unit disk (tests/analytic/tolerance.hpp).
constexpr std::size_t rays = 20000;

TEST_P(OverhangScenes, AreWhatRaysSee) {
  std::vector<Point3f> places;
  RandomPlaces random;
  for (int n = 0; n < 64; ++n)
    places.push_back({random.between(0.0, 20.0), random.between(-4.0, 11.5), random.between(0.5, 3.0)});
  const std::vector<SvfInterval> intervals = evaluate(places, true);
  const Occluder city = GetParam().town.city();
  const std::vector<Point3d> directions = SkyPartition(SkyWeight::cosine, rays).directions();
  const std::vector<std::uint32_t> free = count_free(city, places, directions);
  const double tolerance = sampling_error(rays, 8.0 * std::numbers::pi) + azimuth_rounding;
  int open = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double truth = static_cast<double>(free[n]) / static_cast<double>(rays);
    EXPECT_NEAR(intervals[n].estimate, truth, tolerance) << n;
    EXPECT_LE(intervals[n].low, truth + tolerance) << n;
    EXPECT_GE(intervals[n].high, truth - tolerance) << n;
    EXPECT_LE(intervals[n].low, intervals[n].estimate) << n;
    EXPECT_LE(intervals[n].estimate, intervals[n].high) << n;
    open += intervals[n].high > intervals[n].low + 0.001F ? 1 : 0;
  }
  EXPECT_GT(open, 5) << "nothing is seen below anything";
}

INSTANTIATE_TEST_SUITE_P(HorizonEngine, OverhangScenes,
                         testing::Values(half_plane(), floating_slab(), arcade_without_pillars(), open_shell(),
                                         gallery_and_bridges()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlod
