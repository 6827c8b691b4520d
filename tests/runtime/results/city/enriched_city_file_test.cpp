// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/enriched_city_file.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A roof of two squares of 100 m² (vertices 0 to 5), and a wall of 80 m² below one edge of it.
constexpr const char* roofs_and_wall = "[[[0,1,4,3]],[[1,2,5,4]],[[0,3,7,6]]]";
constexpr const char* vertices = "[[0,0,8],[10,0,8],[20,0,8],[0,10,8],[10,10,8],[20,10,8],[0,0,0],[0,10,0],[900,900,0]]";

std::string file_with(const std::string& objects) {
  return "{\"type\":\"CityJSON\" , \"version\":\"2.0\",\n \"+extra\": {\"n\":[1.50e+1, 0.1000]},\"CityObjects\":{" + objects +
         "},\"vertices\":" + vertices + ",\"transform\":{\"scale\":[1.0,1,1],\"translate\":[1000,2000.00,0]}}\n";
}

std::string geometry(const std::string& lod, const std::string& boundaries, const std::string& semantics) {
  return "{\"type\":\"MultiSurface\",\"lod\":\"" + lod + "\",\"boundaries\":" + boundaries + semantics + "}";
}

std::string semantics_of(const std::string& roof, const std::string& wall) {
  return ",\"semantics\":{\"surfaces\":[{\"type\":\"RoofSurface\"" + roof + "}, { \"type\" : \"WallSurface\"" + wall +
         " }],\"values\":[0,0,1]}";
}

SurfaceMean surface(std::uint32_t number, SurfaceKind kind, double area_m2, double svf) {
  SurfaceMean mean{"b", number, kind, {}, kind == SurfaceKind::wall ? Angle::degrees(90.0) : Angle{}, area_m2, 0.0, 4, 0};
  mean.svf_mean = svf;
  mean.svf_min = svf - 0.1;
  mean.svf_max = svf + 0.1;
  return mean;
}

/// What a run says of `roofs_and_wall`; a quarter of the second roof has no answer.
SurfaceMeans means_of_b() {
  SurfaceMeans means;
  means.surfaces = {surface(0, SurfaceKind::roof, 100.0, 0.5), surface(1, SurfaceKind::roof, 75.0, 0.85),
                    surface(2, SurfaceKind::wall, 80.0, 0.25)};
  means.surfaces[1].covered_area_m2 = 25.0;
  means.buildings = {{"b", 175.0, 80.0, 25.0, 0.0, 12, 1, 0.65, 0.25}};
  return means;
}

constexpr const char* of_building =
    "\"svf_roofs\":0.650000,\"svf_walls\":0.250000,\"roof_area_m2\":175,\"wall_area_m2\":80,\"covered_roof_area_m2\":25,"
    "\"covered_wall_area_m2\":0";
constexpr const char* of_roof =
    ",\"svf_mean\":0.650000,\"svf_min\":0.400000,\"svf_max\":0.950000,\"svf_area_m2\":175,\"covered_area_m2\":25";
constexpr const char* of_wall =
    ",\"svf_mean\":0.250000,\"svf_min\":0.150000,\"svf_max\":0.350000,\"svf_area_m2\":80,\"covered_area_m2\":0";

class EnrichedCityFileTest : public testing::Test {
 protected:
  /// What becomes of a text.
  std::string enriched(const std::string& text, const SurfaceMeans& means = means_of_b(),
                       const AnswerColumns& columns = {"svf"}) {
    std::ofstream(folder.file("a.city.json"), std::ios::binary) << text;
    notes = EnrichedCityFile(folder.file("a.city.json"), columns).write(means, extent, folder.file("b.city.json"));
    return scenes::text_of(folder.file("b.city.json"));
  }
  void expect_refused(const std::string& text, const std::string& said, const SurfaceMeans& means = means_of_b()) {
    try {
      (void)enriched(text, means);
      ADD_FAILURE() << "not refused: " << said;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(said));
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.city.json")));
  }

  scenes::TemporaryFolder folder;
  EnrichedExtent extent = EnrichedExtent::whole_buildings;
  std::vector<std::string> notes;
};

/// A building with these attributes (`"attributes":{…},` or nothing), and a geometry with attributes of its semantic surfaces.
std::string building(const std::string& attributes, const std::string& roof = "", const std::string& wall = "") {
  return "\"b\" : {" + attributes + "\"type\":\"Building\",\"geometry\":[" +
         geometry("2.2", roofs_and_wall, semantics_of(roof, wall)) + "]";
}

TEST_F(EnrichedCityFileTest, AddsAttributesAndLeavesTheRestAsItIs) {
  const std::string before = file_with(building("\"attributes\":{\"h\": 8.00 },") + "}");
  const std::string after =
      file_with(building("\"attributes\":{\"h\": 8.00," + std::string(of_building) + " },", of_roof, of_wall) + "}");
  EXPECT_EQ(enriched(before), after);
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(EnrichedCityFileTest, MakesAttributesWhereThereAreNone) {
  const std::string after = building("", of_roof, of_wall) + ",\"attributes\":{" + of_building + "}}";
  EXPECT_EQ(enriched(file_with(building("") + "}")), file_with(after));
  EXPECT_EQ(enriched(file_with(building("\"attributes\":{},") + "}")),
            file_with(building("\"attributes\":{" + std::string(of_building) + "},", of_roof, of_wall) + "}"));
}

TEST_F(EnrichedCityFileTest, AByteOrderMarkDoesNoHarm) {
  const std::string mark = "\xef\xbb\xbf", text = file_with(building("") + "}");
  EXPECT_EQ(enriched(mark + text), mark + enriched(text));
}

TEST_F(EnrichedCityFileTest, WhatWasNotAskedForIsNotWritten) {
  SurfaceMeans roofs = means_of_b();
  roofs.surfaces.pop_back();
  roofs.buildings = {{"b", 175.0, 0.0, 25.0, 0.0, 8, 1, 0.65, {}}};
  const std::string text = enriched(file_with(building("") + "}"), roofs);
  EXPECT_THAT(text, HasSubstr(of_roof));
  EXPECT_THAT(text, HasSubstr("\"attributes\":{\"svf_roofs\":0.650000,\"roof_area_m2\":175,\"covered_roof_area_m2\":25}"));
  EXPECT_THAT(text, HasSubstr("{ \"type\" : \"WallSurface\" }"));
}

TEST_F(EnrichedCityFileTest, FurtherQuantitiesAreWeightedByArea) {
  SurfaceMeans means = means_of_b();
  for (SurfaceMean& mean : means.surfaces) mean.further_mean = {*mean.svf_mean / 2.0};
  const std::string text = enriched(file_with(building("") + "}"), means, {"svf_solid", BoundsColumns::no, {{"svfN"}}});
  EXPECT_THAT(text, HasSubstr("\"svf_solid_roofs\":0.650000"));
  EXPECT_THAT(text, HasSubstr("\"svf_solid_mean\":0.250000"));
  EXPECT_THAT(text, HasSubstr("\"svfN_mean\":0.325}"));
  EXPECT_THAT(text, HasSubstr("\"svfN_mean\":0.125 }"));
}

TEST_F(EnrichedCityFileTest, PartsHaveTheValuesOfTheirSurfaces) {
  // The roofs are of the part; the building has a coarse shell, which does not count
  const std::string roofs =
      geometry("2", "[[[0,1,4,3]],[[1,2,5,4]]]", ",\"semantics\":{\"surfaces\":[{},{}],\"values\":[null,1]}");
  const std::string shell = geometry("1", "[[[0,2,5,3]]]", "");
  const std::string text = enriched(file_with("\"p\":{\"type\":\"BuildingPart\",\"parents\":[\"b\"],\"geometry\":[" + roofs +
                                              "]},\"b\":{\"type\":\"Building\",\"geometry\":[" + shell +
                                              "]},\"q\":{\"type\":\"BuildingPart\",\"geometry\":[" +
                                              geometry("2", "[[[0,3,7,6]]]", "") + "],\"parents\":[\"b\"]}"));
  EXPECT_THAT(text,
              HasSubstr("},\"b\":{\"type\":\"Building\",\"geometry\":[" + shell + "],\"attributes\":{" + of_building + "}}"));
  EXPECT_THAT(text, HasSubstr("\"attributes\":{\"svf_roofs\":0.650000,\"roof_area_m2\":175,\"covered_roof_area_m2\":25}},\"b\""));
  EXPECT_THAT(text, HasSubstr("\"attributes\":{\"svf_walls\":0.250000,\"wall_area_m2\":80,\"covered_wall_area_m2\":0}}"));
  EXPECT_THAT(text, HasSubstr("[{},{\"svf_mean\":0.850000,"));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 surfaces with values have no semantics")));
}

TEST_F(EnrichedCityFileTest, APolygonOfTwoGeometriesIsOneSurface) {
  // The second geometry repeats the roofs, the other way round, before its wall, which has the number 2 nevertheless
  const std::string first = geometry("2", "[[[0,1,4,3]],[[1,2,5,4]]]", "");
  const std::string second = geometry("2", "[[[3,4,1,0]],[[1,2,5,4]],[[0,3,7,6]]]", semantics_of("", ""));
  const std::string text = enriched(file_with("\"b\":{\"type\":\"Building\",\"geometry\":[" + first + "," + second + "]}"));
  EXPECT_THAT(text, HasSubstr("{\"type\":\"RoofSurface\"" + std::string(of_roof) + "}"));
  EXPECT_THAT(text, HasSubstr("{ \"type\" : \"WallSurface\"" + std::string(of_wall) + " }"));
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(EnrichedCityFileTest, FindsTheLevelOfDetailThatWasPacked) {
  const std::string finer = geometry("2", "[[[0,3,7,6]],[[0,1,4,3]],[[1,2,5,4]]]", semantics_of("", ""));
  const std::string coarse = geometry("1", roofs_and_wall, semantics_of("", ""));
  const std::string enriched_coarse = geometry("1", roofs_and_wall, semantics_of(of_roof, of_wall));
  EXPECT_THAT(enriched(file_with("\"b\":{\"type\":\"Building\",\"geometry\":[" + finer + "," + coarse + "]}")),
              HasSubstr(finer + "," + enriched_coarse));
}

TEST_F(EnrichedCityFileTest, BuildingsThatShareAnIdGetNothing) {
  const std::string text = file_with(building("") + "}," + building("") + "}");
  EXPECT_EQ(enriched(text), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file"), HasSubstr("2 buildings share their ids")));
}

TEST_F(EnrichedCityFileTest, ABuildingThatSharesItsIdWithOneOfAnotherFileGetsNothing) {
  std::string others;
  SurfaceMeans means = means_of_b();
  for (int n = 0; n < 40; ++n) {
    const std::string id = "c" + std::to_string(n);
    others += ",\"" + id + "\":{\"type\":\"Building\",\"geometry\":[" + geometry("2", "[[[0,1,4,3]]]", "") + "]}";
    means.surfaces.push_back(surface(0, SurfaceKind::roof, 100.0, 0.5));
    means.surfaces.back().building = id;
  }
  const std::string text = file_with(building("") + "}" + others);
  EXPECT_THAT(enriched(text, means), HasSubstr(of_roof));
  // The run adds the areas of both
  means.surfaces[0].area_m2 *= 2.0;
  means.surfaces[1].area_m2 *= 2.0;
  EXPECT_THAT(enriched(text, means), HasSubstr(building("") + "}"));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("1 building has other surfaces in the package")));
}

TEST_F(EnrichedCityFileTest, AFileWithoutBuildingsOfTheRunComesBackAsItWas) {
  const std::string text = file_with("\"tree\":{\"type\":\"SolitaryVegetationObject\"}");
  EXPECT_EQ(enriched(text), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file gets values")));
}

TEST_F(EnrichedCityFileTest, ASurfaceThatAMaskCutsKeepsItsValues) {
  SurfaceMeans means = means_of_b();
  for (SurfaceMean& mean : means.surfaces) mean.area_m2 *= 0.3;
  expect_refused(file_with(building("") + "}"), "cannot be found again", means);
  extent = EnrichedExtent::part_of_the_city;
  EXPECT_THAT(enriched(file_with(building("") + "}"), means), HasSubstr("\"svf_area_m2\":24,"));
}

/// A line of a CityJSONSeq.
std::string feature_with(const std::string& objects) {
  return "{\"type\":\"CityJSONFeature\",\"id\":\"f\",\"CityObjects\":{" + objects + "},\"vertices\":" + vertices + "}\r\n";
}

TEST_F(EnrichedCityFileTest, AddsAttributesToTheLinesOfASequence) {
  // Features have the transform of the first text; a line that is no feature stays as it is
  const std::string first = file_with(""), others = "\n{\"type\": \"CityJSONFea\n{\"type\":\"CityJSONFeature\"}\n";
  const std::string other = feature_with("\"c\":{\"type\":\"Building\"}");
  EXPECT_EQ(enriched(first + other + others + feature_with(building("") + "}")),
            first + other + others + feature_with(building("", of_roof, of_wall) + ",\"attributes\":{" + of_building + "}}"));
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(EnrichedCityFileTest, TheFirstTextOfASequenceHasBuildingsToo) {
  const std::string after = building("", of_roof, of_wall) + ",\"attributes\":{" + of_building + "}}", line = feature_with("");
  EXPECT_EQ(enriched(file_with(building("") + "}") + line), file_with(after) + line);
}

TEST_F(EnrichedCityFileTest, BuildingsOfASequenceThatShareAnIdGetNothing) {
  const std::string text = file_with("") + feature_with(building("") + "}") + feature_with(building("") + "}");
  EXPECT_EQ(enriched(text), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file"), HasSubstr("2 buildings share their ids")));
}

TEST_F(EnrichedCityFileTest, TheEndingOfTheOutputFits) {
  const auto fits = [&](const std::string& text, const char* name) {
    std::ofstream(folder.file("a.city.json"), std::ios::binary) << text;
    try {
      EnrichedCityFile(folder.file("a.city.json"), {"svf"}).require_fitting(name);
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("and comes back as such"));
      return false;
    }
    return true;
  };
  EXPECT_TRUE(fits(file_with(""), "o.City.json"));
  EXPECT_FALSE(fits(file_with(""), "o.city.jsonl"));
  EXPECT_FALSE(fits(file_with(""), "o.gml"));
  EXPECT_TRUE(fits(file_with("") + feature_with(""), "o.city.jsonl"));
  EXPECT_TRUE(fits(file_with("") + feature_with(""), "o.jsonl"));
  EXPECT_FALSE(fits(file_with("") + feature_with(""), "o.city.json"));
}

TEST_F(EnrichedCityFileTest, OtherSurfacesAreRefused) {
  const std::string text = file_with(building("") + "}");
  SurfaceMeans means = means_of_b();
  means.surfaces[2].tilt = Angle::degrees(70.0);
  expect_refused(text, "cannot be found again in", means);
  means = means_of_b();
  means.surfaces[2].surface = 3;
  expect_refused(text, "cannot be found again in", means);
  means = means_of_b();
  means.surfaces[0].kind = SurfaceKind::wall;
  expect_refused(text, "cannot be found again in", means);
}

TEST_F(EnrichedCityFileTest, WhatIsNoSuchFileIsRefused) {
  const std::string text = file_with(building("") + "}");
  expect_refused(text.substr(0, text.size() / 2), "cannot be enriched as CityJSON");
  expect_refused("{\"type\":\"FeatureCollection\"}", "there is no \"type\": \"CityJSON\"");
  expect_refused(text + "[]\n", "there is more text behind its end");
  expect_refused(file_with(building("\"attributes\":{\"svf_walls\":1},") + "}"),
                 "the building b has the attribute svf_walls already");
  expect_refused(file_with(building("", ",\"svf_mean\":1") + "}"), "the building b has the attribute svf_mean already");
}

}  // namespace
}  // namespace farlod
