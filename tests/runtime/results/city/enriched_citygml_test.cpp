// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/runtime/results/city/citygml_samples.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class EnrichedCityGml : public CityGmlRun {};

TEST_F(EnrichedCityGml, AddsGenericAttributesWhereTheSchemaHasThem) {
  const std::string head =
      "\n <gml:description>x</gml:description><gml:name>y</gml:name> <gml:boundedBy><gml:Null/></gml:boundedBy>"
      "<creationDate>2020-01-01</creationDate><externalReference><externalObject><name>z</name></externalObject>"
      "</externalReference><relativeToTerrain>entirelyAboveTerrain</relativeToTerrain>"
      "<gen:stringAttribute name=\"owner\"><gen:value>o</gen:value></gen:stringAttribute>";
  const std::string tail = "\n <!-- class --> <bldg:class>1000</bldg:class><gml:name>late</gml:name>";
  const std::string name = "<gml:name>w</gml:name>";
  EXPECT_EQ(enriched(file_with(head + tail + roofs_and_wall("", name))),
            file_with(head + of_building() + tail + roofs_and_wall(of_roofs(), name + of_wall())));
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(EnrichedCityGml, AnAppearanceComesBehindGenericAttributes) {
  const std::string appearance = "<app:appearance xmlns:app=\"http://www.opengis.net/citygml/appearance/2.0\"/>";
  EXPECT_EQ(enriched(file_with(appearance + roofs_and_wall())),
            file_with(of_building() + appearance + roofs_and_wall(of_roofs(), of_wall())));
}

TEST_F(EnrichedCityGml, TakesThePrefixOfTheFileOrDeclaresOne) {
  const std::string space = "=\"http://www.opengis.net/citygml/generics/2.0\"";
  const auto text = [](const std::string& spaces) { return model(spaces_of_version_2 + spaces, member(roofs_and_wall())); };
  // Without one, and where "gen" stands for something else
  const std::string declared =
      "<gen:doubleAttribute xmlns:gen" + space + " name=\"@\"><gen:value>#</gen:value></gen:doubleAttribute>";
  for (const std::string spaces : {"", " xmlns:gen=\"urn:other\""})
    EXPECT_THAT(enriched(text(spaces)), HasSubstr(of_building(declared) + "<bldg:boundedBy>"));
  EXPECT_THAT(enriched(text(" xmlns:g" + space)),
              HasSubstr(of_building("<g:doubleAttribute name=\"@\"><g:value>#</g:value></g:doubleAttribute>")));
  // A prefix holds within its element alone
  const std::string rebound = "<bldg:WallSurface xmlns:gen=\"urn:other\">";
  std::string inner = file_with(roofs_and_wall());
  inner.replace(inner.find("<bldg:WallSurface>"), 18, rebound);
  EXPECT_THAT(enriched(inner), HasSubstr(rebound + of_wall(declared)));
  EXPECT_THAT(enriched(inner), HasSubstr("<bldg:Building gml:id=\"b\">" + of_building()));
}

TEST_F(EnrichedCityGml, WritesTheAttributesOfTheVersion) {
  const std::string first = in_version("1.0", file_with(roofs_and_wall()));
  EXPECT_THAT(enriched(first), HasSubstr("<bldg:RoofSurface>" + of_roofs()));

  const std::string form =
      "<genericAttribute><gen:DoubleAttribute><gen:name>@</gen:name><gen:value>#</gen:value></gen:DoubleAttribute>"
      "</genericAttribute>";
  const std::string third = in_version("3.0", file_with("<genericAttribute/><dynamizer/>" + roofs_and_wall()));
  EXPECT_THAT(enriched(third), HasSubstr("<bldg:RoofSurface>" + of_roofs(form)));
  EXPECT_THAT(enriched(third), HasSubstr("<genericAttribute/>" + of_building(form) + "<dynamizer/>"));
}

TEST_F(EnrichedCityGml, AVersionWithoutSuchAttributesGetsNone) {
  const std::string text = in_version("9.0", file_with(roofs_and_wall()));
  EXPECT_EQ(enriched(text), text);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("3 objects have no place for attributes")));
}

TEST_F(EnrichedCityGml, EncodingsStayAsTheyAre) {
  const std::string latin = "encoding='ISO-8859-1'", street = "<gml:name>K\xf6ln</gml:name>";
  std::string text = file_with(street + roofs_and_wall()),
              expected = file_with(street + of_building() + roofs_and_wall(of_roofs(), of_wall()));
  for (std::string* file : {&text, &expected}) file->insert(file->find("?>"), " " + latin);
  EXPECT_EQ(enriched(text), expected);
  // iconv knows it, Expat does not
  for (std::string* file : {&text, &expected}) file->replace(file->find("ISO-8859-1"), 10, "windows-1252");
  EXPECT_EQ(enriched(text), expected);
  const std::string plain = file_with(roofs_and_wall()), mark = "\xef\xbb\xbf";
  EXPECT_EQ(enriched(mark + plain), mark + enriched(plain));
  EXPECT_EQ(enriched(" \r\n" + plain), " \r\n" + enriched(plain));
}

TEST_F(EnrichedCityGml, BuildingsThatShareAnIdGetNothing) {
  const std::string text = model(std::string(spaces_of_version_2), member(roofs_and_wall()) + member(""));
  EXPECT_EQ(enriched(text), text);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("No building of the file"), HasSubstr("2 buildings share their ids")));
}

TEST_F(EnrichedCityGml, ABuildingWithoutAnIdIsCalledByItsNumber) {
  std::string text = file_with(roofs_and_wall());
  text.erase(text.find(" gml:id=\"b\""), 11);
  SurfaceMeans means = means_of(0, 1, 2);
  for (SurfaceMean& surface : means.surfaces) surface.building = "building 1";
  means.buildings[0].building = "building 1";
  EXPECT_THAT(enriched(text, means), HasSubstr("<bldg:Building>" + of_building()));
}

TEST_F(EnrichedCityGml, AttributesOfTheseNamesAreRefused) {
  expect_refused(file_with(of_building() + roofs_and_wall()), "the building b has the attribute svf_roofs already");
  expect_refused(file_with(roofs_and_wall(of_roofs())), "the building b has the attribute svf_mean already");
  std::string third =
      file_with("<genericAttribute><gen:DoubleAttribute><gen:name>svf_walls</gen:name></gen:DoubleAttribute></genericAttribute>" +
                roofs_and_wall());
  for (std::size_t at = third.find("/2.0\""); at != third.npos; at = third.find("/2.0\"")) third.replace(at, 5, "/3.0\"");
  expect_refused(third, "the building b has the attribute svf_walls already");
}

TEST_F(EnrichedCityGml, WhatCannotBeReadIsRefused) {
  using namespace std::string_literals;
  const std::string text = file_with(roofs_and_wall());
  expect_refused(text.substr(0, text.size() / 2), "cannot be enriched as CityGML");
  expect_refused("<kml/>", "it begins with <kml>");
  expect_refused("\xff\xfe<\0?\0"s, "is UTF-16: convert it to UTF-8");
  expect_refused("<\0?\0"s, "is UTF-16: convert it to UTF-8");
  expect_refused("<?xml version='1.0' encoding='Shift_JIS'?><CityModel/>", "its encoding is neither UTF-8");
  expect_refused("<?xml version='1.0' encoding='IBM037'?><CityModel/>", "cannot be enriched as CityGML");
  expect_refused("<!DOCTYPE a [<!ENTITY x \"y\">]><CityModel>&x;</CityModel>", "declarations in its DOCTYPE at line 1");
  std::string deep;
  for (int n = 0; n < 300; ++n) deep += "<a>";
  expect_refused("\n" + deep, "nested deeper than 256 at line 2");
  expect_refused("<CityModel><!--" + std::string((std::size_t{1} << 23), ' '), "more than 4194304 bytes");
}

TEST_F(EnrichedCityGml, TheEndingOfTheOutputFits) {
  std::ofstream(folder.file("a.gml")) << file_with(roofs_and_wall());
  const EnrichedCityFile city(folder.file("a.gml"), {"svf"});
  for (const char* name : {"o.gml", "o.XML", "o.citygml"}) EXPECT_NO_THROW(city.require_fitting(name));
  for (const char* name : {"o.city.json", "o.csv", ".gml"}) EXPECT_THROW(city.require_fitting(name), OutputError);
}

}  // namespace
}  // namespace farlod
