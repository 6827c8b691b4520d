// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_features.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

FieldType type_of_values(const std::vector<std::string>& values) {
  Attributes attributes({"a"});
  for (const std::string& value : values) attributes.add_row(std::vector<std::string>{value});
  return type_of_column(attributes, 0, values.size());
}

TEST(TypeOfColumn, IsOfNumbersWhereAllValuesAre) {
  EXPECT_EQ(type_of_values({"1", "-20", "", "9007199254740993"}), FieldType::whole);
  EXPECT_EQ(type_of_values({"1", "0.25", "1e-3", ""}), FieldType::real);
  EXPECT_EQ(type_of_values({"1", "0.25", "east"}), FieldType::text);
  EXPECT_EQ(type_of_values({"", ""}), FieldType::text);
}

TEST(TypeOfColumn, IsTextWhereANumberWouldNotComeBackAsItWas) {
  for (const char* text :
       {"007", "-01.5", "+1", "1,5", "0x10", "1 ", "inf", "nan", "3.14159265358979323846264338", "12.3.4", "-"})
    EXPECT_EQ(type_of_values({"1", text}), FieldType::text) << text;
  EXPECT_EQ(type_of_values({"0", "0.5", "-0.5"}), FieldType::real);
  // More than 64 bits
  EXPECT_EQ(type_of_values({"92233720368547758080"}), FieldType::real);
}

std::vector<SurfacePoint> rows_numbered(std::uint32_t first, std::size_t count) {
  std::vector<SurfacePoint> rows(count);
  for (std::size_t n = 0; n < count; ++n) {
    rows[n].building = std::string(n, 'b');
    rows[n].surface = first + static_cast<std::uint32_t>(n);
    rows[n].kind = SurfaceKind::roof;
    rows[n].p_projected = {1.25, 2.5, 3.75};
    rows[n].azimuth = Angle::degrees(90.0);
    rows[n].tilt = Angle::degrees(30.0);
    rows[n].area_m2 = 7.5;
    if (n % 2 == 0) rows[n].svf = 0.5;
    if (n % 2 == 1) rows[n].high = 0.75;
  }
  return rows;
}

TEST(SurfaceSpool, GivesRowsBackInTheOrderOfTheirParts) {
  const scenes::TemporaryFolder folder;
  SurfaceSpool spool(folder.file("a.gpkg"));
  std::vector<SurfacePoint> last = rows_numbered(100, 2);
  last[0].further = {0.5F, 1.5F};
  spool.add(9, last);
  spool.add(3, rows_numbered(50, 3));
  spool.add(5, {});
  EXPECT_EQ(spool.size(), 5U);
  std::vector<SurfacePoint> rows;
  spool.for_each([&](const SurfacePoint& row) { rows.push_back(row); });
  std::vector<SurfacePoint> expected = rows_numbered(50, 3);
  for (const SurfacePoint& row : last) expected.push_back(row);
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(rows[n].building, expected[n].building);
    EXPECT_EQ(rows[n].surface, expected[n].surface);
    EXPECT_EQ(rows[n].kind, expected[n].kind);
    EXPECT_EQ(rows[n].p_projected, expected[n].p_projected);
    EXPECT_EQ(rows[n].azimuth.degrees(), expected[n].azimuth.degrees());
    EXPECT_EQ(rows[n].tilt.degrees(), expected[n].tilt.degrees());
    EXPECT_EQ(rows[n].area_m2, expected[n].area_m2);
    EXPECT_EQ(rows[n].svf, expected[n].svf);
    EXPECT_EQ(rows[n].further, expected[n].further);
    EXPECT_EQ(rows[n].low, expected[n].low);
    EXPECT_EQ(rows[n].high, expected[n].high);
  }
}

}  // namespace
}  // namespace farlod
