// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/canopy_on_pixels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "canopy/canopy_sky.hpp"
#include "package/pixel_heights.hpp"
#include "tests/runtime/canopy/crown_scenes.hpp"

namespace farlod {
namespace {

constexpr std::int32_t edge = 96;  ///< of the canopy, in pixels
constexpr double pixel_edge_m = 2.0;
constexpr CanopySettings leafy{CanopyRule::once, Season::leaf_on, 0.1};

/// A canopy over a cell, whose pixels lie along the axes of a city that is turned against the grid. Its first pixel has its
/// centre at (1, 1) m.
struct Canopy {
  package::Manifest manifest;
  AzimuthSampling azimuths;
  std::vector<Crown> crowns;  ///< cell frame
  std::vector<float> height_m;
  std::vector<std::uint8_t> joined;
  RandomPlaces random;

  explicit Canopy(double bearing_deg, std::size_t count = 64)
      : azimuths(AzimuthSampling::even(count, GridRotation(Angle::degrees(bearing_deg)))),
        height_m(edge * edge, 0.0F),
        joined(edge * edge, 0) {
    manifest.grid.rotation = GridRotation(Angle::degrees(bearing_deg));
    manifest.grid.cell_edge_m = 1.5 * edge * pixel_edge_m;
    manifest.grid.cells = {-1, 0, 1, 1};
    manifest.pixels = package::SurfacePixels{{0.0, edge * pixel_edge_m}, pixel_edge_m, edge, edge};
  }
  /// Trees of some pixels each, over a third of all, with gaps below them.
  void plant() {
    std::vector<bool> has_crown(height_m.size());
    for (int tree = 0; tree < 260; ++tree) {
      const Point3f p = random.place(0.5 * edge, 4.0, 16.0);
      const int radius = static_cast<int>(random.between(0.0, 3.5));
      for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
          const int column = static_cast<int>(p.x) + edge / 2 + x, row = static_cast<int>(p.y) + edge / 2 + y;
          if (column < 0 || row < 0 || column >= edge || row >= edge) continue;
          const auto n = static_cast<std::size_t>(row * edge + column);
          if (!has_crown[n])
            add(column, row, {0.25 * static_cast<double>(p.z), static_cast<double>(p.z) + random.between(-0.5, 0.5)});
          has_crown[n] = true;
        }
    }
  }
  void add(int column, int row, Heights heights) {
    const auto turn = static_cast<std::uint16_t>(std::lround(manifest.grid.rotation.bearing().degrees() / 90.0 * 65536.0));
    crowns.push_back(crown_at(CrownShape::prism, place(column, row), 0.5 * pixel_edge_m, heights, Foliage::unknown, turn));
  }
  /// In the frame of the cell 0, 0, whose corner is the origin.
  [[nodiscard]] Point2d place(int column, int row) const {
    return manifest.grid.rotation.grid_from_city(Point2d{(column + 0.5) * pixel_edge_m, (row + 0.5) * pixel_edge_m});
  }
  [[nodiscard]] std::optional<CanopyLattice> lattice() const { return CanopyLattice::of(manifest.grid, {0, 0}, crowns.front()); }
  [[nodiscard]] std::optional<CanopyField> field(bool knows_solids) const {
    const CellCrowns of_cell{{0, 0}, crowns};
    return CanopyField::of(*lattice(), manifest, {&of_cell, 1}, knows_solids ? SolidPixels{height_m, joined} : SolidPixels());
  }
  [[nodiscard]] CanopyCity city(bool knows_solids = false) const {
    return {manifest, *lattice(), *field(knows_solids), azimuths};
  }
  [[nodiscard]] std::vector<Receiver> receivers(int column, int row, int count) const {
    std::vector<Receiver> all;
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < count; ++x) {
        const Point2d p = place(column + x, row + y);
        all.push_back({all.size(), {static_cast<float>(p.x), static_cast<float>(p.y), 1.5F + static_cast<float>((x * y) % 7)}});
      }
    return all;
  }
};

struct Marched {
  std::vector<PacketHorizon::Lanes> behind, hidden;
  std::vector<PacketHorizon::Row> behind_of_azimuths, hidden_of_azimuths;
  std::vector<std::uint32_t> answered;
};
Marched march(const CanopyCity& city, std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
              const CanopyMarchKernels& kernels = *crown_kernels().march) {
  const std::size_t n = packets.size(), azimuths = city.paths.paths().size();
  Marched m{std::vector<PacketHorizon::Lanes>(n), std::vector<PacketHorizon::Lanes>(n),
            std::vector<PacketHorizon::Row>(n * azimuths),
            std::vector<PacketHorizon::Row>(city.field.knows_solids() ? n * azimuths : 0), std::vector<std::uint32_t>(n)};
  CanopyOnPixels(city, {0, 0}, kernels)
      .evaluate(profiles, packets, {m.behind, m.hidden, m.behind_of_azimuths, m.hidden_of_azimuths}, m.answered);
  return m;
}

std::vector<ReceiverPacket> packets_of(const Canopy& canopy, std::span<const Receiver> receivers) {
  std::vector<ReceiverPacket> packets;
  const PacketOrder order = order_on_pixels(*canopy.lattice(), canopy.manifest.grid, {0, 0}, receivers, {});
  for_each_group(receivers, order, [&](std::span<const ReceiverPacket> some, std::span<const std::uint32_t>) {
    packets.insert(packets.end(), some.begin(), some.end());
  });
  return packets;
}

std::vector<SkyProfile> profiles_for(Canopy& canopy, std::size_t count) {
  std::vector<SkyProfile> profiles;
  for (std::size_t n = 0; n < count; ++n) profiles.push_back(some_profile(canopy.random, canopy.azimuths, false));
  return profiles;
}

// (2) the same as of prisms one by one
TEST(CanopyOnPixels, IsWhatPrismsAre) {
  for (const double bearing_deg : {0.0, 30.0, 90.0 - 12.5}) {
    Canopy canopy(bearing_deg);
    canopy.plant();
    const std::vector<Receiver> receivers = canopy.receivers(40, 37, 20);
    const std::vector<ReceiverPacket> packets = packets_of(canopy, receivers);
    const std::vector<SkyProfile> profiles = profiles_for(canopy, packets.size());
    const Marched marched = march(canopy.city(), profiles, packets);
    CanopySky sky(canopy.azimuths);
    const CrownBatches batches(canopy.crowns, leafy);
    double sum = 0.0, most = 0.0;
    for (std::size_t n = 0; n < packets.size(); ++n) {
      EXPECT_EQ(marched.answered[n], packets[n].lanes_in_use());
      const CanopyShares judge = sky.evaluate(profiles[n], packets[n], batches);
      for (std::size_t l = 0; l < packets[n].count; ++l) {
        const double error = std::abs(static_cast<double>(marched.behind[n][l] - judge.behind[l]));
        sum += error;
        most = std::max(most, error);
      }
    }
    // Turns of prisms are rounded, which a few azimuths along their sides tell
    EXPECT_LT(most, 0.5 * static_cast<double>(least_sky_behind) + 2e-4) << bearing_deg;
    EXPECT_LT(sum / static_cast<double>(receivers.size()), 1.5e-4) << bearing_deg;
  }
}

// (1) the answers of a receiver depend on its own profile and place, and on the canopy
TEST(CanopyOnPixels, DoesNotDependOnOtherReceivers) {
  Canopy canopy(30.0);
  canopy.plant();
  const std::vector<Receiver> receivers = canopy.receivers(30, 30, 20);
  const std::vector<ReceiverPacket> packets = packets_of(canopy, receivers);
  const std::vector<SkyProfile> profiles = profiles_for(canopy, packets.size());
  const CanopyCity city = canopy.city();
  const Marched together = march(city, profiles, packets);
  for (std::size_t n = 0; n < packets.size(); n += 3) {
    const std::size_t last = packets[n].count - 1;
    ReceiverPacket alone;
    alone.add({0, {packets[n].x[last], packets[n].y[last], packets[n].z[last]}});
    SkyProfile profile = profiles[n];
    for (PacketHorizon::Row& row : profile.sky_from) row.fill(row[last]);
    const Marched one = march(city, {&profile, 1}, {&alone, 1});
    EXPECT_EQ(one.behind[0][0], together.behind[n][last]);
  }
}

TEST(CanopyOnPixels, AllTargetsGiveTheSameBits) {
  Canopy canopy(30.0);
  canopy.plant();
  const std::vector<Receiver> receivers = canopy.receivers(30, 30, 16);
  const std::vector<ReceiverPacket> packets = packets_of(canopy, receivers);
  const std::vector<SkyProfile> profiles = profiles_for(canopy, packets.size());
  const CanopyCity city = canopy.city(true);
  const Marched expected = march(city, profiles, packets);
  for (const CrownTarget& target : runnable_crown_kernels()) {
    const Marched marched = march(city, profiles, packets, *target.march);
    EXPECT_EQ(marched.behind, expected.behind) << target.name;
    EXPECT_EQ(marched.hidden, expected.hidden) << target.name;
    EXPECT_EQ(marched.behind_of_azimuths, expected.behind_of_azimuths) << target.name;
  }
}

/// Whether a ray from a receiver meets a crown before it meets what is solid, by small steps. The surface has this height at a
/// place of the city.
using Surface = std::function<double(Point2d)>;
bool meets_crown_before_solid(const Canopy& canopy, const Surface& surface, const Receiver& receiver, Point2d direction,
                              double slope) {
  const Point2d eye = canopy.manifest.grid.rotation.city_from_grid(Point2d{receiver.p_cell.x, receiver.p_cell.y});
  std::vector<const Crown*> crown_of(canopy.height_m.size());
  for (const Crown& crown : canopy.crowns) {
    const Point2d p = canopy.manifest.grid.rotation.city_from_grid(Point2d{crown.x_m, crown.y_m});
    crown_of[static_cast<std::size_t>(p.y / pixel_edge_m) * edge + static_cast<std::size_t>(p.x / pixel_edge_m)] = &crown;
  }
  for (double distance = 0.01; distance < 2.0 * edge * pixel_edge_m; distance += 0.02) {
    const Point2d p = eye + distance * direction;
    if (p.x < 0.0 || p.y < 0.0 || p.x >= edge * pixel_edge_m || p.y >= edge * pixel_edge_m) return false;
    const Crown* const crown =
        crown_of[static_cast<std::size_t>(p.y / pixel_edge_m) * edge + static_cast<std::size_t>(p.x / pixel_edge_m)];
    const double z = static_cast<double>(receiver.p_cell.z) + slope * distance;
    if (z < surface(p)) return false;
    if (crown != nullptr && static_cast<double>(crown->bottom_m) < z && z < static_cast<double>(crown->top_m)) return true;
  }
  return false;
}

/// 1 − svfaveg at each azimuth, for some receivers on the ground, whose horizons are so high.
void expect_solid_behind_crowns(Canopy& canopy, const Surface& surface, float horizon, double tolerance) {
  std::vector<Receiver> receivers;
  for (Receiver& r : canopy.receivers(38, 40, 3)) receivers.push_back({receivers.size(), {r.p_cell.x, r.p_cell.y, 1.5F}});
  const std::vector<ReceiverPacket> packets = packets_of(canopy, receivers);
  ASSERT_EQ(packets.size(), 1U);
  SkyProfile profile(canopy.azimuths);
  for (PacketHorizon::Row& row : profile.sky_from) row.fill(horizon);
  const Marched marched = march(canopy.city(true), {&profile, 1}, packets);
  constexpr int parts = 200;
  const double square = static_cast<double>(horizon) * static_cast<double>(horizon), sky_below = square / (1.0 + square);
  for (std::size_t k = 0; k < canopy.azimuths.size(); ++k)
    for (std::size_t l = 0; l < 9; l += 4) {
      const Receiver receiver{0, {packets[0].x[l], packets[0].y[l], packets[0].z[l]}};
      const Point2d direction{double{canopy.azimuths.cosine()[k]}, double{canopy.azimuths.sine()[k]}};
      int met = 0;
      for (int part = 0; part < parts; ++part) {
        const double y = sky_below * (part + 0.5) / parts;
        met += meets_crown_before_solid(canopy, surface, receiver, direction, std::sqrt(y / (1.0 - y))) ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(marched.hidden_of_azimuths[k][l]), sky_below * met / parts,
                  2.0 * sky_below / parts + tolerance)
          << k;
    }
}

TEST(CanopyOnPixels, TellsWhichWallsAreBehindCrowns) {
  Canopy canopy(0.0, 16);
  canopy.plant();
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column)
      if (column < 20 || column >= 62 || row < 25) canopy.height_m[static_cast<std::size_t>(row * edge + column)] = 20.0F;
  const Surface blocks = [&](Point2d p) {
    return static_cast<double>(
        canopy.height_m[static_cast<std::size_t>(p.y / pixel_edge_m) * edge + static_cast<std::size_t>(p.x / pixel_edge_m)]);
  };
  expect_solid_behind_crowns(canopy, blocks, 0.3F, 1e-3);
}

// A slope of 56° without a step: as walls, its pixels would hide the crowns on it
TEST(CanopyOnPixels, TellsWhichSlopesAreBehindCrowns) {
  Canopy canopy(0.0, 16);
  canopy.plant();
  const auto height_at = [](double columns) { return std::max(0.0, 3.0 * (columns - 42.0)); };
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column)
      canopy.height_m[static_cast<std::size_t>(row * edge + column)] = static_cast<float>(height_at(column));
  std::ranges::fill(canopy.joined, static_cast<std::uint8_t>(JoinedPixels::east | JoinedPixels::north));
  const Surface slope = [&](Point2d p) { return height_at(p.x / pixel_edge_m - 0.5); };
  expect_solid_behind_crowns(canopy, slope, 0.6F, 0.012);
}

TEST(CanopyOnPixels, LeavesOthersToOthers) {
  Canopy canopy(30.0);
  canopy.plant();
  ReceiverPacket packet;
  const Point2d centre = canopy.place(40, 40);
  packet.add({0, {static_cast<float>(centre.x), static_cast<float>(centre.y), 1.5F}});
  packet.add({1, {static_cast<float>(centre.x) + 0.3F, static_cast<float>(centre.y), 1.5F}});
  packet.add({2, {static_cast<float>(centre.x), static_cast<float>(centre.y), 1.5F}, {1.0F, 0.0F, 0.0F}});
  const SkyProfile profile(canopy.azimuths);
  EXPECT_EQ(march(canopy.city(), {&profile, 1}, {&packet, 1}).answered[0], 1U);
}

// Crowns that are no pixels of one raster, each once
TEST(CanopyField, IsOfOneRaster) {
  Canopy canopy(30.0);
  canopy.plant();
  EXPECT_TRUE(canopy.field(false).has_value());
  EXPECT_TRUE(canopy.city(true).field.knows_solids());
  const std::vector<Crown> pixels = canopy.crowns;
  canopy.crowns[1].x_m += 0.4F;
  EXPECT_FALSE(canopy.field(false).has_value());
  canopy.crowns = pixels;
  canopy.crowns.push_back(pixels.front());
  EXPECT_FALSE(canopy.field(false).has_value());
  canopy.crowns = pixels;
  canopy.crowns[1].foliage = Foliage::evergreen;
  EXPECT_FALSE(canopy.field(false).has_value());
  // Few crowns far from each other
  canopy.crowns = {pixels.front(), pixels.back()};
  EXPECT_FALSE(canopy.field(false).has_value());
  canopy.crowns = {crown_at(CrownShape::spheroid, {9.0, 9.0}, 1.0, {2.0, 9.0})};
  EXPECT_FALSE(canopy.lattice().has_value());
}

}  // namespace
}  // namespace farlod
