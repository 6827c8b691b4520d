// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "ingest/citygml/citygml_placement.hpp"

namespace farlod::ingest::test {
namespace {

const std::string matrix_turned = "0 -2 0 1  2 0 0 2  0 0 2 3  0 0 0 1";  // a quarter turn, twice as large, moved by 1, 2, 3

std::string matrix(const std::string& numbers) { return within("core:transformationMatrix", numbers); }
std::string reference_point(const std::string& position) { return within("core:referencePoint gml:Point gml:pos", position); }
std::string prototype(const std::string& id) {
  return R"(<core:relativeGMLGeometry><gml:MultiSurface gml:id=")" + id + R"(">)" + member(polygon(id + "_polygon", "5")) +
         "</gml:MultiSurface></core:relativeGMLGeometry>";
}
std::string dormer(const std::string& content) {
  return within("bldg:outerBuildingInstallation bldg:BuildingInstallation bldg:lod2ImplicitRepresentation core:ImplicitGeometry",
                content);
}
const std::string walls = surface("bldg:lod2MultiSurface", "walls", "0");

std::vector<Point3d> first_ring(const CityModel& city) {
  const auto ring = city.ring(city.facets()[0], 0);
  return {ring.begin(), ring.end()};
}

TEST(CityGmlPrototypes, AMatrixTurnsAndAPointMoves) {
  const Reading r = read_citygml_text(
      model(building(dormer(matrix(matrix_turned) + prototype("p") + reference_point("1000 2000 30")) + walls)));
  ASSERT_EQ(r.city().facets().size(), 2u);
  // (0 0 5), (9 0 5), (9 9 5): x' = -2y + 1 + 1000, y' = 2x + 2 + 2000, z' = 2z + 3 + 30
  EXPECT_EQ(first_ring(r.city()), (std::vector<Point3d>{{1001, 2002, 43}, {1001, 2020, 43}, {983, 2020, 43}}));
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlPrototypes, APrototypeIsThereOnceForEachOfItsPlaces) {
  const std::string again = R"(<core:relativeGMLGeometry xlink:href="#p"/>)";
  const std::string first = dormer(prototype("p") + reference_point("1000 2000 30"));
  const std::string second = dormer(again + reference_point("1000 2000 40"));
  const Reading r = read_citygml_text(model(building(first + second + walls) + building(second + walls, "neighbor")));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{35, 45, 0, 45, 0})) << "the neighbor refers to another building's";
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlPrototypes, ThePlacesOfAPrototypeAreNoCopiesOfEachOther) {
  const auto placed = [](const std::string& geometry, const std::string& position) {
    return within("bldg:lod2ImplicitRepresentation core:ImplicitGeometry", geometry + reference_point(position));
  };
  const std::string again = R"(<core:relativeGMLGeometry xlink:href="#p"/>)";
  const Reading r = read_citygml_text(model(building(placed(prototype("p"), "1000 2000 30") + placed(again, "1000 2000 40"))));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{35, 45}));
}

TEST(CityGmlPrototypes, Version3NamesItOtherwise) {
  const std::string text = within(
      "cityObjectMember brid:Bridge brid:bridgeConstructiveElement brid:BridgeConstructiveElement "
      "core:lod1ImplicitRepresentation "
      "core:ImplicitGeometry",
      matrix("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") + reference_point("1000 2000 30") + surface("core:relativeGeometry", "p", "7"));
  EXPECT_EQ(heights(read_citygml_text(model_3(text)).city()), std::vector<double>{37});
}

TEST(CityGmlPrototypes, AMirrorKeepsOutsideOutside) {
  const Reading r = read_citygml_text(model(
      building(dormer(matrix("-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1") + prototype("p") + reference_point("1000 2000 30")) + walls)));
  EXPECT_GT(double_area_vector(r.city(), r.city().facets()[0]).z, 0.0);
}

/// What is said of a dormer that cannot be placed; the house remains.
std::string said_of(const std::string& content) {
  const Reading r = read_citygml_text(model(building(dormer(content) + walls)));
  EXPECT_EQ(r.city().facets().size(), 1u);
  EXPECT_EQ(r.codes(), std::set<int>{112});
  return r.report.problems().size() == 1 ? r.report.problems()[0].detail : "";
}

TEST(CityGmlPrototypes, WhatCannotBePlacedIsReported) {
  const std::string place = reference_point("1000 2000 30");
  EXPECT_NE(said_of(prototype("p") + reference_point("139.7 35.6 30")).find("degrees"), std::string::npos);
  EXPECT_NE(said_of(prototype("p")).find("referencePoint"), std::string::npos);
  EXPECT_NE(said_of(prototype("p") + reference_point("1000 2000")).find("referencePoint"), std::string::npos);
  EXPECT_NE(said_of(matrix("1 2 3") + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of(matrix(matrix_turned + " 1") + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of(matrix("x" + matrix_turned.substr(1)) + prototype("p") + place).find("16 numbers"), std::string::npos);
  EXPECT_NE(said_of("<core:libraryObject>http://a/tree.dae</core:libraryObject>" + place).find("libraryObject"),
            std::string::npos);
  EXPECT_NE(said_of("").find("lod2ImplicitRepresentation"), std::string::npos);
}

TEST(CityGmlPrototypes, NumbersWithinNumbersAreNone) {
  EXPECT_NE(said_of("<core:transformationMatrix>1<gml:pos>1 2 3</gml:pos>2</core:transformationMatrix>" + prototype("p") +
                    reference_point("1000 2000 30"))
                .find("16 numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace farlod::ingest::test
