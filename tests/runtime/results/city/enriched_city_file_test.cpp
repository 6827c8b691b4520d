// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/city/enriched_city_file.hpp"

#include <gmock/gmock.h>

#include <array>
#include <fstream>

#include "farlod/error.hpp"
#include "farlod/pack.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A roof of two squares of 100 m² (vertices 0 to 5), and a wall of 80 m² below one edge of it.
constexpr const char* roofs_and_wall = "[[[0,1,4,3]],[[1,2,5,4]],[[0,3,7,6]]]";
constexpr const char* vertices = "[[0,0,8],[10,0,8],[20,0,8],[0,10,8],[10,10,8],[20,10,8],[0,0,0],[0,10,0]]";

std::string file_with(const std::string& objects) {
  return "{\"type\":\"CityJSON\" , \"version\":\"2.0\",\n \"+extra\": {\"n\":[1.50e+1, 0.1000]},\"CityObjects\":{" + objects +
         "},\"vertices\":" + vertices + ",\"transform\":{\"scale\":[1.0,1,1],\"translate\":[500000,5500000.00,0]}}\n";
}
std::string geometry(const std::string& boundaries, const std::string& semantics) {
  return "{\"type\":\"MultiSurface\",\"lod\":\"2.2\",\"boundaries\":" + boundaries + semantics + "}";
}
std::string semantics_of(const std::string& roof, const std::string& wall) {
  return ",\"semantics\":{\"surfaces\":[{\"type\":\"RoofSurface\"" + roof + "}, { \"type\" : \"WallSurface\"" + wall +
         " }],\"values\":[0,0,1]}";
}
/// A building with these attributes (`"attributes":{…},` or nothing), and with attributes of its semantic surfaces; without its
/// last brace.
std::string building(const std::string& attributes, const std::string& roof = "", const std::string& wall = "") {
  return "\"b\" : {" + attributes + "\"type\":\"Building\",\"geometry\":[" + geometry(roofs_and_wall, semantics_of(roof, wall)) +
         "]";
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
  means.buildings = {{"b", 175.0, 80.0, 25.0, 0.0, 12, 1, 0.65, 0.25, {0}}};
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
  /// A package of a text.
  [[nodiscard]] Package packed(const std::string& text) const {
    std::ofstream(folder.file("a.city.json"), std::ios::binary) << text;
    PackSettings settings;
    settings.inputs = {folder.file("a.city.json")};
    settings.output = folder.file("a.farlod");
    settings.overwrite = Overwrite::replace;
    settings.crs = "EPSG:25832";
    Report report;
    (void)pack(settings, report);
    return Package(settings.output);
  }
  /// What becomes of a text.
  std::string enriched(const std::string& text, const SurfaceMeans& means = means_of_b(),
                       const AnswerColumns& columns = {"svf"}) {
    const Package package = packed(text);
    notes = EnrichedCityFile(package, "a.farlod", folder.file("a.city.json"), columns)
                .write(package, means, folder.file("b.city.json"));
    return scenes::text_of(folder.file("b.city.json"));
  }
  void expect_refused(const std::string& text, const std::string& said) {
    EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)enriched(text); }), HasSubstr(said));
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.city.json")));
  }

  scenes::TemporaryFolder folder;
  std::vector<std::string> notes;
};

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
}

TEST_F(EnrichedCityFileTest, WhatWasNotAskedForIsNotWritten) {
  SurfaceMeans roofs = means_of_b();
  roofs.surfaces.pop_back();
  roofs.buildings = {{"b", 175.0, 0.0, 25.0, 0.0, 8, 1, 0.65, {}, {0}}};
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

/// kWh/m² of two roofs and a wall, and what they come to.
SurfaceMeans irradiated_means() {
  SurfaceMeans means = means_of_b();
  const std::array<double, 3> kwh_m2{1000.0, 800.0, 500.0}, above_m2{100.0, 60.5, 0.0};
  for (std::size_t n = 0; n < 3; ++n) {
    means.surfaces[n].further_mean = {kwh_m2[n]};
    means.surfaces[n].irradiation = {kwh_m2[n] * means.surfaces[n].area_m2, above_m2[n]};
  }
  means.buildings[0].further_roofs = {160000.0 / 175.0};
  means.buildings[0].further_walls = {500.0};
  means.buildings[0].roof_irradiation = {160000.0, 160.5};
  means.buildings[0].wall_irradiation = {40000.0, 0.0};
  return means;
}

TEST_F(EnrichedCityFileTest, IrradiationIsSummedOverTheAreasOfASurface) {
  const AnswerColumns columns{"svf", BoundsColumns::no, {{"irradiation"}}, ThresholdColumns::yes};
  const std::string text = enriched(file_with(building("") + "}"), irradiated_means(), columns);
  EXPECT_THAT(text, HasSubstr(std::string(of_roof) +
                              ",\"irradiation_mean\":914.2857,\"irradiation_kwh\":160000,\"area_above_m2\":160.5}"));
  EXPECT_THAT(text,
              HasSubstr(std::string(of_wall) + ",\"irradiation_mean\":500,\"irradiation_kwh\":40000,\"area_above_m2\":0 }"));
  EXPECT_THAT(text, HasSubstr(std::string(of_building) +
                              ",\"irradiation_roofs\":914.2857,\"irradiation_walls\":500,\"roof_irradiation_kwh\":160000,"
                              "\"wall_irradiation_kwh\":40000,\"roof_area_above_m2\":160.5,\"wall_area_above_m2\":0}"));
}

TEST_F(EnrichedCityFileTest, APartHasTheIrradiationOfItsSurfaces) {
  const std::string roofs = geometry("[[[0,1,4,3]],[[1,2,5,4]]]", ""), wall = geometry("[[[0,3,7,6]]]", "");
  const std::string text = enriched(file_with("\"p\":{\"type\":\"BuildingPart\",\"parents\":[\"b\"],\"geometry\":[" + roofs +
                                              "]},\"b\":{\"type\":\"Building\"},\"q\":{\"type\":\"BuildingPart\",\"geometry\":[" +
                                              wall + "],\"parents\":[\"b\"]}"),
                                    irradiated_means(), {"svf", BoundsColumns::no, {{"irradiation"}}});
  EXPECT_THAT(text,
              HasSubstr(",\"covered_roof_area_m2\":25,\"irradiation_roofs\":914.2857,\"roof_irradiation_kwh\":160000}},\"b\""));
  EXPECT_THAT(text, HasSubstr(",\"covered_wall_area_m2\":0,\"irradiation_walls\":500,\"wall_irradiation_kwh\":40000}}}"));
}

TEST_F(EnrichedCityFileTest, PartsHaveTheValuesOfTheirSurfaces) {
  // The roofs are of one part, the wall of another
  const std::string roofs = geometry("[[[0,1,4,3]],[[1,2,5,4]]]", ",\"semantics\":{\"surfaces\":[{},{}],\"values\":[null,1]}");
  const std::string text = enriched(file_with("\"p\":{\"type\":\"BuildingPart\",\"parents\":[\"b\"],\"geometry\":[" + roofs +
                                              "]},\"b\":{\"type\":\"Building\"},\"q\":{\"type\":\"BuildingPart\",\"geometry\":[" +
                                              geometry("[[[0,3,7,6]]]", "") + "],\"parents\":[\"b\"]}"));
  EXPECT_THAT(text, HasSubstr("\"b\":{\"type\":\"Building\",\"attributes\":{" + std::string(of_building) + "}}"));
  EXPECT_THAT(text, HasSubstr("\"attributes\":{\"svf_roofs\":0.650000,\"roof_area_m2\":175,\"covered_roof_area_m2\":25}},\"b\""));
  EXPECT_THAT(text, HasSubstr("\"attributes\":{\"svf_walls\":0.250000,\"wall_area_m2\":80,\"covered_wall_area_m2\":0}}"));
  EXPECT_THAT(text, HasSubstr("[{},{\"svf_mean\":0.850000,"));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 surfaces with values have no semantics")));
}

TEST_F(EnrichedCityFileTest, APolygonOfTwoSemanticSurfacesGivesItsValuesToBoth) {
  const std::string again = geometry("[[[0,1,4,3]],[[1,2,5,4]],[[0,3,7,6]],[[0,3,7,6]]]",
                                     ",\"semantics\":{\"surfaces\":[{},{\"type\":\"WallSurface\"},{\"type\":\"WallSurface\"}],"
                                     "\"values\":[0,0,1,2]}");
  const std::string text = enriched(file_with("\"b\":{\"type\":\"Building\",\"geometry\":[" + again + "]}"));
  EXPECT_THAT(text,
              HasSubstr("{\"type\":\"WallSurface\"" + std::string(of_wall) + "},{\"type\":\"WallSurface\"" + of_wall + "}"));
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(EnrichedCityFileTest, AnObjectWithoutAPlaceIsToldOf) {
  const std::string text = file_with(building("\"attributes\":null,") + "}");
  EXPECT_EQ(enriched(text), file_with(building("\"attributes\":null,", of_roof, of_wall) + "}"));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 object has no place for attributes")));
}

TEST_F(EnrichedCityFileTest, BuildingsWithOneRowGetNothing) {
  SurfaceMeans means = means_of_b();
  means.buildings[0].building_numbers = {0, 7};
  const std::string text = file_with(building("") + "}");
  EXPECT_EQ(enriched(text, means), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file"), HasSubstr("1 building shares its id")));
}

TEST_F(EnrichedCityFileTest, AFileWithoutBuildingsOfTheRunComesBackAsItWas) {
  const std::string text = file_with(building("") + "}");
  EXPECT_EQ(enriched(text, {}), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file gets values")));
}

TEST_F(EnrichedCityFileTest, TheEndingOfTheOutputFits) {
  const Package package = packed(file_with(building("") + "}"));
  const EnrichedCityFile city(package, "a.farlod", folder.file("a.city.json"), {"svf"});
  EXPECT_NO_THROW(city.require_fitting("o.City.json"));
  for (const char* name : {"o.city.jsonl", "o.gml", "o.csv", ".city.json"}) EXPECT_THROW(city.require_fitting(name), OutputError);
}

TEST_F(EnrichedCityFileTest, NamesThatAreThereAreRefused) {
  expect_refused(file_with(building("\"attributes\":{\"svf_walls\":1},") + "}"), "has the name svf_walls already");
  expect_refused(file_with(building("", ",\"svf_mean\":1") + "}"), "has the name svf_mean already");
  // Across the end of a piece
  const std::string text = file_with(building("\"attributes\":{\"svf_walls\":1},") + "}");
  for (const std::size_t before : {0U, 1U, 5U, 10U})
    expect_refused(std::string((std::size_t{1} << 20) - text.find("svf_walls") - before, ' ') + text, "svf_walls already");
  // Part of another name, and no name
  EXPECT_NO_THROW((void)enriched(file_with(building("\"attributes\":{\"my_svf_walls\":\"the svf_walls\"},") + "}")));
}

TEST_F(EnrichedCityFileTest, AFileThatChangesMeanwhileIsRefused) {
  const Package package = packed(file_with(building("") + "}"));
  const EnrichedCityFile city(package, "a.farlod", folder.file("a.city.json"), {"svf"});
  std::ofstream(folder.file("a.city.json"), std::ios::app) << ' ';
  EXPECT_THROW((void)city.write(package, means_of_b(), folder.file("b.city.json")), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.city.json")));
}

}  // namespace
}  // namespace farlod
