// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "farlod/error.hpp"
#include "farlod/version.hpp"
#include "tests/acceptance/small_town.hpp"
#include "tests/acceptance/work_folder.hpp"

namespace farlod::acceptance {
namespace {

using testing::HasSubstr;
using testing::Not;

class StartOf : public testing::TestWithParam<const char*> {};

TEST_P(StartOf, LoadsNeitherGdalNorCairo) {
  const WorkFolder folder;
  const Outcome loaded = folder.run("ldd $(command -v " + std::string(GetParam()) + ")");
  EXPECT_THAT(loaded.out, HasSubstr("libembree"));  // or else these are not the libraries of the program
  for (const char* library : {"libgdal", "libnetcdf", "libproj", "libcairo", "libpango"})
    EXPECT_THAT(loaded.out, Not(HasSubstr(library)));
}

INSTANTIATE_TEST_SUITE_P(Modules, StartOf, testing::Values("farlod-svf", "farlod-info", "farlod-view"),
                         [](const auto& program) { return std::string(program.param).substr(sizeof("farlod-") - 1); });

/// The program without the modules of its build: a test puts what it likes in their place.
class WithoutModules : public testing::Test {
 protected:
  WithoutModules() {
    add_packed_town(folder, "one_block", {{"block", {}, 20.0, 10.0}});
    folder.must("mkdir -p bin lib/farlod && cp $(command -v farlod-svf) bin");
  }
  [[nodiscard]] std::string folder_of_build() const { return "$(dirname $(command -v farlod-svf))/../lib/farlod"; }

  WorkFolder folder;
  const std::string map = "bin/farlod-svf a.farlod --grid 20 --quiet -o ";
};

TEST_F(WithoutModules, TablesAreWritten) {
  folder.must("bin/farlod-svf a.farlod -o o.csv --at 500030,5500010 --quiet");
  EXPECT_TRUE(folder.has("o.csv"));
}

#ifdef FARLOD_WITH_GDAL
TEST_F(WithoutModules, MapsAreRefused) {
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input,
                 {"this needs GDAL", "lib/farlod/farlod_gdal.so", "No such file", "Install Far-LoD with its folder lib/farlod"});
  EXPECT_FALSE(folder.has("o.tif"));
}

TEST_F(WithoutModules, AStrangeLibraryIsNoModule) {
  folder.must("cp $(ldd bin/farlod-svf | sed -n 's/.*libtbb.* => \\([^ ]*\\).*/\\1/p') lib/farlod/farlod_gdal.so");
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input, {"farlod_gdal.so is no module of Far-LoD"});
}

TEST_F(WithoutModules, AModuleOfAnotherVersionIsRefused) {
  folder.must("sed 's/" + std::string(software_version) + "/9.9.9/g' " + folder_of_build() +
              "/farlod_gdal.so > lib/farlod/farlod_gdal.so");
  expect_refusal(folder.run(map + "o.tif"), exit_unusable_input,
                 {"farlod_gdal.so is of Far-LoD 9.9.9, and the program of " + std::string(software_version)});
}

TEST_F(WithoutModules, MovedTogetherTheyWork) {
  folder.must("cp " + folder_of_build() + "/*.so lib/farlod && " + map + "o.tif --preview o.png");
  EXPECT_TRUE(folder.has("o.tif"));
  EXPECT_TRUE(folder.has("o.png"));
}
#endif

TEST_F(WithoutModules, PicturesAreRefused) {
  expect_refusal(folder.run(map + "o.png"), exit_unusable_input, {"this needs Cairo and Pango", "lib/farlod/farlod_cairo.so"});
}

}  // namespace
}  // namespace farlod::acceptance
