// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Six houses of 10 m × 10 m in a row, with a number each in a field; outlines at `z` above it, or flat.
std::string houses(const std::string& field, double first, std::optional<double> z = {}) {
  std::vector<std::string> features;
  for (int n = 0; n < 6; ++n) {
    const double x = 690'000.0 + 30.0 * n, value = first + n;
    const auto corner = [&](double dx, double dy) {
      return "[" + std::to_string(x + dx) + "," + std::to_string(5'335'000.0 + dy) + (z ? "," + std::to_string(value + *z) : "") +
             "]";
    };
    features.push_back(feature(
        "\"" + field + "\":" + std::to_string(value), "Polygon",
        "[[" + corner(0, 0) + "," + corner(10, 0) + "," + corner(10, 10) + "," + corner(0, 10) + "," + corner(0, 0) + "]]"));
  }
  return collection(features, R"("crs":{"type":"name","properties":{"name":"EPSG:25832"}},)");
}

IngestSettings with_heights_in(const std::string& field) {
  IngestSettings settings;
  settings.footprints.height_field = field;
  return settings;
}

std::string refusal(const std::string& text, const IngestSettings& settings = {}) {
  return scenes::refusal_of<InputError>([&] { (void)read_text("a.geojson", text, settings); });
}

TEST(FootprintElevations, AreNoHeights) {
  const std::string text = houses("Elevation", 122.0, 0.0);
  EXPECT_THAT(refusal(text, with_heights_in("Elevation")),
              AllOf(HasSubstr("a.geojson: Elevation holds elevations"), HasSubstr("--roof-field Elevation"),
                    HasSubstr("--terrain"), HasSubstr("--base-field")));
  EXPECT_THAT(refusal(houses("height", 122.0)), HasSubstr("--roof-field height")) << "a name that is known for heights";
  EXPECT_EQ(refusal(houses("height", 12.0, 520.0)), "no refusal");
  EXPECT_EQ(refusal(houses("height", 12.0, 0.0)), "no refusal");
  IngestSettings roofs;
  roofs.footprints.roof_field = "Elevation";
  EXPECT_EQ(read_text("a.geojson", text, roofs).city().buildings()[0].height_reference, HeightReference::down_to_ground);
}

TEST(FootprintElevations, AreOfferedWhereNoHeightIsKnown) {
  EXPECT_THAT(refusal(houses("Elevation", 122.0)),
              AllOf(HasSubstr("fields with numbers: Elevation"), HasSubstr("--roof-field"), HasSubstr("--base-field")));
}

/// A house with some fields of heights.
std::string house(int n, const std::string& fields) {
  const std::string x = std::to_string(11.0 + 0.001 * n), east = std::to_string(11.0001 + 0.001 * n);
  return feature("\"id\":\"" + std::to_string(n) + "\"," + fields, "Polygon",
                 "[[[" + x + ",48],[" + east + ",48],[" + east + ",48.0001],[" + x + ",48]]]");
}

TEST(FootprintElevations, BasesOfZeroAmongHighOnesAreUnknown) {
  IngestSettings settings;
  settings.footprints.base_field = "base";
  settings.footprints.height_field = "h";
  const auto read = [&](const std::string& first_base) {
    return read_text(
        "a.geojson",
        collection({house(0, R"("h":9,"base":)" + first_base), house(1, R"("h":9,"base":512)"), house(2, R"("h":9,"base":515)")}),
        settings);
  };
  const Reading r = read("0");
  EXPECT_EQ(r.city().buildings().size(), 2U);
  ASSERT_EQ(r.report.problems().size(), 1U);
  EXPECT_EQ(r.report.problems()[0].code, ProblemCode::no_height);
  EXPECT_THAT(r.report.problems()[0].detail, HasSubstr("base is 0, and all others are far above that"));
  EXPECT_EQ(read("499").city().buildings().size(), 3U);
}

TEST(FootprintElevations, RoofsThatLieNowhereGiveWayToOtherHeights) {
  IngestSettings settings;
  settings.footprints.base_field = "base";
  settings.footprints.roof_field = "roof";
  const std::vector<std::string> houses{house(0, R"("roof":-9999,"base":500,"levels":4)"),
                                        house(1, R"("roof":509,"base":500,"levels":9)")};
  const Reading r = read_text("a.geojson", collection(houses), settings);
  ASSERT_EQ(r.city().buildings().size(), 2U);
  double highest = 0.0;
  for (const Point3d& p : r.city().points_of(r.city().buildings()[0])) highest = std::max(highest, p.z);
  EXPECT_EQ(highest, 512.0);
  EXPECT_TRUE(r.codes().empty());
}

}  // namespace
}  // namespace farlod::ingest::test
