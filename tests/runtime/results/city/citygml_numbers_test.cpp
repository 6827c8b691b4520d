// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "tests/runtime/results/city/citygml_samples.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Surfaces have the numbers that farlod-pack gives them (docs/stages/ingest.md).
class CityGmlNumbers : public CityGmlRun {};

TEST_F(CityGmlNumbers, SemanticSurfacesAreNumberedBeforeTheSolid) {
  // The solid, which comes first, refers to one surface and repeats another with other corners first; its floor is its own
  const std::string copy = "1020 2010 8 1010 2010 8 1010 2000 8 1020 2000 8 1020 2010 8";
  const std::string floor = "1000 2000 0 1000 2010 0 1020 2010 0 1020 2000 0 1000 2000 0";
  SurfaceMeans means = means_of(0, 1, 2);
  means.surfaces.push_back(mean(3, SurfaceKind::floor, 200.0, 0.1));
  means.surfaces.back().tilt = Angle::degrees(180.0);
  const std::string of_solid = solid(reference("p1") + polygon(copy) + reference("p3") + polygon(floor));
  EXPECT_EQ(enriched(file_with(of_solid + roofs_and_wall()), means),
            file_with(of_building() + of_solid + roofs_and_wall(of_roofs(), of_wall())));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 surface with values have no semantics")));
}

TEST_F(CityGmlNumbers, APolygonThatASolidHoldsIsTheSurfaceThatRefersToIt) {
  const std::string of_solid = solid(polygon(wall, "p3") + polygon(roof_2, "p2") + polygon(roof_1, "p1"));
  const auto surfaces = [](const std::string& roof, const std::string& below) {
    return surface("RoofSurface", roof, reference("p1") + reference("p2")) +
           surface("WallSurface", below, reference("p3") + reference("p1"));
  };
  EXPECT_EQ(enriched(file_with(of_solid + surfaces("", ""))),
            file_with(of_building() + of_solid + surfaces(of_roofs(), of_wall())));
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(CityGmlNumbers, UnusablePolygonsHaveNumbersAndThoseWithCurvesHaveNone) {
  const std::string line = polygon("1 2 3 4 5 6 1 2 3"), word = polygon("1000 two 3 4 5 6 7 8 9 1000 2 3");
  const std::string curve =
      "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:Ring><gml:curveMember/></gml:Ring></gml:exterior></gml:Polygon>"
      "</gml:surfaceMember>";
  const auto surfaces = [&](const std::string& roof, const std::string& below) {
    return surface("RoofSurface", roof, curve + line + polygon(roof_1) + word + polygon(roof_2)) +
           surface("WallSurface", below, polygon(wall));
  };
  EXPECT_EQ(enriched(file_with(surfaces("", "")), means_of(1, 3, 4)), file_with(of_building() + surfaces(of_roofs(), of_wall())));
}

TEST_F(CityGmlNumbers, FindsTheLevelOfDetailThatWasPacked) {
  // The finer level has the same surfaces with other numbers
  const auto text = [](const std::string& fine, const std::string& coarse) {
    return surface("WallSurface", fine, polygon(wall), "lod3MultiSurface") +
           surface("RoofSurface", "", polygon(roof_1) + polygon(roof_2), "lod3MultiSurface") +
           surface("RoofSurface", "", polygon(roof_1) + polygon(roof_2)) + surface("WallSurface", coarse, polygon(wall));
  };
  EXPECT_THAT(enriched(file_with(text("", "")), means_of(1, 2, 0)), HasSubstr("<bldg:WallSurface>" + of_wall() + "<bldg:lod3"));
  EXPECT_THAT(enriched(file_with(text("", "")), means_of(0, 1, 2)), HasSubstr("<bldg:WallSurface>" + of_wall() + "<bldg:lod2"));
}

TEST_F(CityGmlNumbers, PartsAndInstallationsHaveTheValuesOfTheirSurfaces) {
  const auto text = [](const std::string& of_part, const std::string& of_installation) {
    return "<bldg:outerBuildingInstallation><bldg:BuildingInstallation>" + of_installation +
           geometry("lod2Geometry", polygon(wall)) +
           "</bldg:BuildingInstallation></bldg:outerBuildingInstallation><bldg:consistsOfBuildingPart><bldg:BuildingPart>" +
           of_part + surface("RoofSurface", "", polygon(roof_1)) + geometry("lod2MultiSurface", polygon(roof_2)) +
           "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  };
  const std::string part =
      attributes({{"svf_roofs", "0.650000"}, {"roof_area_m2", "175"}, {"covered_roof_area_m2", "25"}}, form_2);
  const std::string installation =
      attributes({{"svf_walls", "0.250000"}, {"wall_area_m2", "80"}, {"covered_wall_area_m2", "0"}}, form_2);
  // Surfaces of the part without semantics come behind all others. The floor makes the level of the building itself eligible
  const std::string floor = surface("GroundSurface", "", polygon("1000 2000 0 1000 2010 0 1020 2000 0 1000 2000 0"));
  const std::string after = enriched(file_with(floor + text("", "")), means_of(2, 3, 1));
  EXPECT_THAT(after, HasSubstr("<bldg:BuildingInstallation>" + installation + "<bldg:lod2Geometry>"));
  EXPECT_THAT(after, HasSubstr("<bldg:BuildingPart>" + part + "<bldg:boundedBy>"));
  EXPECT_THAT(after, HasSubstr("<bldg:Building gml:id=\"b\">" + of_building()));
}

TEST_F(CityGmlNumbers, AWindowIsASurfaceOfItsOwn) {
  const std::string window =
      "<bldg:opening><bldg:Window>" + geometry("lod3MultiSurface", polygon(wall)) + "</bldg:Window></bldg:opening>";
  const auto text = [&](const std::string& of_window) {
    std::string inner = window;
    inner.insert(inner.find("<bldg:lod3"), of_window);
    return surface("RoofSurface", "", polygon(roof_1) + polygon(roof_2), "lod3MultiSurface") +
           "<bldg:boundedBy><bldg:WallSurface>" + inner + "</bldg:WallSurface></bldg:boundedBy>";
  };
  EXPECT_THAT(enriched(file_with(text(""))), HasSubstr("<bldg:WallSurface><bldg:opening><bldg:Window>" + of_wall()));
}

TEST_F(CityGmlNumbers, SurfacesThatStandInAnotherBuildingHaveNoValuesOfTheirOwn) {
  const std::string other = member(surface("WallSurface", "", polygon(wall, "w")), "c");
  const auto text = [&](const std::string& values, const std::string& roof) {
    return model(std::string(spaces_of_version_2) + generics_2,
                 member(values + surface("WallSurface", "", reference("w")) +
                        surface("RoofSurface", roof, polygon(roof_1) + polygon(roof_2))) +
                     other);
  };
  EXPECT_EQ(enriched(text("", ""), means_of(1, 2, 0)), text(of_building(), of_roofs()));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 surface with values have no semantics")));
}

TEST_F(CityGmlNumbers, APrototypeIsPlacedAndGivesValuesToItsInstallation) {
  const auto text = [](const std::string& values) {
    return roofs_and_wall() + "<bldg:outerBuildingInstallation><bldg:BuildingInstallation>" + values +
           "<bldg:lod2ImplicitRepresentation><ImplicitGeometry><transformationMatrix>2 0 0 0 0 2 0 0 1 0 2 3 0 0 0 1"
           "</transformationMatrix><relativeGMLGeometry><gml:MultiSurface>" +
           polygon("0 0 0 3 0 0 3 1 0 0 1 0 0 0 0") +
           "</gml:MultiSurface></relativeGMLGeometry><referencePoint><gml:Point><gml:pos>1000 2000 8</gml:pos></gml:Point>"
           "</referencePoint></ImplicitGeometry></bldg:lod2ImplicitRepresentation></bldg:BuildingInstallation>"
           "</bldg:outerBuildingInstallation>";
  };
  SurfaceMeans means = means_of(0, 1, 2);
  // Along x it rises by 1 in 2
  means.surfaces.push_back(mean(3, SurfaceKind::roof, 6.0 * std::sqrt(5.0), 0.9));
  means.surfaces.back().tilt = Angle::degrees(26.565);
  const std::string values =
      attributes({{"svf_roofs", "0.900000"}, {"roof_area_m2", "13.416"}, {"covered_roof_area_m2", "0"}}, form_2);
  EXPECT_THAT(enriched(file_with(text("")), means), HasSubstr("<bldg:BuildingInstallation>" + values));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 surface with values have no semantics")));
}

TEST_F(CityGmlNumbers, AWindowThatIsAPrototypeHasNoValues) {
  const std::string window =
      "<bldg:opening><bldg:Window><bldg:lod2ImplicitRepresentation><ImplicitGeometry><relativeGMLGeometry><gml:MultiSurface>" +
      polygon("0 0 0 0 10 0 0 10 8 0 0 8 0 0 0") +
      "</gml:MultiSurface></relativeGMLGeometry><referencePoint><gml:Point><gml:pos>1000 2000 0</gml:pos></gml:Point>"
      "</referencePoint></ImplicitGeometry></bldg:lod2ImplicitRepresentation></bldg:Window></bldg:opening>";
  const auto text = [&](const std::string& values, const std::string& of_roof) {
    return values + surface("RoofSurface", of_roof, polygon(roof_1) + polygon(roof_2)) + "<bldg:boundedBy><bldg:WallSurface>" +
           window + "</bldg:WallSurface></bldg:boundedBy>";
  };
  EXPECT_EQ(enriched(file_with(text("", ""))), file_with(text(of_building(), of_roofs())));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 surface with values have no semantics")));
}

TEST_F(CityGmlNumbers, APartThatLacksTheLevelOfTheOthersHasItsOwn) {
  const auto part = [](const std::string& content) {
    return "<bldg:consistsOfBuildingPart><bldg:BuildingPart>" + content + "</bldg:BuildingPart></bldg:consistsOfBuildingPart>";
  };
  // The shell of the building itself, which is coarser than its parts, is not packed
  const std::string after = enriched(file_with(surface("WallSurface", "", polygon(wall), "lod1MultiSurface") +
                                               part(surface("RoofSurface", "", polygon(roof_1) + polygon(roof_2))) +
                                               part(surface("WallSurface", "", polygon(wall), "lod1MultiSurface"))));
  EXPECT_THAT(after, HasSubstr("<bldg:RoofSurface>" + of_roofs()));
  EXPECT_THAT(after.substr(after.find("BuildingPart")), HasSubstr("<bldg:WallSurface>" + of_wall()));
  EXPECT_THAT(after.substr(0, after.find("BuildingPart")), HasSubstr("<bldg:WallSurface><bldg:lod1"));
}

TEST_F(CityGmlNumbers, WhatIsInsideTheBuildingHasNoNumbers) {
  const std::string room =
      "<bldg:interiorRoom><bldg:Room>" + surface("WallSurface", "", polygon(wall)) + "</bldg:Room></bldg:interiorRoom>";
  const std::string installation = "<bldg:buildingInstallation><bldg:BuildingInstallation>" +
                                   geometry("lod2MultiSurface", polygon(wall)) +
                                   "<bldg:relationToConstruction>inside</bldg:relationToConstruction>"
                                   "</bldg:BuildingInstallation></bldg:buildingInstallation>";
  const std::string inside = room + installation;
  EXPECT_EQ(enriched(file_with(inside + roofs_and_wall())),
            file_with(of_building() + inside + roofs_and_wall(of_roofs(), of_wall())));
}

TEST_F(CityGmlNumbers, OtherSurfacesAreRefused) {
  const std::string shifted = file_with(surface("WallSurface", "", polygon(wall)) + surface("RoofSurface", "", polygon(roof_1)));
  expect_refused(shifted, "cannot be found again");
}

}  // namespace
}  // namespace farlod
