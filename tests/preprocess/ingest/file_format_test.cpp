// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/files/file_format.hpp"

#include "reading.hpp"
#include "small_cities.hpp"

namespace farlod::ingest::test {
namespace {

FileFormat format_of(const std::string& text) { return format_by_content(write_file("no_ending", text)); }

/// Every second byte 0, as texts of the first 128 letters are in UTF-16.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

TEST(FileFormat, IsToldByTheContent) {
  EXPECT_EQ(format_of(citygml_of("a")), FileFormat::citygml);
  EXPECT_EQ(
      format_of("<?xml version=\"1.0\"?>\n<!-- <a> -->\n<!DOCTYPE x [<!ENTITY a \">\">]>\n<core:CityModel xmlns:core=\"x\">"),
      FileFormat::citygml);
  EXPECT_EQ(format_of(cityjson_of("a")), FileFormat::cityjson);
  EXPECT_EQ(format_of(R"({"type":"CityJSON"})"
                      "\n"
                      R"({"type":"CityJSONFeature"})"),
            FileFormat::cityjson);
  EXPECT_EQ(format_of(R"({"vertices":[],"CityObjects":{)"), FileFormat::cityjson);
  EXPECT_EQ(format_of("# made by hand\n\nmtllib a.mtl\n" + obj_of("a")), FileFormat::obj);
  EXPECT_EQ(format_of("v 0 0 \\\n0 1\nf 1 2 3"), FileFormat::obj);
  EXPECT_EQ(format_of(geojson_of("a")), FileFormat::features);
  EXPECT_EQ(format_of(elevations), FileFormat::raster);
}

TEST(FileFormat, OtherThingsAreNone) {
  for (const char* text : {"hello", "", "v is a letter\nand not a file\n", "<html/>", "{\"a\":1}", "{", "P1\n1 1\n0\n"})
    EXPECT_EQ(format_of(text), FileFormat::unknown) << text;
}

TEST(FileFormat, SeesThroughMarksAndBlanks) {
  EXPECT_EQ(format_of("\xEF\xBB\xBF" + cityjson_of("a")), FileFormat::cityjson);
  EXPECT_EQ(format_of("\n\n \t" + cityjson_of("a")), FileFormat::cityjson);
  EXPECT_EQ(format_of("\xEF\xBB\xBF" + obj_of("a")), FileFormat::obj);
  EXPECT_EQ(format_of("\xEF\xBB\xBF" + citygml_of("a")), FileFormat::citygml);
  EXPECT_EQ(format_of(utf16(citygml_of("a"), true)), FileFormat::citygml);
  EXPECT_EQ(format_of(utf16(citygml_of("a"), false)), FileFormat::citygml);
}

TEST(FileFormat, ArchivesOfAllKindsAreKnown) {
  for (const char* mark : {"PK\3\4", "\x1F\x8B\x08", "7z\xBC\xAF\x27\x1C", "Rar!\x1A\x07", "BZh9"})
    EXPECT_EQ(format_of(mark), FileFormat::archive) << mark;
  EXPECT_EQ(format_of(std::string(257, 'a') + "ustar"), FileFormat::archive);
}

TEST(FileFormat, ReadingFollowsTheContentAndSaysSo) {
  for (const auto& [name, text] : {std::pair{"a.gml", cityjson_of("a")},
                                   {"a.city.json", citygml_of("a")},
                                   {"a.geojson", obj_of("a")},
                                   {"a.obj", geojson_of("a")},
                                   {"a.citygml", geojson_of("a")}}) {
    const Reading r = read_text(name, text);
    EXPECT_EQ(r.codes(), std::set<int>{117}) << name;
    EXPECT_EQ(r.city().buildings().size(), 1u) << name;
  }
}

TEST(FileFormat, SharedAndUnknownEndingsAreNoSurprise) {
  for (const auto& [name, text] : {std::pair{"a.xml", citygml_of("a")},
                                   {"a.json", geojson_of("a")},
                                   {"a.json", cityjson_of("a")},
                                   {"a.txt", obj_of("a")},
                                   {"a", citygml_of("a")},
                                   {"a.jsonl", geojson_of("a")}})
    EXPECT_TRUE(read_text(name, text).codes().empty()) << name;
}

TEST(FileFormat, Utf16AndLeadingBlanksAreRead) {
  EXPECT_EQ(read_text("a.gml", utf16(citygml_of("a"), true)).city().buildings().size(), 1u);
  EXPECT_EQ(read_text("a.gml", "\n\n" + citygml_of("a")).city().buildings().size(), 1u);
  EXPECT_EQ(read_text("a.obj", "\xEF\xBB\xBF" + obj_of("a")).city().buildings()[0].id, "a");
}

}  // namespace
}  // namespace farlod::ingest::test
