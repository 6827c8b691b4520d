// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "citygml_text.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

const std::string outside = "<con:relationToConstruction>outside</con:relationToConstruction>";
const std::string inside = "<con:relationToConstruction>inside</con:relationToConstruction>";

TEST(CityGmlConstructions, ATunnelIsWhatOneSeesOfIt) {
  const std::string tunnel =
      "<tun:Tunnel>" + within("tun:boundedBy tun:RoofSurface", surface("tun:lod2MultiSurface", "r", "1")) +
      within("tun:boundedBy tun:InteriorWallSurface", surface("tun:lod2MultiSurface", "i", "2")) +
      within("tun:outerTunnelInstallation tun:TunnelInstallation", surface("tun:lod2Geometry", "portal", "3")) +
      within("tun:interiorHollowSpace tun:HollowSpace", surface("tun:lod2MultiSurface", "hollow", "4")) +
      within("tun:interiorTunnelInstallation tun:IntTunnelInstallation", surface("tun:lod2Geometry", "lamp", "5")) +
      within("tun:consistsOfTunnelPart tun:TunnelPart", surface("tun:lod2MultiSurface", "p", "6")) + "</tun:Tunnel>";
  const Reading r = read_citygml_text(model("<cityObjectMember>" + tunnel + "</cityObjectMember>"));
  ASSERT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(heights(r.city()), (std::vector<double>{1, 3, 6}));
  EXPECT_EQ(r.city().facets()[0].kind, SurfaceKind::roof);
  EXPECT_EQ(r.city().facets()[2].part, 1u);
  EXPECT_TRUE(r.codes().empty());
  EXPECT_TRUE(r.source.skipped.empty());
}

TEST(CityGmlConstructions, APartThatStandsAloneIsABuilding) {
  const std::string part = within("cityObjectMember tun:TunnelPart", surface("tun:lod1MultiSurface", "a", "1"));
  EXPECT_EQ(read_citygml_text(model(part)).city().buildings().size(), 1u);
}

TEST(CityGmlConstructions, OtherConstructionsStandOnTheirOwn) {
  const std::string wall = within("cityObjectMember con:OtherConstruction", surface("core:lod2MultiSurface", "a", "1"));
  const std::string generic = within("cityObjectMember gen:GenericOccupiedSpace", surface("core:lod2MultiSurface", "b", "2"));
  const Reading r = read_citygml_text(model_3(wall + generic));
  EXPECT_EQ(heights(r.city()), std::vector<double>{1});
  EXPECT_EQ(r.source.skipped, (SkippedFeatures{{"GenericOccupiedSpace", 1}}));
}

TEST(CityGmlConstructions, BuildingsOfVersion3) {
  const std::string window = within("con:fillingSurface con:WindowSurface", surface("core:lod3MultiSurface", "w", "2"));
  const std::string house =
      "<bldg:Building>" + within("core:boundary con:RoofSurface", surface("core:lod3MultiSurface", "r", "1") + window) +
      within("bldg:buildingInstallation bldg:BuildingInstallation",
             within("core:boundary con:WallSurface", surface("core:lod3MultiSurface", "i", "3")) + outside) +
      within("bldg:buildingConstructiveElement bldg:BuildingConstructiveElement",
             within("core:lod3Solid gml:Solid gml:exterior gml:Shell", member(polygon("e", "4")))) +
      within("bldg:buildingPart bldg:BuildingPart", surface("core:lod3MultiSurface", "p", "5")) +
      within("bldg:buildingRoom bldg:BuildingRoom", surface("core:lod3MultiSurface", "room", "6")) +
      within("bldg:buildingFurniture bldg:BuildingFurniture", surface("core:lod3MultiSurface", "chair", "7")) +
      within("bldg:buildingSubdivision bldg:Storey", surface("core:lod3MultiSurface", "storey", "8")) + "</bldg:Building>";
  const Reading r = read_citygml_text(model_3(within("cityObjectMember", house)));
  EXPECT_EQ(heights(r.city()), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(r.city().facets()[1].kind, SurfaceKind::wall) << "windows are walls";
  EXPECT_EQ(r.city().facets()[4].part, 1u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(CityGmlConstructions, WhatStandsInsideSaysSoBehindItsGeometry) {
  const auto installation = [](const std::string& id, const std::string& z, const std::string& relation) {
    return within("bldg:buildingInstallation bldg:BuildingInstallation", surface("core:lod2MultiSurface", id, z) + relation);
  };
  const std::string house = "<bldg:Building>" + surface("core:lod2MultiSurface", "a", "1") + installation("in", "2", inside) +
                            installation("out", "3", outside) + installation("unsaid", "4", "") + "</bldg:Building>";
  EXPECT_EQ(heights(read_citygml_text(model_3(within("cityObjectMember", house))).city()), (std::vector<double>{3, 4, 1}));
}

TEST(CityGmlConstructions, ABridgeMayConsistOfPylonsAndDecks) {
  const std::string pylons = within("brid:outerBridgeConstruction brid:BridgeConstructionElement",
                                    surface("brid:lod2Geometry", "c2", "2") + surface("brid:lod1Geometry", "c1", "1"));
  EXPECT_EQ(heights(read_citygml_text(model(within("cityObjectMember brid:Bridge", pylons))).city()), std::vector<double>{2});
  // Where the bridge has surfaces of its own, they decide the level of detail
  const std::string deck = surface("brid:lod1MultiSurface", "d", "5");
  EXPECT_EQ(heights(read_citygml_text(model(within("cityObjectMember brid:Bridge", pylons + deck))).city()),
            (std::vector<double>{1, 5}));
}

TEST(CityGmlConstructions, LevelZeroOfVersion3IsToldByItsSurfaces) {
  const std::string height = within("con:height con:Height", R"(<con:value uom="m">4</con:value>)");
  const std::string ground = within("core:boundary con:GroundSurface", surface("core:lod0MultiSurface", "g", "3"));
  const std::string roof = within("core:boundary con:RoofSurface", surface("core:lod0MultiSurface", "r", "10"));
  const std::string wall = within("core:boundary con:WallSurface", surface("core:lod0MultiSurface", "w", "20"));
  const auto top_and_floor = [&](const std::string& content) {
    const Reading r = read_citygml_text(model_3(within("cityObjectMember bldg:Building", height + content)), LodChoice{0});
    EXPECT_EQ(surface_count(r.city()), 5u);
    return std::pair(heights(r.city()).front(), heights(r.city()).back());
  };
  EXPECT_EQ(top_and_floor(ground + wall), std::pair(7.0, 3.0));
  EXPECT_EQ(top_and_floor(roof), std::pair(10.0, 6.0));
  EXPECT_EQ(top_and_floor(roof + ground), std::pair(7.0, 3.0)) << "the footprint goes before the roof edge";
  EXPECT_EQ(top_and_floor(surface("core:lod0MultiSurface", "b", "2")), std::pair(6.0, 2.0));
}

TEST(CityGmlConstructions, TheSameHouseInAllThreeVersions) {
  std::string text = model(building(bounded_by("RoofSurface", multi_surface("2", member(polygon("r", "6"))))));
  const auto replace_all = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  };
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
  replace_all("/2.0\"", "/1.0\"");
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
  replace_all("/1.0\"", "/3.0\"");
  replace_all("opengis.net/gml\"", "opengis.net/gml/3.2\"");
  EXPECT_EQ(heights(read_citygml_text(text).city()), std::vector<double>{6});
}

}  // namespace
}  // namespace farlod::ingest::test
