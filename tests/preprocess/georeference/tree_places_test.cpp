// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/tree_places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/output_crs.hpp"

namespace farlod::georeference {
namespace {

using testing::HasSubstr;

constexpr Point2d origin_m{400000.0, 5500000.0};

/// Trees some metres or some ten thousandths of a degree apart.
SourceTrees inventory(const std::string& crs, Point2d first, Point2d step) {
  SourceTrees trees{"trees.geojson", {crs, true, true}, {}};
  for (int n = 0; n < 5; ++n) {
    Tree tree;
    tree.place = first + static_cast<double>(n) * step;
    trees.trees.push_back(tree);
  }
  return trees;
}
SourceTrees in_degrees(const std::string& crs) { return inventory(crs, {7.62, 49.645}, {1e-4, 1e-4}); }
SourceTrees in_metres(const std::string& crs) { return inventory(crs, {400100.0, 5500200.0}, {9.0, 9.0}); }

struct Located {
  SourceTrees trees;
  Report report;

  Located(SourceTrees source, const std::string& fallback) : trees(std::move(source)) {
    locate_trees(trees, fallback, georeference_around(origin_m, *Crs::find("EPSG:25832")), report);
  }
  [[nodiscard]] Point2d first() const { return trees.trees[0].place; }
  [[nodiscard]] std::vector<int> codes() const {
    std::vector<int> codes;
    for (const Problem& problem : report.problems()) codes.push_back(static_cast<int>(problem.code));
    return codes;
  }
};

TEST(TreePlaces, OfTheOutputCrsAreKept) {
  for (const std::string fallback : {"", "EPSG:25832"}) {
    EXPECT_EQ(Located(in_metres("EPSG:25832"), fallback).first(), (Point2d{100.0, 200.0}));
    EXPECT_EQ(Located(in_metres(""), fallback).first(), (Point2d{100.0, 200.0})) << "a file that says none";
  }
}

TEST(TreePlaces, AreProjected) {
  // 7.62° E, 49.645° N in UTM 32: from PROJ's cs2cs
  const Located located(in_degrees("EPSG:4326"), "");
  EXPECT_NEAR(located.first().x + origin_m.x, 400372.0, 50.0);
  EXPECT_NEAR(located.first().y + origin_m.y, 5500000.0, 400.0);
  EXPECT_EQ(Located(in_degrees(""), "EPSG:4326").first(), located.first());
  EXPECT_TRUE(located.report.problems().empty());
}

TEST(TreePlaces, AxesInTheOtherOrderAreTold) {
  SourceTrees swapped = in_degrees("EPSG:4326");
  for (Tree& tree : swapped.trees) tree.place = {tree.place.y, tree.place.x};
  const Located located(swapped, "");
  EXPECT_EQ(located.codes(), std::vector<int>{202});
  EXPECT_EQ(located.first(), Located(in_degrees("EPSG:4326"), "").first());
  EXPECT_TRUE(located.report.problems()[0].lon_lat_deg.has_value());
}

TEST(TreePlaces, GeoJsonInMetresNeedsACrs) {
  try {
    (void)Located(in_metres("EPSG:4326"), "");
    FAIL() << "metres are no degrees";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot be degrees"));
  }
  const Located located(in_metres("EPSG:4326"), "EPSG:25832");
  EXPECT_EQ(located.codes(), std::vector<int>{203});
  EXPECT_EQ(located.first(), (Point2d{100.0, 200.0}));
}

TEST(TreePlaces, DegreesWithoutANameAreRefused) {
  EXPECT_THROW((void)Located(in_degrees(""), ""), InputError);
  EXPECT_THROW((void)Located(in_degrees("EPSG:25832"), ""), InputError);
}

TEST(TreePlaces, UnknownCrsNeedsAnother) {
  EXPECT_THROW((void)Located(in_metres("no such thing"), ""), InputError);
  EXPECT_THROW((void)Located(in_metres(""), "no such thing"), InputError);
  EXPECT_EQ(Located(in_metres("no such thing"), "EPSG:25832").codes(), std::vector<int>{204});
}

TEST(TreePlaces, ThoseWithoutAPlaceAreLeftOutTogether) {
  SourceTrees trees = in_degrees("EPSG:4326");
  Tree lost;
  lost.place = {-170.0, 95.0};
  trees.trees.push_back(lost);
  trees.trees.push_back(lost);
  const Located located(trees, "");
  EXPECT_EQ(located.trees.trees.size(), 5U);
  EXPECT_EQ(located.codes(), std::vector<int>{201});
  EXPECT_THAT(located.report.problems()[0].detail, HasSubstr("2 of 7 trees"));
}

}  // namespace
}  // namespace farlod::georeference
