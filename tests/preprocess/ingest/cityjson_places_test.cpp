// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "marked_text.hpp"

namespace farlod::ingest::test::cityjson_places {
namespace {

/// A roof of two squares (vertices 0 to 5), and a wall below one edge of it.
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
/// A building with these attributes (`"attributes":{…},` or nothing), and marks of its semantic surfaces; without its last brace.
std::string building(const std::string& attributes, const std::string& roof = "", const std::string& wall = "") {
  return "\"b\" : {" + attributes + "\"type\":\"Building\",\"geometry\":[" +
         geometry("2.2", roofs_and_wall, semantics_of(roof, wall)) + "]";
}
/// A line of a CityJSONSeq.
std::string feature_with(const std::string& objects) {
  return "{\"type\":\"CityJSONFeature\",\"id\":\"f\",\"CityObjects\":{" + objects + "},\"vertices\":" + vertices + "}\r\n";
}

// The values are no JSON: these texts are compared alone
constexpr const char *id = "\"id\":b", *of_roof = ",\"surfaces\":0+1", *of_wall = ",\"surfaces\":2",
                     *own_attributes = ",\"attributes\":{\"id\":b}";

std::string marked_json(const std::string& text, const IngestSettings& settings = {}) {
  return marked_text("a.city.json", text, settings);
}

TEST(CityJsonPlaces, AreBehindTheLastValue) {
  for (const std::string last : {"8.00", "-1e3", "\"a}\\\"\"", "null", "true", "[1, {}]", "{\"attributes\" : 1}"}) {
    const std::string attributes = "\"attributes\":{\"g\":[],\"h\": " + last;
    EXPECT_EQ(marked_json(file_with(building(attributes + " },") + "}")),
              file_with(building(attributes + "," + id + " },", of_roof, of_wall) + "}"));
    EXPECT_EQ(marked_json(file_with(building(attributes + "},") + "}")),
              file_with(building(attributes + "," + id + "},", of_roof, of_wall) + "}"));
  }
}

TEST(CityJsonPlaces, AreInAttributesOfTheirOwnWhereThereAreNone) {
  EXPECT_EQ(marked_json(file_with(building("") + "}")), file_with(building("", of_roof, of_wall) + own_attributes + "}"));
  EXPECT_EQ(marked_json(file_with(building("\"attributes\":{},") + "}")),
            file_with(building("\"attributes\":{" + std::string(id) + "},", of_roof, of_wall) + "}"));
  EXPECT_EQ(marked_json(file_with(building("\"attributes\": { } ,") + "}")),
            file_with(building("\"attributes\": {" + std::string(id) + " } ,", of_roof, of_wall) + "}"));
}

TEST(CityJsonPlaces, AreNowhereWhereAttributesAreNoObject) {
  for (const char* none : {"null", "[]", "3"}) {
    const std::string attributes = "\"attributes\":" + std::string(none) + ",";
    EXPECT_EQ(marked_json(file_with(building(attributes) + "}")), file_with(building(attributes, of_roof, of_wall) + "}"));
  }
}

TEST(CityJsonPlaces, OfNamesThatOccurTwiceTheLastOneCounts) {
  EXPECT_EQ(
      marked_json(file_with(building("\"attributes\":{\"a\":1},\"attributes\":{\"b\":1},") + "}")),
      file_with(building("\"attributes\":{\"a\":1},\"attributes\":{\"b\":1," + std::string(id) + "},", of_roof, of_wall) + "}"));
  const std::string other = "\"geometry\":[" + geometry("2", "[[[0,1,4,3]]]", semantics_of("", "")) + "],";
  EXPECT_EQ(marked_json(file_with(building(other) + "}")), file_with(building(other, of_roof, of_wall) + own_attributes + "}"));
}

TEST(CityJsonPlaces, AByteOrderMarkAndAFileOfManyPiecesDoNoHarm) {
  const std::string mark = "\xef\xbb\xbf", text = file_with(building("") + "}");
  EXPECT_EQ(marked_json(mark + text), mark + marked_json(text));
  for (const std::size_t blanks : {65'400U, 65'536U, 200'000U}) {
    const std::string before(blanks, ' ');
    EXPECT_EQ(marked_json(before + text), before + marked_json(text));
  }
}

TEST(CityJsonPlaces, OfASequenceAreInItsLines) {
  // Features have the transform of the first text; a line that is no feature stays as it is
  const std::string first = file_with(""), others = "\n{\"type\": \"CityJSONFea\n{\"type\":\"CityJSONFeature\"}\n";
  const std::string other = feature_with("\"c\":{\"type\":\"Building\"}");
  const std::string after = building("", of_roof, of_wall) + own_attributes + "}";
  EXPECT_EQ(marked_text("a.city.jsonl", first + other + others + feature_with(building("") + "}")),
            first + other + others + feature_with(after));
  EXPECT_EQ(marked_text("a.city.jsonl", file_with(building("") + "}") + feature_with("")), file_with(after) + feature_with(""));
  EXPECT_EQ(read_text("b.city.jsonl", first + feature_with(building("") + "}")).source.placed->format,
            CityFileFormat::cityjsonseq);
  EXPECT_EQ(read_text("b.city.json", file_with(building("") + "}")).source.placed->format, CityFileFormat::cityjson);
}

TEST(CityJsonOrigins, PartsHaveTheirSurfaces) {
  // The roofs are of the part; the building has a coarse shell, which does not count
  const auto text = [](const std::string& part, const std::string& surface, const std::string& whole, const std::string& other) {
    const std::string roofs =
        geometry("2", "[[[0,1,4,3]],[[1,2,5,4]]]", ",\"semantics\":{\"surfaces\":[{},{" + surface + "}],\"values\":[null,1]}");
    return file_with("\"p\":{\"type\":\"BuildingPart\",\"parents\":[\"b\"],\"geometry\":[" + roofs + "]" + part +
                     "},\"b\":{\"type\":\"Building\",\"geometry\":[" + geometry("1", "[[[0,2,5,3]]]", "") + "]" + whole +
                     "},\"q\":{\"type\":\"BuildingPart\",\"geometry\":[" + geometry("2", "[[[0,3,7,6]]]", "") +
                     "],\"parents\":[\"b\"]" + other + "}");
  };
  EXPECT_EQ(marked_json(text("", "", "", "")),
            text(",\"attributes\":{\"surfaces\":0+1}", "\"surfaces\":1", own_attributes, ",\"attributes\":{\"surfaces\":2}"));
}

TEST(CityJsonOrigins, APolygonOfTwoGeometriesIsOneSurfaceOfBoth) {
  // The second geometry repeats the roofs, the other way round, before its wall, which has the number 2 nevertheless
  const auto text = [](const std::string& roof, const std::string& again, const std::string& below, const std::string& whole) {
    const std::string first =
        geometry("2", "[[[0,1,4,3]],[[1,2,5,4]]]",
                 ",\"semantics\":{\"surfaces\":[{\"type\":\"RoofSurface\"" + roof + "}],\"values\":[0,null]}");
    const std::string second = geometry("2", "[[[3,4,1,0]],[[1,2,5,4]],[[0,3,7,6]]]", semantics_of(again, below));
    return file_with("\"b\":{\"type\":\"Building\",\"geometry\":[" + first + "," + second + "]" + whole + "}");
  };
  EXPECT_EQ(marked_json(text("", "", "", "")), text(",\"surfaces\":0", of_roof, of_wall, own_attributes));
}

TEST(CityJsonOrigins, ARepeatedPolygonOfOneGeometryIsOfBothItsSurfaces) {
  const auto text = [](const std::string& roof, const std::string& below) {
    return file_with("\"b\":{\"type\":\"Building\",\"attributes\":{" + (roof.empty() ? "" : std::string(id)) +
                     "},\"geometry\":[" + geometry("2", "[[[0,1,4,3]],[[1,2,5,4]],[[0,1,4,3]]]", semantics_of(roof, below)) +
                     "]}");
  };
  EXPECT_EQ(marked_json(text("", "")), text(of_roof, ",\"surfaces\":0"));
}

TEST(CityJsonOrigins, AreThoseOfTheLevelOfDetailThatIsRead) {
  const auto text = [](const std::string& fine, const std::string& coarse) {
    return file_with("\"b\":{\"attributes\":{" + std::string(id) + "},\"type\":\"Building\",\"geometry\":[" +
                     geometry("2", "[[[0,3,7,6]]]", ",\"semantics\":{\"surfaces\":[{" + fine + "}],\"values\":[0]}") + "," +
                     geometry("1", "[[[0,1,4,3]]]", ",\"semantics\":{\"surfaces\":[{" + coarse + "}],\"values\":[0]}") + "]}");
  };
  const auto without_id = [](std::string file) { return file.erase(file.find(id), std::string(id).size()); };
  EXPECT_EQ(marked_json(without_id(text("", ""))), text("\"surfaces\":0", ""));
  EXPECT_EQ(marked_json(without_id(text("", "")), in_lod(1)), text("", "\"surfaces\":0"));
}

TEST(CityJsonOrigins, ATemplateIsOfItsObjectAlone) {
  const auto text = [](const std::string& of_installation) {
    std::string file = file_with(building("\"attributes\":{},", "@", "#") +
                                 "},\"i\":{\"type\":\"BuildingInstallation\",\"parents\":[\"b\"],\"geometry\":[{\"type\":"
                                 "\"GeometryInstance\",\"template\":0,\"boundaries\":[8],\"transformationMatrix\":"
                                 "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]" +
                                 of_installation + "}");
    const std::string shared =
        geometry("2.2", "[[[0,1,2]]]", ",\"semantics\":{\"surfaces\":[{\"type\":\"WallSurface\"}],\"values\":[0]}");
    return file.insert(file.rfind('}'), ",\"geometry-templates\":{\"templates\":[" + shared +
                                            "],\"vertices-templates\":[[0,0,0],[3,0,0],[0,0,3]]}");
  };
  const auto with = [](std::string file, const std::string& building_id, const std::string& roof, const std::string& below) {
    file.replace(file.find("{},"), 3, "{" + building_id + "},");
    file.replace(file.find('@'), 1, roof);
    return file.replace(file.find('#'), 1, below);
  };
  EXPECT_EQ(marked_json(with(text(""), "", "", "")), with(text(",\"attributes\":{\"surfaces\":3}"), id, of_roof, of_wall));
}

TEST(CityJsonOrigins, WhatIsNoListOfSurfacesHasNoPlaces) {
  // nlohmann goes through the members of an object as through a list
  const std::string odd = "\"geometry\":{\"0\":" + geometry("2", roofs_and_wall, semantics_of("", "")) + "}";
  const std::string object = "\"b\":{\"type\":\"Building\"," + odd;
  EXPECT_EQ(marked_json(file_with(object + "}")), file_with(object + own_attributes + "}"));
}

}  // namespace
}  // namespace farlod::ingest::test::cityjson_places
