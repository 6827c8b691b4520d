// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/files/file_format.hpp"

#include <gmock/gmock.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "farlod/error.hpp"
#include "ingest/files/input_file.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"
#include "tests/scenes/surface_count.hpp"

namespace farlod::ingest::test {
namespace {

using testing::HasSubstr;

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

/// A town that does not depend on the order of its buildings: for each its surfaces, as sorted corners, with their kind.
using Surface = std::pair<std::vector<std::array<double, 3>>, SurfaceKind>;

std::vector<std::vector<Surface>> town_of(const CityModel& city) {
  std::vector<std::vector<Surface>> town;
  for (const Building& building : city.buildings()) {
    std::vector<Surface>& surfaces = town.emplace_back();
    for (const Facet& facet : city.facets_of(building)) {
      Surface& surface = surfaces.emplace_back();
      surface.second = facet.kind;
      for (const Point3d& p : city.ring(facet, 0)) surface.first.push_back({p.x, p.y, p.z});
      std::sort(surface.first.begin(), surface.first.end());
    }
    std::sort(surfaces.begin(), surfaces.end());
  }
  std::sort(town.begin(), town.end());
  return town;
}

class FormatsAgree : public testing::TestWithParam<const char*> {};

TEST_P(FormatsAgree, OnTheSameTown) {
  FARLOD_NEEDS_DATA(std::string("formats/") + GetParam());
  const Reading reference = read_file(shared_data("formats/citygml20_lod2.gml"));
  const Reading other = read_file(shared_data(std::string("formats/") + GetParam()));
  EXPECT_EQ(reference.city().buildings().size(), 100u);
  EXPECT_EQ(surface_count(reference.city()), 700u);
  EXPECT_TRUE(other.codes().empty());
  EXPECT_EQ(town_of(reference.city()), town_of(other.city()));
}

INSTANTIATE_TEST_SUITE_P(Formats, FormatsAgree,
                         testing::Values("citygml10_lod2.gml", "citygml30_lod2.gml", "cityjson20_lod2.city.json",
                                         "cityjsonseq.city.jsonl"));

TEST(RealCities, Tokyo) {
  FARLOD_NEEDS_DATA("tokyo");
  const std::filesystem::path file = shared_data("tokyo/53392633_bldg_6697_2_op.gml");
  const Reading best = read_file(file);
  EXPECT_EQ(best.city().buildings().size(), 9u);
  EXPECT_EQ(best.source.crs.definition, "http://www.opengis.net/def/crs/EPSG/0/6697");
  // The 1,083 polygons of the file are 9 roof edges, 177 in LoD 1 and 897 in LoD 2: one level may count
  EXPECT_EQ(surface_count(best.city()), 897u);
  EXPECT_EQ(best.codes(), std::set<int>{114});
  IngestSettings settings;
  settings.lod.exactly = 1;
  EXPECT_EQ(surface_count(read_file(file, settings).city()), 177u);
}

TEST(RealCities, NorthRhineWestphalia) {
  FARLOD_NEEDS_DATA("nrw");
  std::size_t buildings = 0, parts = 0;
  std::uint64_t polygons = 0;
  for (const char* name : {"nrw/LoD2_32_280_5657_1_NW.gml", "nrw/LoD2_32_280_5659_1_NW.gml"}) {
    const Reading r = read_file(shared_data(name));
    EXPECT_TRUE(r.codes().empty());
    buildings += r.city().buildings().size();
    polygons += surface_count(r.city());
    for (const Building& b : r.city().buildings()) {
      std::set<std::uint16_t> numbers;
      for (const Facet& f : r.city().facets_of(b)) numbers.insert(f.part);
      numbers.erase(0);
      parts += numbers.size();
    }
  }
  EXPECT_EQ(buildings, 192u);
  EXPECT_EQ(parts, 105u);
  EXPECT_EQ(polygons, 2585u);
}

TEST(RealCities, Rotterdam) {
  FARLOD_NEEDS_DATA("rotterdam");
  const Reading r = read_file(shared_data("rotterdam/delfshaven.city.json"));
  EXPECT_EQ(r.city().buildings().size(), 853u);
  EXPECT_EQ(r.report.count(ProblemCode::too_few_points), 633u);
  EXPECT_EQ(surface_count(r.city()) + r.report.count(ProblemCode::too_few_points), 15482u);
}

TEST(RealCities, Queens) {
  FARLOD_NEEDS_DATA("nyc_queens");
  const Reading r = read_file(shared_data("nyc_queens/queens_da4.obj"));
  EXPECT_EQ(r.city().buildings().size(), 16665u);
  EXPECT_EQ(r.city().facets().size() + r.report.count(ProblemCode::too_few_points), 401110u);
  // One building number stands for all 929 buildings without a number
  EXPECT_EQ(r.report.count(ProblemCode::repeated_id), 928u);
  EXPECT_EQ(surface_count(r.city()), 153851u);
}

TEST(RealCities, Omiya) {
  FARLOD_NEEDS_DATA("omiya");
  IngestSettings settings;
  settings.footprints.height_field = "TAKASA";
  const Reading r = read_file(shared_data("omiya/omiya.geojson"), settings);
  EXPECT_EQ(r.city().buildings().size(), 10213u);
  // 101,722 sides and lids, of which 669 walls stand between a vertex and its repetition: they are no surfaces
  EXPECT_EQ(surface_count(r.city()), 101722u - 669u);
  EXPECT_EQ(r.report.count(ProblemCode::repeated_vertex), 88u);
}

TEST(RealCities, Manhattan) {
  FARLOD_NEEDS_DATA("manhattan");
  const Reading r = read_file(shared_data("manhattan/manhattan.geojson"));
  // A car park is below the ground. Of 10 others without a height two have building:levels, and 5 and 4 walls
  EXPECT_EQ(r.city().buildings().size(), 1238u - 8u);
  EXPECT_EQ(surface_count(r.city()), 15091u + 7u + 6u);
  EXPECT_EQ(r.report.count(ProblemCode::no_height), 8u);
  EXPECT_EQ(r.report.count(ProblemCode::not_an_area), 0u) << "points of parking are no buildings";
}

TEST(RealCities, BuildingAndGarageShareAWallOnce) {
  FARLOD_NEEDS_DATA("formats");
  const Reading r = read_file(shared_data("formats/Building_and_garage_LOD2-EPSG25832.gml"));
  EXPECT_EQ(r.city().buildings().size(), 1u);
  EXPECT_EQ(surface_count(r.city()), 13u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(RealCities, OpeningsFillTheWallsOfLod3) {
  FARLOD_NEEDS_DATA("formats");
  const Reading r = read_file(shared_data("formats/Building_LOD3-EPSG25832.gml"));
  EXPECT_EQ(surface_count(r.city()), 24u);
  EXPECT_TRUE(r.codes().empty());
}

TEST(SeveralFiles, AreReadInTheirOrder) {
  const std::vector<InputFile> files{write_file("b.obj", obj_of("b")), write_file("a.gml", citygml_of("a"))};
  Report report;
  const std::vector<SourceCity> cities = ingest_all(files, {}, report);
  ASSERT_EQ(cities.size(), 2u);
  EXPECT_EQ(cities[0].city.buildings()[0].id, "b");
  EXPECT_EQ(cities[1].city.buildings()[0].id, "a");
}

TEST(SeveralFiles, WhatCannotBeUsedCostsItselfOnly) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("cut.gml", citygml_of("x").substr(0, 300)),
                                     write_file("good.obj", obj_of("good")), write_file("text.txt", "hello")};
  Report report;
  EXPECT_EQ(ingest_all(files, {}, report).size(), 1u);
  ASSERT_EQ(report.problems().size(), 3u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::empty_file);
  EXPECT_EQ(report.problems()[0].source, files[0].name);
  EXPECT_EQ(report.problems()[1].code, ProblemCode::unusable_file);
  EXPECT_THAT(report.problems()[1].detail, HasSubstr("not well-formed"));
  EXPECT_EQ(report.problems()[2].code, ProblemCode::unusable_file);
}

/// The ids and the problems of files that are read on so many threads.
std::string read_on_threads(int threads, const std::vector<InputFile>& files) {
  return oneapi::tbb::task_arena(threads).execute([&] {
    Report report;
    std::string text;
    for (const SourceCity& source : ingest_all(files, {}, report))
      text += source.source + ' ' + source.city.buildings()[0].id + '\n';
    for (const Problem& problem : report.problems()) text += problem.source + ": " + problem.detail + '\n';
    return text;
  });
}

TEST(SeveralFiles, ThreadsDoNotChangeTheirOrder) {
  std::vector<InputFile> files;
  for (int n = 0; n < 20; ++n) {
    const std::string name = "town " + std::to_string(n);
    files.emplace_back(write_file(name + ".gml", n % 3 == 0 ? "not XML" : citygml_of(name)));
    files.emplace_back(write_file(name + ".obj", n % 5 == 0 ? "" : obj_of(name)));
  }
  const std::string on_one = read_on_threads(1, files);
  EXPECT_EQ(std::count(on_one.begin(), on_one.end(), '\n'), 40);
  for (const int threads : {2, 8}) EXPECT_EQ(read_on_threads(threads, files), on_one);
}

TEST(SeveralFiles, AreNotReadOnceAStopIsRequested) {
  const std::vector<InputFile> files(10, write_file("a.obj", obj_of("a")));
  std::stop_source source;
  source.request_stop();
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      Report report;
      EXPECT_THROW((void)ingest_all(files, {}, report, source.get_token()), Cancelled);
    });
}

TEST(SeveralFiles, OfWhichNoneIsLeftEndTheRun) {
  const std::vector<InputFile> files{write_file("empty.gml", ""), write_file("text.txt", "hello")};
  Report report;
  EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)ingest_all(files, {}, report); }),
              testing::AllOf(HasSubstr("none of the 2 files"), HasSubstr("empty.gml"), HasSubstr("0 bytes")));
  EXPECT_EQ(report.problems().size(), 2u);
}

TEST(SeveralFiles, ASingleFileEndsTheRunItself) {
  Report report;
  const std::vector<InputFile> file{write_file("empty.gml", "")};
  EXPECT_THROW((void)ingest_all(file, {}, report), InputError);
  EXPECT_TRUE(report.problems().empty());
}

constexpr int pieces = 1'000;

TEST(OrderedWork, BeginsAndEndsInOrderWithinItsPlaces) {
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_EQ(threads_here(), static_cast<std::size_t>(threads));
      std::vector<int> piece_at(3, -1), ended;
      int next = 0;
      const auto begin = [&](std::size_t place) {
        EXPECT_EQ(piece_at.at(place), -1) << "the place is free";
        if (next == pieces) return false;
        piece_at[place] = next++;
        return true;
      };
      const auto work = [&](std::size_t place) { piece_at[place] *= 2; };
      const auto end = [&](std::size_t place) {
        ended.push_back(piece_at[place] / 2);
        piece_at[place] = -1;
      };
      run_in_order(piece_at.size(), {begin, work, end});
      std::vector<int> all(pieces);
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(ended, all);
    });
}

TEST(OrderedWork, EndsWithWhatIsThrown) {
  const auto go_on = [](std::size_t) {};
  const auto fail = [](std::size_t) { throw std::runtime_error("no more"); };
  for (const int threads : {1, 4})
    oneapi::tbb::task_arena(threads).execute([&] {
      EXPECT_THROW(run_in_order(2, {[](std::size_t) -> bool { throw std::runtime_error("no more"); }, go_on, go_on}),
                   std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, fail, go_on}), std::runtime_error);
      EXPECT_THROW(run_in_order(2, {[](std::size_t) { return true; }, go_on, fail}), std::runtime_error);
    });
}

}  // namespace
}  // namespace farlod::ingest::test
