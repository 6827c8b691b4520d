// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <regex>

#include "archive_writer.hpp"
#include "citygml_text.hpp"
#include "marked_text.hpp"

namespace farlod::ingest::test::citygml_places {
namespace {

using testing::HasSubstr;

/// Of a file without byte places: the building itself is nowhere.
void expect_no_places(const Reading& reading) {
  EXPECT_FALSE(reading.source.placed.has_value());
  const auto origin = package::origin_from(reading.city().origin_of(reading.city().buildings().front()));
  ASSERT_TRUE(origin.has_value());
  EXPECT_EQ(origin->objects, std::vector{AttributePlace{}});
  EXPECT_TRUE(origin->semantics.empty() && origin->surfaces.empty());
  EXPECT_EQ(origin->ids.size(), 3U);
}

/// Two roofs, and a wall below one of them.
constexpr const char *roof_1 = "1000 2000 8 1010 2000 8 1010 2010 8 1000 2010 8 1000 2000 8",
                     *roof_2 = "1010 2000 8 1020 2000 8 1020 2010 8 1010 2010 8 1010 2000 8",
                     *wall = "1000 2000 0 1000 2010 0 1000 2010 8 1000 2000 8 1000 2000 0";

constexpr const char* spaces_of_version_2 =
    "xmlns=\"http://www.opengis.net/citygml/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
    "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\"";
constexpr const char* generics_2 = " xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\"";

std::string model(const std::string& spaces, const std::string& members) {
  return "<?xml version='1.0'?>\n<CityModel " + spaces + ">" + members + "</CityModel>\n";
}
std::string file_with(const std::string& content) {
  return model(std::string(spaces_of_version_2) + generics_2, building(content));
}
std::string polygon(const std::string& corners, const std::string& id = "") {
  return "<gml:surfaceMember><gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
         "><gml:exterior><gml:LinearRing><gml:posList>" + corners +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}
std::string geometry(const std::string& property, const std::string& members) {
  return within("bldg:" + property + " gml:MultiSurface", members);
}
/// The same file in another version of CityGML.
std::string in_version(const std::string& version, std::string text) {
  for (std::size_t at = text.find("/2.0\""); at != text.npos; at = text.find("/2.0\"")) text.replace(at + 1, 3, version);
  return text;
}
/// A semantic surface; `mark` stands where generic attributes belong.
std::string surface(const std::string& name, const std::string& mark, const std::string& members,
                    const std::string& property = "lod2MultiSurface") {
  return bounded_by(name, mark + geometry(property, members));
}
std::string roofs_and_wall(const std::string& of_roof = "", const std::string& of_wall = "") {
  return surface("RoofSurface", of_roof, polygon(roof_1, "p1") + polygon(roof_2, "p2")) +
         surface("WallSurface", of_wall, polygon(wall, "p3"));
}

/// An attribute as `form` writes it: "@" is the name, "#" the value.
constexpr const char* form_2 = "<gen:doubleAttribute name=\"@\"><gen:value>#</gen:value></gen:doubleAttribute>";
std::string written(const std::string& name, const std::string& value, std::string form) {
  form.replace(form.find('@'), 1, name);
  return form.replace(form.find('#'), 1, value);
}
std::string id(const std::string& value = "b", const std::string& form = form_2) { return written("id", value, form); }
std::string surfaces(const std::string& numbers, const std::string& form = form_2) { return written("surfaces", numbers, form); }

std::string marked_gml(const std::string& text, const IngestSettings& settings = {}) {
  return marked_text("a.gml", text, settings);
}

/// Surfaces are numbered as the marks of a building's content say, "{0+1}"; without these, it is the file.
void expect_numbers(const std::string& content, const IngestSettings& settings = {}) {
  static const std::regex mark("\\{([0-9+]+)\\}");
  EXPECT_EQ(marked_gml(file_with(std::regex_replace(content, mark, "")), settings),
            file_with(id() + std::regex_replace(content, mark, surfaces("$1"))));
}

TEST(CityGmlPlaces, AreWhereTheSchemaHasGenericAttributes) {
  const std::string head =
      "\n <gml:description>x</gml:description><gml:name>y</gml:name> <gml:boundedBy><gml:Null/></gml:boundedBy>"
      "<creationDate>2020-01-01</creationDate><externalReference><externalObject><name>z</name></externalObject>"
      "</externalReference><relativeToTerrain>entirelyAboveTerrain</relativeToTerrain>"
      "<gen:stringAttribute name=\"owner\"><gen:value>o</gen:value></gen:stringAttribute>";
  const std::string tail = "\n <!-- class --> <bldg:class>1000</bldg:class><gml:name>late</gml:name>";
  const std::string name = "<gml:name>w</gml:name>";
  EXPECT_EQ(marked_gml(file_with(head + tail + roofs_and_wall("", name))),
            file_with(head + id() + tail + roofs_and_wall(surfaces("0+1"), name + surfaces("2"))));
}

TEST(CityGmlPlaces, AreBeforeAnAppearance) {
  const std::string appearance = "<app:appearance xmlns:app=\"http://www.opengis.net/citygml/appearance/2.0\"/>";
  EXPECT_EQ(marked_gml(file_with(appearance + roofs_and_wall())),
            file_with(id() + appearance + roofs_and_wall(surfaces("0+1"), surfaces("2"))));
}

TEST(CityGmlPlaces, HaveThePrefixOfTheFileOrDeclareOne) {
  const std::string space = "=\"http://www.opengis.net/citygml/generics/2.0\"";
  const auto text = [](const std::string& spaces) { return model(spaces_of_version_2 + spaces, building(roofs_and_wall())); };
  const std::string declared =
      "<gen:doubleAttribute xmlns:gen" + space + " name=\"@\"><gen:value>#</gen:value></gen:doubleAttribute>";
  // Without one, where "gen" stands for something else, and where the prefix cannot be written in each encoding
  for (const std::string& spaces : {std::string(), std::string(" xmlns:gen=\"urn:other\""), " xmlns:\xc3\xa4" + space})
    EXPECT_THAT(marked_gml(text(spaces)), HasSubstr(id("b", declared) + "<bldg:boundedBy>"));
  EXPECT_THAT(marked_gml(text(" xmlns:g" + space)),
              HasSubstr(id("b", "<g:doubleAttribute name=\"@\"><g:value>#</g:value></g:doubleAttribute>")));
  // A prefix holds within its element alone
  const std::string rebound = "<bldg:WallSurface xmlns:gen=\"urn:other\">";
  std::string inner = file_with(roofs_and_wall());
  inner.replace(inner.find("<bldg:WallSurface>"), 18, rebound);
  EXPECT_THAT(marked_gml(inner), HasSubstr(rebound + surfaces("2", declared)));
  EXPECT_THAT(marked_gml(inner), HasSubstr("<bldg:Building gml:id=\"b\">" + id()));
}

TEST(CityGmlPlaces, HaveTheAttributesOfTheVersion) {
  EXPECT_THAT(marked_gml(in_version("1.0", file_with(roofs_and_wall()))), HasSubstr("<bldg:RoofSurface>" + surfaces("0+1")));
  const std::string form =
      "<genericAttribute><gen:DoubleAttribute><gen:name>@</gen:name><gen:value>#</gen:value></gen:DoubleAttribute>"
      "</genericAttribute>";
  const std::string third = in_version("3.0", file_with("<genericAttribute/><dynamizer/>" + roofs_and_wall()));
  EXPECT_THAT(marked_gml(third), HasSubstr("<bldg:RoofSurface>" + surfaces("0+1", form)));
  EXPECT_THAT(marked_gml(third), HasSubstr("<genericAttribute/>" + id("b", form) + "<dynamizer/>"));
}

TEST(CityGmlPlaces, AreNowhereInAVersionWithoutSuchAttributes) {
  const std::string text = in_version("9.0", file_with(roofs_and_wall()));
  EXPECT_EQ(marked_gml(text), text);
}

TEST(CityGmlPlaces, AreBytesOfTheFileInEachEncoding) {
  const std::string street = "<gml:name>K\xf6ln</gml:name>";
  std::string text = file_with(street + roofs_and_wall()),
              expected = file_with(street + id() + roofs_and_wall(surfaces("0+1"), surfaces("2")));
  for (std::string* file : {&text, &expected}) file->insert(file->find("?>"), " encoding='ISO-8859-1'");
  EXPECT_EQ(marked_gml(text), expected);
  // iconv knows it, Expat does not
  for (std::string* file : {&text, &expected}) file->replace(file->find("ISO-8859-1"), 10, "windows-1252");
  EXPECT_EQ(marked_gml(text), expected);
  const std::string plain = file_with(roofs_and_wall()), mark = "\xef\xbb\xbf";
  EXPECT_EQ(marked_gml(mark + plain), mark + marked_gml(plain));
  EXPECT_EQ(marked_gml(" \r\n" + plain), " \r\n" + marked_gml(plain));
}

TEST(CityGmlPlaces, AreNowhereInWhatIsPackedOrWide) {
  const std::string text = file_with(roofs_and_wall());
  EXPECT_TRUE(read_text("a.gml", text).source.placed.has_value());
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  for (const Reading& reading : {read_text("wide.gml", wide), read_text("bare.gml", wide.substr(2))}) expect_no_places(reading);
  const auto gz = write_file("a.gml.gz", gzip_of(text));
  Reading packed;
  packed.source = ingest(InputFile(gz.string(), "/vsigzip/" + gz.string(), gz), {}, packed.report);
  expect_no_places(packed);
}

const std::string numbered = roofs_and_wall("{0+1}", "{2}");

TEST(CityGmlOrigins, SemanticSurfacesAreNumberedBeforeTheSolid) {
  // The solid, which comes first, refers to one surface and repeats another with other corners first; its floor is its own
  const std::string copy = "1020 2010 8 1010 2010 8 1010 2000 8 1020 2000 8 1020 2010 8";
  const std::string floor = "1000 2000 0 1000 2010 0 1020 2010 0 1020 2000 0 1000 2000 0";
  expect_numbers(solid("2", reference("p1") + polygon(copy) + reference("p3") + polygon(floor)) + numbered);
}

TEST(CityGmlOrigins, APolygonThatASolidHoldsIsTheSurfaceThatRefersToIt) {
  expect_numbers(solid("2", polygon(wall, "p3") + polygon(roof_2, "p2") + polygon(roof_1, "p1")) +
                 surface("RoofSurface", "{0+1}", reference("p1") + reference("p2")) +
                 surface("WallSurface", "{2}", reference("p3") + reference("p1")));
}

TEST(CityGmlOrigins, APolygonThatTwoSurfacesHoldIsOfBoth) {
  expect_numbers(surface("RoofSurface", "{0+1}", polygon(roof_1) + polygon(wall)) +
                 surface("RoofSurface", "{0+3}", polygon(roof_1) + polygon(roof_2)));
}

TEST(CityGmlOrigins, UnusablePolygonsHaveNumbersAndThoseWithCurvesHaveNone) {
  const std::string line = polygon("1 2 3 4 5 6 1 2 3"), word = polygon("1000 two 3 4 5 6 7 8 9 1000 2 3");
  const std::string curve = within("gml:surfaceMember gml:Polygon gml:exterior gml:Ring", "<gml:curveMember/>");
  expect_numbers(surface("RoofSurface", "{1+3}", curve + line + polygon(roof_1) + word + polygon(roof_2)) +
                 surface("WallSurface", "{4}", polygon(wall)));
}

TEST(CityGmlOrigins, AreThoseOfTheLevelOfDetailThatIsRead) {
  const auto text = [](const std::string& fine, const std::string& coarse) {
    return surface("WallSurface", fine, polygon(wall), "lod3MultiSurface") + surface("WallSurface", coarse, polygon(wall));
  };
  expect_numbers(text("{0}", ""));
  expect_numbers(text("", "{0}"), in_lod(2));
}

TEST(CityGmlOrigins, PartsAndInstallationsHaveTheirSurfaces) {
  // Surfaces of the part without semantics come behind all others. The floor makes the level of the building itself eligible
  expect_numbers(
      surface("GroundSurface", "{0}", polygon("1000 2000 0 1000 2010 0 1020 2000 0 1000 2000 0")) +
      within("bldg:outerBuildingInstallation bldg:BuildingInstallation", "{1}" + geometry("lod2Geometry", polygon(wall))) +
      within("bldg:consistsOfBuildingPart bldg:BuildingPart",
             "{2+3}" + surface("RoofSurface", "{2}", polygon(roof_1)) + geometry("lod2MultiSurface", polygon(roof_2))));
}

TEST(CityGmlOrigins, AWindowIsASurfaceOfItsOwn) {
  expect_numbers(
      surface("RoofSurface", "{0+1}", polygon(roof_1) + polygon(roof_2), "lod3MultiSurface") +
      within("bldg:boundedBy bldg:WallSurface bldg:opening bldg:Window", "{2}" + geometry("lod3MultiSurface", polygon(wall))));
}

TEST(CityGmlOrigins, SurfacesThatStandInAnotherBuildingHaveNoSemanticsHere) {
  const auto text = [](const std::string& b, const std::string& roof, const std::string& c, const std::string& of_wall) {
    return model(std::string(spaces_of_version_2) + generics_2,
                 building(b + surface("WallSurface", "", reference("w")) +
                          surface("RoofSurface", roof, polygon(roof_1) + polygon(roof_2))) +
                     building(c + surface("WallSurface", of_wall, polygon(wall, "w")), "c"));
  };
  EXPECT_EQ(marked_gml(text("", "", "", "")), text(id(), surfaces("1+2"), id("c"), surfaces("0")));
}

TEST(CityGmlOrigins, APrototypeIsOfItsInstallationAndOfNoSemanticSurface) {
  const auto prototype = [](const std::string& x) {
    return within("bldg:lod2ImplicitRepresentation ImplicitGeometry",
                  within("relativeGMLGeometry gml:MultiSurface", polygon("0 0 0 3 0 0 3 1 0 0 1 0 0 0 0")) +
                      within("referencePoint gml:Point gml:pos", x + " 2000 8"));
  };
  const auto text = [&](const std::string& mark, const std::string& x) {
    return numbered + within("bldg:boundedBy bldg:WallSurface bldg:opening bldg:Window", prototype("1000")) +
           within("bldg:outerBuildingInstallation bldg:BuildingInstallation", mark + prototype(x));
  };
  // Where the two lie in the same place, the second is the first once more
  expect_numbers(text("", "1000"));
  expect_numbers(text("{4}", "1100"));
}

TEST(CityGmlOrigins, WhatIsInsideTheBuildingHasNone) {
  expect_numbers(within("bldg:interiorRoom bldg:Room", surface("WallSurface", "", polygon(wall))) +
                 within("bldg:buildingInstallation bldg:BuildingInstallation",
                        geometry("lod2MultiSurface", polygon(wall)) + within("bldg:relationToConstruction", "inside")) +
                 numbered);
}

TEST(CityGmlOrigins, AFootprintGivesSurfacesToItsPart) {
  expect_numbers(within("bldg:consistsOfBuildingPart bldg:BuildingPart",
                        "{0+1+2+3+4}" + within("bldg:measuredHeight", "8") +
                            geometry("lod0FootPrint", polygon("1000 2000 0 1010 2000 0 1010 2010 0 1000 2000 0"))),
                 in_lod(0));
}

}  // namespace
}  // namespace farlod::ingest::test::citygml_places
