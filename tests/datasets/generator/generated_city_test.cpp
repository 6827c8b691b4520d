// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "generator/generated_city.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "farlod/error.hpp"
#include "tests/datasets/generator/solid_geometry.hpp"

namespace farlod {
namespace {

/// FNV-1a over all that a city consists of.
std::uint64_t fingerprint(const CitySettings& settings) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  const auto add = [&hash](std::uint64_t number) {
    for (int k = 0; k < 8; ++k) hash = (hash ^ ((number >> (8 * k)) & 0xFFU)) * 0x100000001B3U;
  };
  for (const GeneratedBuilding& building : all_buildings(settings)) {
    for (const PointMm& p : building.vertices)
      for (const std::int64_t x : {p.x, p.y, p.z}) add(static_cast<std::uint64_t>(x));
    for (const RingNumbers& ring : rings_of(building))
      for (const std::uint32_t k : ring) add(k);
  }
  return hash;
}

TEST(GeneratedCity, SameSettingsSameCity) {
  for (const CitySettings& settings : cities_of_all_shapes()) EXPECT_EQ(fingerprint(settings), fingerprint(settings));
}

TEST(GeneratedCity, EverySettingOfTheCityMatters) {
  CitySettings settings = cities_of_all_shapes()[3];
  std::set<std::uint64_t> seen{fingerprint(settings)};
  ++settings.seed;
  EXPECT_TRUE(seen.insert(fingerprint(settings)).second);
  settings.overhangs = false;
  EXPECT_TRUE(seen.insert(fingerprint(settings)).second);
  CitySettings::describe(settings, [&](std::string_view name, auto& value, SettingRange range, auto&&...) {
    if (name.starts_with("centre")) return;  // the place of the centre is added by the writers
    const auto before = value;
    const double less = std::max(range.low, static_cast<double>(before) * 0.7);
    const bool is_lowest = static_cast<double>(before) == range.low;
    value = static_cast<std::decay_t<decltype(value)>>(is_lowest ? 0.5 * (range.low + range.high) : less);
    EXPECT_TRUE(seen.insert(fingerprint(settings)).second) << name;
    value = before;
  });
}

TEST(GeneratedCity, EverySwitchMatters) {
  CitySettings settings;
  settings.size_m = 600.0, settings.lod = 2;
  std::set<std::uint64_t> seen{fingerprint(settings)};
  CitySettings::describe_switches(settings, [&](const char* name, bool& value, const char*) {
    value = true;
    EXPECT_TRUE(seen.insert(fingerprint(settings)).second) << name;
    EXPECT_EQ(fingerprint(settings), fingerprint(settings)) << name;
    value = false;
  });
}

class EachCity : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Overhangs, EachCity, ::testing::Values(0));
INSTANTIATE_TEST_SUITE_P(AllOptions, EachCity, ::testing::Values(1));

TEST_P(EachCity, BlocksDoNotDependOnTheirOrder) {
  const CitySettings settings = GetParam() == 0 ? cities_of_all_shapes()[2] : cities_with_each_option().back();
  const std::vector<GeneratedBuilding> in_order = all_buildings(settings);
  const CityLayout layout(settings);
  std::size_t end = in_order.size();
  for (std::int64_t k = layout.block_count(); k-- > 0;) {
    const std::vector<GeneratedBuilding> block = buildings_of_block(settings, layout.block_at(k));
    ASSERT_LE(block.size(), end);
    end -= block.size();
    for (std::size_t n = 0; n < block.size(); ++n) {
      EXPECT_EQ(block[n].id, in_order[end + n].id);
      EXPECT_EQ(block[n].vertices, in_order[end + n].vertices);
    }
  }
  EXPECT_EQ(end, 0U);
}

TEST(GeneratedCity, IdsAreUniqueAndDoNotDependOnTheLevelOfDetail) {
  const std::vector<CitySettings> cities = cities_of_all_shapes();
  CitySettings prisms = cities[2];
  prisms.lod = 1;
  const std::vector<GeneratedBuilding> roofs = all_buildings(cities[2]), blocks = all_buildings(prisms);
  ASSERT_EQ(roofs.size(), blocks.size());
  std::set<std::string> ids;
  for (std::size_t k = 0; k < roofs.size(); ++k) {
    EXPECT_TRUE(ids.insert(roofs[k].id).second);
    EXPECT_EQ(roofs[k].id, blocks[k].id);
    EXPECT_EQ(roofs[k].footprint, blocks[k].footprint);
    EXPECT_LE(blocks[k].top_mm, roofs[k].top_mm);
  }
}

TEST(GeneratedCity, RefusesUnusableSettings) {
  CitySettings settings;
  settings.tower_share = 2.0;
  EXPECT_THROW(visit_city(settings, {.building = [](const GeneratedBuilding&) {}}), InvalidArgument);
}

TEST(GeneratedCity, TowersComeNearToTheGreatestHeightAndNotAbove) {
  CitySettings settings;
  settings.size_m = 3500.0;
  double tallest_m = 0.0;
  for (const GeneratedBuilding& building : all_buildings(settings)) tallest_m = std::max(tallest_m, building.height_m());
  EXPECT_LE(tallest_m, settings.max_height_m);
  EXPECT_GT(tallest_m, 0.9 * settings.max_height_m);
}

TEST(SizeForBuildings, FindsTheSizeBetweenTooFewAndTooMany) {
  const auto count_at = [](double size_m) {
    CitySettings settings;
    settings.size_m = size_m;
    return static_cast<std::int64_t>(all_buildings(settings).size());
  };
  for (const std::int64_t wanted : {300, 2000, 5000}) {
    const double size_m = size_for_buildings_m(CitySettings{}, wanted);
    // Sizes are tried in steps of 10 m, and the nearer neighbor of the wanted number wins
    EXPECT_LE(count_at(size_m - 10.0), wanted);
    EXPECT_GE(count_at(size_m + 10.0), wanted);
  }
}

TEST(SizeForBuildings, RefusesWhatNoCityHas) {
  EXPECT_THROW((void)size_for_buildings_m(CitySettings{}, 0), InvalidArgument);
  EXPECT_THROW((void)size_for_buildings_m(CitySettings{}, std::int64_t{1} << 50), InvalidArgument);
}

}  // namespace
}  // namespace farlod
