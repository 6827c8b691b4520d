// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>

#include "farlod/error.hpp"
#include "tests/preprocess/pipeline/packing.hpp"
#include "tests/problems/problem_lists.hpp"

// What the names that a user gives may lead to

namespace farlod::pipeline::test {
namespace {

using farlod::test::good_city;

using testing::ElementsAre;
using testing::HasSubstr;

/// An ESRI ASCII grid of 3 × 3 pixels of 1 km around the sample city.
constexpr const char* flat_raster = "ncols 3\nnrows 3\nxllcorner 548500\nyllcorner 5498500\ncellsize 1000\n7 7 7\n7 7 7\n7 7 7\n";

class PackInputs : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = packing.folder.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }
  std::vector<std::string> inputs_named() const {
    std::vector<std::string> names;
    for (const package::InputFile& input : packing.result.manifest.inputs) names.push_back(input.name);
    return names;
  }
  std::string refusal() {
    try {
      packing.run();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Packing packing;
};

TEST_F(PackInputs, AFolderIsTheFilesInIt) {
  std::filesystem::create_directories(packing.folder.path() / "town");
  std::filesystem::copy(good_city(), packing.folder.path() / "town/b.city.json");
  write("town/a.gml", "");
  write("town/notes.pyc", "nothing");
  packing.settings.inputs = {packing.folder.path() / "town"};
  packing.run();
  EXPECT_THAT(inputs_named(), ElementsAre("a.gml", "b.city.json"));
  EXPECT_EQ(packing.codes(), std::set<int>{118});
  EXPECT_EQ(packing.result.skipped, (SkippedFeatures{{".pyc files", 1}}));
}

TEST_F(PackInputs, ARasterIsASurfaceModel) {
  packing.settings.georeference.crs = "EPSG:32632";
  packing.settings.inputs = {write("dsm.asc", flat_raster)};
  packing.run();
  EXPECT_EQ(packing.result.manifest.buildings, 0U);
  EXPECT_EQ(packing.result.manifest.height_origin_m, 7.0);
  EXPECT_THAT(inputs_named(), ElementsAre("dsm.asc"));
}

TEST_F(PackInputs, ARasterBesideACityIsItsTerrain) {
  packing.settings.inputs = {write("dem.asc", flat_raster), good_city()};
  packing.run();
  EXPECT_THAT(inputs_named(), ElementsAre("village.city.json", "dem.asc"));
  EXPECT_THAT(packing.stages_timed(), testing::Contains("terrain"));
}

TEST_F(PackInputs, TwoRastersAreOneTooMany) {
  packing.settings.georeference.crs = "EPSG:32632";
  packing.settings.inputs = {write("a.asc", flat_raster), write("b.asc", flat_raster)};
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("a.asc"), HasSubstr("b.asc"), HasSubstr("give one of them")));
  packing.settings.inputs = {write("a.asc", flat_raster)};
  packing.settings.terrain = write("b.asc", flat_raster);
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("a.asc"), HasSubstr("--terrain"), HasSubstr("give one of them")));
}

TEST_F(PackInputs, WhatWasTakenFromBesideAMeshIsSaid) {
  packing.settings.inputs = {write("hut.obj", "v 0 0 0\nv 10 0 0\nv 0 8 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")};
  write("hut.offset", "500000 5400000 100");
  write("hut.prj", "EPSG:32632");
  packing.run();
  EXPECT_EQ(packing.result.manifest.epsg, 32632);
  EXPECT_THAT(packing.result.notes,
              ElementsAre(HasSubstr("hut.prj"), HasSubstr("500000.000, 5400000.000, 100.000 of hut.offset")));
}

}  // namespace
}  // namespace farlod::pipeline::test
