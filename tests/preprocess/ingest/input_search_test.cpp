// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "ingest/files/input_search.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <iterator>
#include <thread>

#include "archive_writer.hpp"
#include "farlod/error.hpp"
#include "reading.hpp"
#include "small_cities.hpp"
#include "tests/scenes/refusal.hpp"

namespace farlod::ingest::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
namespace fs = std::filesystem;

/// A folder of the running test's own.
class InputSearch : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const { return own.write(name, text); }
  FoundInputs find(const std::vector<fs::path>& inputs) { return find_input_files(inputs, report); }
  /// Names within the test's folder.
  std::vector<std::string> names(const std::vector<InputFile>& files) const {
    std::vector<std::string> names;
    for (const InputFile& file : files) names.push_back(fs::path(file.name).lexically_relative(folder).generic_string());
    return names;
  }
  std::vector<std::string> found(const std::vector<fs::path>& inputs) { return names(find(inputs).files); }
  std::string refusal(const std::vector<fs::path>& inputs) {
    return scenes::refusal_of<InputError>([&] { (void)find(inputs); });
  }
  /// The ids of the buildings in all files behind the names.
  std::vector<std::string> buildings(const std::vector<fs::path>& inputs) {
    std::vector<std::string> ids;
    for (const SourceCity& city : ingest_all(find(inputs).files, {}, report))
      for (const Building& building : city.city.buildings()) ids.push_back(building.id);
    return ids;
  }

  const scenes::TemporaryFolder own;
  const fs::path folder = own.path();
  Report report;
};

TEST_F(InputSearch, AFolderGivesItsCitiesInOrder) {
  write("town/b/tile.gml", citygml_of("b"));
  write("town/a.city.json", cityjson_of("a"));
  write("town/c.obj", obj_of("c"));
  EXPECT_THAT(found({folder / "town"}), ElementsAre("town/a.city.json", "town/b/tile.gml", "town/c.obj"));
  EXPECT_THAT(buildings({folder / "town"}), ElementsAre("a", "b", "c"));
}

TEST_F(InputSearch, CompanionsAreSilentlyNoCitiesAndTheUnknownAreCounted) {
  write("town/a.gml", citygml_of("a"));
  for (const char* name : {"town/a.prj", "town/appearance/roof.jpg", "town/readme.txt", "town/.DS_Store", "town/.hidden/b.gml"})
    write(name, "nothing");
  write("town/codelists/roof.xml", "<gml:Dictionary xmlns:gml=\"http://www.opengis.net/gml\"/>");
  write("town/tileset.json", R"({"asset":{}})");
  for (const char* name : {"town/a.xyz", "town/b.XYZ", "town/LICENSE"}) write(name, "nothing");
  const FoundInputs inputs = find({folder / "town"});
  EXPECT_THAT(names(inputs.files), ElementsAre("town/a.gml"));
  EXPECT_THAT(inputs.skipped, ElementsAre(Pair(".xyz files", 2), Pair("files without an ending", 1)));
  EXPECT_TRUE(report.problems().empty());
}

TEST_F(InputSearch, AnEmptyFileThatMayHaveBeenACityIsSaid) {
  write("town/a.json", "");
  write("town/b.gml", citygml_of("b"));
  EXPECT_THAT(buildings({folder / "town"}), ElementsAre("b"));
  EXPECT_EQ(report.count(ProblemCode::empty_file), 1u);
}

TEST_F(InputSearch, AShapefileIsOneInputWithItsCompanions) {
  const fs::path zip =
      write("town.zip", zip_of({{"a.shp", "x"}, {"a.shx", "x"}, {"a.dbf", "x"}, {"a.prj", "x"}, {"a.shp.xml", "<x/>"}}));
  EXPECT_THAT(found({zip}), ElementsAre("town.zip/a.shp"));
}

TEST_F(InputSearch, ContentTellsWhereTheEndingDoesNot) {
  write("town/a.xml", citygml_of("a"));
  write("town/b.json", cityjson_of("b"));
  write("town/c.json", geojson_of("c"));
  write("town/d", citygml_of("d"));
  EXPECT_THAT(buildings({folder / "town"}), ElementsAre("a", "b", "c", "d"));
}

TEST_F(InputSearch, AFileComesOnceHoweverOftenItIsGiven) {
  write("town/a.gml", citygml_of("a"));
  write("town/z.zip", zip_of({{"b.gml", citygml_of("b")}}));
  fs::create_symlink(folder / "town/a.gml", folder / "link.gml");
  const std::vector<fs::path> inputs{folder / "link.gml", folder / "town", folder / "town/../town/a.gml", folder / "town/z.zip"};
  EXPECT_THAT(buildings(inputs), ElementsAre("a", "b"));
}

TEST_F(InputSearch, TheMembersOfAnArchiveAreFiles) {
  const fs::path zip = write("town.zip", zip_of({{"tiles/b.gml", citygml_of("b")},
                                                 {"a.city.json", cityjson_of("a")},
                                                 {"c.obj", obj_of("c")},
                                                 {"d.geojson", geojson_of("d")},
                                                 {"roof.png", "nothing"},
                                                 {"__MACOSX/._b.gml", "nothing"}}));
  EXPECT_THAT(found({zip}), ElementsAre("town.zip/a.city.json", "town.zip/c.obj", "town.zip/d.geojson", "town.zip/tiles/b.gml"));
  EXPECT_THAT(buildings({zip}), ElementsAre("a", "c", "d", "b"));
}

TEST_F(InputSearch, AFileMayBePackedByItself) {
  const std::vector<fs::path> inputs{write("a.gml.gz", gzip_of(citygml_of("a"))),
                                     write("b.city.json.gz", gzip_of(cityjson_of("b"))),
                                     write("c.geojson.gz", gzip_of(geojson_of("c"))), write("d.obj.gz", gzip_of(obj_of("d")))};
  EXPECT_THAT(buildings(inputs), ElementsAre("a", "b", "c", "d"));
  EXPECT_TRUE(report.problems().empty());
  for (const auto& entry : fs::directory_iterator(folder)) EXPECT_EQ(entry.path().extension(), ".gz") << "nothing is written";
}

/// GDAL would write what it learns of a table in GML beside it, and of a packed file, too.
TEST_F(InputSearch, NothingIsWrittenBesideAFile) {
  const fs::path gml = write("a.gml", features_in_gml_of("a")), gzip = write("b.gml.gz", gzip_of(features_in_gml_of("b")));
  EXPECT_THAT(buildings({gml, gzip}), ElementsAre("a", "b"));
  EXPECT_TRUE(report.problems().empty());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);
}

TEST_F(InputSearch, ArchivesAreKnownByTheirContent) {
  const fs::path zip = write("download", zip_of({{"a.gml", citygml_of("a")}})), gzip = write("b.gml", gzip_of(citygml_of("b")));
  EXPECT_THAT(buildings({zip, gzip}), ElementsAre("a", "b"));
}

TEST_F(InputSearch, ArchivesInFoldersAreOpenedAndThoseInArchivesAreNot) {
  const std::string inner = zip_of({{"a.gml", citygml_of("a")}});
  write("town/a.zip", inner);
  write("town/b.gml.gz", gzip_of(citygml_of("b")));
  write("town/c.zip", zip_of({{"inner.zip", inner}}));
  EXPECT_THAT(buildings({folder / "town"}), ElementsAre("a", "b"));
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_EQ(report.problems()[0].code, ProblemCode::unusable_file);
  EXPECT_THAT(report.problems()[0].source, HasSubstr("c.zip/inner.zip"));
  EXPECT_THAT(report.problems()[0].detail, HasSubstr("unpack it first"));
}

TEST_F(InputSearch, NamesThatLeadOutOfAnArchiveAreNone) {
  write("evil.gml", citygml_of("evil"));
  const fs::path zip = write("deep/town.zip", zip_of({{"../evil.gml", citygml_of("x")},
                                                      {"a/../../evil.gml", citygml_of("x")},
                                                      {"/evil.gml", citygml_of("x")},
                                                      {"good.gml", citygml_of("good")}}));
  EXPECT_THAT(buildings({zip}), ElementsAre("good"));
  ASSERT_EQ(report.problems().size(), 3u);
  for (const Problem& problem : report.problems()) {
    EXPECT_EQ(problem.code, ProblemCode::unusable_file);
    EXPECT_THAT(problem.detail, HasSubstr("leads out of the archive"));
  }
}

TEST_F(InputSearch, NamesDoNotMoveTheCursor) {
  const fs::path zip = write("town.zip", zip_of({{"a\n\x1B[2J.gml", citygml_of("a")}, {"../\n.gml", "x"}}));
  EXPECT_THAT(found({zip}), ElementsAre("town.zip/a??[2J.gml"));
  EXPECT_THAT(buildings({zip}), ElementsAre("a"));
  for (const Problem& problem : report.problems()) EXPECT_EQ(problem.detail.find('\n'), std::string::npos);
}

TEST_F(InputSearch, LockedFilesAreSaid) {
  ZipEntry locked{"a.gml", citygml_of("a")}, picture{"a.jpg", "nothing"};
  locked.is_locked = picture.is_locked = true;
  const fs::path zip = write("town.zip", zip_of({locked, picture, {"b.gml", citygml_of("b")}}));
  EXPECT_THAT(buildings({zip}), ElementsAre("b"));
  ASSERT_EQ(report.problems().size(), 1u);
  EXPECT_THAT(report.problems()[0].detail, HasSubstr("password"));
}

TEST_F(InputSearch, ABombIsRefusedByWhatItClaims) {
  constexpr std::uint32_t claim = 0x7FFFFFFF;
  const fs::path zip = write("town.zip", zip_of({{"a.gml", citygml_of("a"), claim, false}}));
  EXPECT_THAT(refusal({zip}), HasSubstr("claims to unpack"));
  (void)find({zip, write("b.gml", citygml_of("b"))});
  EXPECT_EQ(report.count(ProblemCode::unusable_file), 1u);
}

TEST_F(InputSearch, ABombIsRefusedByWhatItUnpacks) {
  const std::string blanks(static_cast<std::size_t>(most_unpacked_bytes(0)) + 1, ' ');
  for (const char* name : {"a.gml.gz", "a.city.json.gz", "a.obj.gz", "a.geojson.gz"}) {
    const std::vector<InputFile> files = find({write(name, gzip_of(blanks))}).files;
    EXPECT_THAT(scenes::refusal_of<InputError>([&] { (void)ingest_all(files, {}, report); }),
                HasSubstr("unpacks to more than 64 MiB"))
        << name;
  }
}

TEST_F(InputSearch, ADamagedArchiveIsNotTakenForAShortFile) {
  const std::string whole = gzip_of(citygml_of("a") + std::string(200'000, '\n')), zip = zip_of({{"a.gml", citygml_of("a")}});
  const fs::path cut = write("a.gml.gz", whole.substr(0, whole.size() / 2));
  const std::vector<InputFile> files = find({cut}).files;
  EXPECT_THROW((void)ingest_all(files, {}, report), InputError);
  EXPECT_THAT(refusal({write("b.zip", zip.substr(0, zip.size() - 30))}), HasSubstr("zip archive that cannot be read"));
  // Behind the header of 30 bytes and the name
  std::string flipped = zip;
  flipped[60] = static_cast<char>(flipped[60] ^ 0xFF);
  const std::vector<InputFile> bad = find({write("c.zip", flipped)}).files;
  EXPECT_THROW((void)ingest_all(bad, {}, report), InputError);
  const auto more = static_cast<std::uint32_t>(citygml_of("a").size()) + 1;
  const std::vector<InputFile> liar = find({write("d.zip", zip_of({{"a.gml", citygml_of("a"), more, false}}))}).files;
  EXPECT_THROW((void)ingest_all(liar, {}, report), InputError);
}

TEST_F(InputSearch, ARasterByItselfIsASurfaceModel) {
  write("folder/dsm.asc", elevations);
  const std::vector<fs::path> alone{write("dsm.asc", elevations), write("dsm.zip", zip_of({{"dsm.asc", elevations}})),
                                    write("dsm.asc.gz", gzip_of(elevations)), folder / "folder"};
  for (const fs::path& input : alone) {
    const FoundInputs inputs = find({input});
    EXPECT_TRUE(inputs.files.empty()) << input;
    EXPECT_EQ(inputs.surface_models.size(), 1u) << input;
  }
}

TEST_F(InputSearch, ARasterBesideCitiesIsCounted) {
  write("town/a.gml", citygml_of("a"));
  write("town/dsm.asc", elevations);
  const FoundInputs inputs = find({folder / "town"});
  EXPECT_TRUE(inputs.surface_models.empty());
  EXPECT_THAT(inputs.skipped, ElementsAre(Pair(".asc files", 1)));
}

/// A mosaic, and a layer of features under the name of a city: both name other files.
TEST_F(InputSearch, WhatIsFoundNamesNoOtherFiles) {
  write("outside/dsm.asc", elevations);
  const fs::path secret = write("outside/a.geojson", geojson_of("secret"));
  const std::string mosaic =
                        "<VRTDataset rasterXSize=\"2\" rasterYSize=\"2\"><GeoTransform>0,10,0,20,0,-10</GeoTransform>"
                        "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename>" +
                        (folder / "outside/dsm.asc").string() + "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>",
                    layer = "<OGRVRTDataSource><OGRVRTLayer name=\"a\"><SrcDataSource>" + secret.string() +
                            "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>";
  write("rasters/mosaic.vrt", mosaic);
  write("town/a.geojson", layer);
  for (const fs::path& input : {folder / "rasters", write("mosaic.zip", zip_of({{"mosaic.vrt", mosaic}}))})
    EXPECT_THAT(refusal({input}), HasSubstr("give it by its own name")) << input;
  for (const fs::path& input :
       {folder / "town", write("a.zip", zip_of({{"a.geojson", layer}})), write("a.geojson.gz", gzip_of(layer))}) {
    const std::vector<InputFile> files = find({input}).files;
    ASSERT_EQ(files.size(), 1U) << input;
    EXPECT_THROW((void)ingest_all(files, {}, report), InputError) << input;
  }
  EXPECT_THAT(buildings({folder / "town/a.geojson"}), ElementsAre("secret")) << "the user named it";
  EXPECT_EQ(find({folder / "rasters/mosaic.vrt"}).surface_models.size(), 1U);
}

TEST_F(InputSearch, AFolderThatIsOneDataSetStaysOneInput) {
  write("town/land.gdb/a00000001.gdbtable", "nothing");
  write("town/land.gdb/gdb", "nothing");
  write("town/a.gml", citygml_of("a"));
  const FoundInputs town = find({folder / "town"});
  EXPECT_THAT(names(town.files), ElementsAre("town/a.gml", "town/land.gdb"));
  EXPECT_TRUE(town.skipped.empty());
  const fs::path zip = write("land.zip", zip_of({{"data/land.gdb/a.gdbtable", "x"}, {"data/land.gdb/b.gdbtable", "x"}}));
  const FoundInputs inputs = find({zip});
  EXPECT_THAT(names(inputs.files), ElementsAre("land.zip/data/land.gdb"));
  EXPECT_THAT(inputs.files[0].path.string(), testing::EndsWith("land.zip}/data/land.gdb"));
}

TEST_F(InputSearch, NothingToReadIsSaid) {
  EXPECT_THAT(refusal({folder / "nowhere"}), HasSubstr("does not exist"));
  write("town/a.pyc", "nothing");
  EXPECT_THAT(refusal({folder / "town"}), testing::AllOf(HasSubstr("holds no file of a city"), HasSubstr("1 .pyc files")));
  EXPECT_THAT(refusal({folder / "nowhere", write("a.gml", citygml_of("a"))}), HasSubstr("does not exist"));
}

/// A pipe that some text is written to.
class FilledPipe {
 public:
  FilledPipe(const fs::path& path, std::string text) {
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    writer_ = std::jthread([path, text = std::move(text)] { std::ofstream(path, std::ios::binary) << text; });
  }

 private:
  std::jthread writer_;
};

TEST_F(InputSearch, APipeGivesACityOnce) {
  for (const auto& [id, text] : {std::pair("a", obj_of("a")), std::pair("b", citygml_of("b"))}) {
    const fs::path path = folder / (std::string("pipe ") + id);
    const FilledPipe pipe(path, text + std::string(std::size_t{1} << 20, '\n'));
    const FoundInputs inputs = find({path});
    ASSERT_EQ(inputs.files.size(), 1U);
    const std::vector<SourceCity> cities = ingest_all(inputs.files, {}, report);
    ASSERT_EQ(cities.size(), 1U);
    EXPECT_EQ(cities[0].city.buildings()[0].id, id);
    EXPECT_THROW((void)open_input(inputs.files[0]), InputError);
  }
}

TEST_F(InputSearch, APipeIsReadFromItsBeginningToItsEnd) {
  std::string text = "v 0 0 0\n";
  while (text.size() < (std::size_t{3} << 20)) text += "v " + std::to_string(text.size()) + " 0 0\n";
  const FilledPipe pipe(folder / "pipe", text);
  const FoundInputs inputs = find({folder / "pipe"});
  EXPECT_EQ(read_beginning(inputs.files.at(0), 100), text.substr(0, 100));
  EXPECT_EQ(read_beginning(inputs.files.at(0), 200'000), text.substr(0, 200'000));
  const auto stream = open_input(inputs.files.at(0));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(*stream), {}), text);
}

TEST_F(InputSearch, APipeOfAnotherFormatIsRefused) {
  const FilledPipe pipe(folder / "pipe", cityjson_of("a"));
  EXPECT_THAT(refusal({folder / "pipe"}),
              HasSubstr("is a pipe, and gives no CityGML, OBJ, PLY or GLB: write it to a file first"));
}

TEST(ZipDirectory, NamesEachFileAndItsLock) {
  const auto listings = zip_listings(write_file("a.zip", zip_of({{"a/b.gml", "x"}, {"c", "y", 0, true}})));
  ASSERT_EQ(listings.size(), 2u);
  EXPECT_EQ(listings[0].name, "a/b.gml");
  EXPECT_FALSE(listings[0].is_locked);
  EXPECT_EQ(listings[1].name, "c");
  EXPECT_TRUE(listings[1].is_locked);
}

/// Whatever is cut off or overwritten: no byte outside of the file is asked for.
TEST(ZipDirectory, StaysWithinADamagedFile) {
  const std::string whole = zip_of({{"a/b.gml", "x"}, {"c", "y"}});
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes)
    EXPECT_TRUE(zip_listings(write_file("a.zip", whole.substr(0, bytes))).empty()) << bytes;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = '\xFF';
    EXPECT_LE(zip_listings(write_file("a.zip", damaged)).size(), 2u) << at;
  }
}

TEST(ZipDirectory, KnowsNamesThatLeadOutside) {
  for (const char* name : {"/a", "\\a", "C:/a", "C:a", "..", "../a", "a/../../b", "a/..", "a\\..\\b"})
    EXPECT_TRUE(leads_outside(name)) << name;
  for (const char* name : {"a", "a/b", "a..b", "..a", "a../b", "./a", ""}) EXPECT_FALSE(leads_outside(name)) << name;
}

/// As archives of more than 65,535 files or 4 GiB are written: the usual end says nothing.
TEST(ZipDirectory, OfTheLargeFormatIsRead) {
  using zip_parts::put;
  std::string zip = zip_of({{"a.gml", "a"}, {"../b.gml", "b"}});
  const std::size_t end = zip.rfind("PK\5\6");
  const std::string sizes = zip.substr(end + 12, 8), comment = zip.substr(end + 20);
  std::string large = "PK\6\6";
  put(large, 44, 4), put(large, 0, 4);
  for (int k = 0; k < 7; ++k) put(large, 0, 4);
  large.resize(40, '\0');
  large += sizes.substr(0, 4) + std::string(4, '\0') + sizes.substr(4, 4) + std::string(4, '\0');
  std::string pointer = "PK\6\7";
  put(pointer, 0, 4), put(pointer, static_cast<std::uint32_t>(end), 4), put(pointer, 0, 4), put(pointer, 1, 4);
  const std::string small = std::string("PK\5\6") + std::string(4, '\0') + std::string(12, '\xFF') + comment;
  const auto listings = zip_listings(write_file("large.zip", zip.substr(0, end) + large + pointer + small));
  ASSERT_EQ(listings.size(), 2U);
  EXPECT_EQ(listings[1].name, "../b.gml");
}

}  // namespace
}  // namespace farlod::ingest::test
