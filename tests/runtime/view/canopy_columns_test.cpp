// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "view/canopy_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "package/crowns_of_city.hpp"
#include "tests/library/packed_sample.hpp"
#include "tests/scenes/planted_crowns.hpp"
#include "view/view_city.hpp"

namespace farlod {
namespace {

constexpr double bottom_m = 6.0, top_m = 15.0, half_m = 5.0;
/// What CanopyColumns::bytes rounds a height by, at the most.
constexpr double half_unit_m = 0.05;

/// The village with some crowns in a row, the first one in the middle of its first cell.
class VillageWithCrowns {
 public:
  explicit VillageWithCrowns(CrownShape shape, int crowns = 1, double turn_rad = 0.0) {
    CrownsOfCity all = scenes::crowns_for(sample_.folder());
    const Point2d middle_grid = all.grid().centre_of({all.grid().cells.i_begin, all.grid().cells.j_begin});
    for (int n = 0; n < crowns; ++n)
      all.add(middle_grid + n * Point2d{2.5 * half_m, 0.0}, bottom_m, top_m, half_m, shape, Foliage::unknown, turn_rad);
    scenes::plant(all, sample_.folder());
    package_.emplace(sample_.folder());
    frame_ = view_frame_of(*package_);
    const Point2d p = frame_.local_from_grid({0.5 * frame_.cell_edge_m, 0.5 * frame_.cell_edge_m});
    axis_local_ = p;
  }
  [[nodiscard]] const Package& package() const { return *package_; }
  [[nodiscard]] const ViewFrame& frame() const { return frame_; }
  [[nodiscard]] CanopyColumns columns(std::size_t most = most_canopy_columns) const {
    return canopy_columns_of(*package_, frame_, most);
  }
  [[nodiscard]] Point2d axis_local() const { return axis_local_; }

 private:
  library::PackedSample sample_;
  std::optional<Package> package_;
  ViewFrame frame_;
  Point2d axis_local_;
};

struct CanopySize {
  double area_m2 = 0.0, volume_m3 = 0.0;
};

CanopySize size_of(const CanopyColumns& canopy) {
  CanopySize size;
  for (const CanopyColumn& c : canopy.columns) {
    size.area_m2 += canopy.step_m * canopy.step_m;
    size.volume_m3 += canopy.step_m * canopy.step_m * (c.top_local_m - c.bottom_local_m);
  }
  return size;
}

Point2d middle_of_square(const CanopyColumns& canopy, const CanopyColumn& c) {
  return canopy.north_west_local + canopy.step_m * Point2d{c.column + 0.5, -c.row - 0.5};
}

TEST(CanopyColumns, AreNoneWithoutCrowns) {
  const library::PackedSample sample;
  const Package package(sample.folder());
  EXPECT_TRUE(canopy_columns_of(package, view_frame_of(package)).columns.empty());
  EXPECT_EQ(ViewCity(package, "village.farlod", view_frame_of(package), {}).answer("crowns", {}).status, 404);
}

TEST(CanopyColumns, OfABoxAreTheBox) {
  const VillageWithCrowns village(CrownShape::prism, 1, 0.3);
  const CanopyColumns canopy = village.columns();
  EXPECT_EQ(canopy.step_m, finest_canopy_step_m);
  const CanopySize size = size_of(canopy);
  // A straight border of a length L crosses squares of L times the step, √2 for a slanted one
  const double uncertain_m2 = 8.0 * half_m * std::numbers::sqrt2 * canopy.step_m;
  EXPECT_NEAR(size.area_m2, 4.0 * half_m * half_m, uncertain_m2);
  EXPECT_NEAR(size.volume_m3, size.area_m2 * (top_m - bottom_m), 1e-3);
  for (const CanopyColumn& c : canopy.columns)
    EXPECT_LE(norm(middle_of_square(canopy, c) - village.axis_local()), std::numbers::sqrt2 * half_m + 1e-3) << "beside the box";
}

TEST(CanopyColumns, OfASpheroidHaveItsVolume) {
  const VillageWithCrowns village(CrownShape::spheroid);
  const CanopyColumns canopy = village.columns();
  const double volume_m3 = 4.0 / 3.0 * std::numbers::pi * half_m * half_m * 0.5 * (top_m - bottom_m);
  // Near its border a spheroid is lower than half of its height
  const double uncertain_m3 = 2.0 * std::numbers::pi * half_m * std::numbers::sqrt2 * canopy.step_m * 0.5 * (top_m - bottom_m);
  EXPECT_NEAR(size_of(canopy).volume_m3, volume_m3, uncertain_m3);
  for (const CanopyColumn& c : canopy.columns) {
    const double share = norm(middle_of_square(canopy, c) - village.axis_local()) / half_m;
    const double height_m = (top_m - bottom_m) * std::sqrt(std::max(0.0, 1.0 - share * share));
    EXPECT_NEAR(c.top_local_m - c.bottom_local_m, height_m, 0.02);
  }
}

TEST(CanopyColumns, AreNoMoreThanAllowed) {
  const VillageWithCrowns village(CrownShape::cylinder, 6);
  const double area_m2 = 6.0 * std::numbers::pi * half_m * half_m;
  for (const std::size_t most : {1000U, 300U, 60U}) {
    const CanopyColumns canopy = village.columns(most);
    EXPECT_LE(canopy.columns.size(), most);
    EXPECT_GT(canopy.columns.size(), most / 8) << "a step of half the width takes four times as many";
    EXPECT_EQ(std::exp2(std::round(std::log2(canopy.step_m))), canopy.step_m);
    const double uncertain_m2 = 12.0 * std::numbers::pi * half_m * std::numbers::sqrt2 * canopy.step_m;
    EXPECT_NEAR(size_of(canopy).area_m2, area_m2, uncertain_m2);
  }
}

TEST(CanopyColumns, ComeToThePageAsTheyAre) {
  const VillageWithCrowns village(CrownShape::spheroid);
  const ViewCity city(village.package(), "village.farlod", village.frame(), {});
  const ViewReply reply = city.answer("crowns", {});
  ASSERT_EQ(reply.status, 200);
  EXPECT_EQ(nlohmann::json::parse(city.description(true)).at("counts").at("crowns"), 1);
  const CanopyColumns canopy = village.columns();
  std::array<float, 5> head{};
  ASSERT_EQ(reply.body.size(), sizeof(head) + canopy.columns.size() * 4 * sizeof(std::uint16_t));
  std::memcpy(head.data(), reply.body.data(), sizeof(head));
  EXPECT_NEAR(head[0], canopy.north_west_local.x, 1e-3);
  EXPECT_NEAR(head[1], canopy.north_west_local.y, 1e-3);
  EXPECT_EQ(head[2], canopy.step_m);
  for (std::size_t n = 0; n < canopy.columns.size(); ++n) {
    std::array<std::uint16_t, 4> row{};
    std::memcpy(row.data(), reply.body.data() + sizeof(head) + n * sizeof(row), sizeof(row));
    EXPECT_EQ(row[0], canopy.columns[n].column);
    EXPECT_EQ(row[1], canopy.columns[n].row);
    EXPECT_NEAR(head[3] + row[2] * head[4], canopy.columns[n].bottom_local_m, half_unit_m + 1e-3);
    EXPECT_NEAR(head[3] + row[3] * head[4], canopy.columns[n].top_local_m, half_unit_m + 1e-3);
  }
}

}  // namespace
}  // namespace farlod
