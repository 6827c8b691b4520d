// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/rules.hpp"

#include <gmock/gmock.h>

namespace farlod {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// A tree around the file under test, with a header on each side that it may name.
std::vector<SourceFile> tree_with(const std::string& path, const std::string& include_line) {
  return {{"console/progress.hpp", {}},
          {"preprocess/tiles/cutter.hpp", {}},
          {"runtime/occlusion/queries_embree.hpp", {}},
          {"package/reader.hpp", {}},
          {path, {"// a line before", include_line}}};
}

TEST(IncludeWalls, StandInThisTree) {
  const std::vector<SourceFile> tree = read_source_tree(FARLOD_SOURCE_DIR);
  ASSERT_GT(tree.size(), 20U) << "the tree was not found at " << FARLOD_SOURCE_DIR;
  std::string all;
  for (const std::string& breach : breaches_of_include_walls(tree)) all.append(breach).append("\n");
  EXPECT_EQ(all, "");
}

TEST(IncludeWalls, HaveNoExemptionThatNobodyNeeds) {
  EXPECT_THAT(useless_exemptions(read_source_tree(FARLOD_SOURCE_DIR)), IsEmpty());
}

TEST(IncludeWalls, AnExemptionThatNobodyNeedsIsFound) {
  const auto found = [](const char* path, const char* include_line) { return useless_exemptions(tree_with(path, include_line)); };
  const auto for_cgal = HasSubstr("CGAL's wrapper"), for_trial = HasSubstr("trial: evaluate/sky_evaluator.hpp");
  EXPECT_THAT(useless_exemptions({}), AllOf(Contains(for_cgal), Contains(for_trial)));
  EXPECT_THAT(found("preprocess/tiles/kernel_cgal.hpp", "#include <CGAL/Gmpq.h>"), Not(Contains(for_cgal)));
  EXPECT_THAT(found("preprocess/tiles/kernel_cgal.hpp", "#include <vector>"), Contains(for_cgal));
  EXPECT_THAT(found("preprocess/trial/a.cpp", "#include \"evaluate/sky_evaluator.hpp\""), Not(Contains(for_trial)));
  EXPECT_THAT(found("preprocess/tiles/a.cpp", "#include \"evaluate/sky_evaluator.hpp\""), Contains(for_trial));
}

struct Planted {
  const char* path;
  const char* include_line;
  const char* reason;
};

class PlantedBreach : public testing::TestWithParam<Planted> {};

TEST_P(PlantedBreach, IsFound) {
  const Planted& planted = GetParam();
  const std::vector<std::string> breaches = breaches_of_include_walls(tree_with(planted.path, planted.include_line));
  EXPECT_THAT(breaches, Contains(testing::AllOf(HasSubstr(std::string(planted.path) + ":2 "), HasSubstr(planted.reason))));
}

INSTANTIATE_TEST_SUITE_P(
    IncludeWalls, PlantedBreach,
    testing::Values(Planted{"include/farlod/a.hpp", "#include <boost/version.hpp>", "standard library only"},
                    Planted{"include/farlod/a.hpp", "#include \"base/grid.hpp\"", "standard library only"},
                    Planted{"base/a.hpp", "#include <expat.h>", "standard library only"},
                    Planted{"base/a.hpp", "#include \"occlusion/occluder.hpp\"", "standard library only"},
                    Planted{"base/a.cpp", "#include <xxhash.h>", "nothing of packages"},
                    Planted{"base/a.cpp", "#include \"package/reader.hpp\"", "nothing of packages"},
                    Planted{"console/a.cpp", "#include \"package/file_stamp.hpp\"", "of the own side"},
                    Planted{"runtime/scene/a.cpp", "#include <CGAL/Simple_cartesian.h>", "geometry stack"},
                    Planted{"runtime/scene/a.cpp", "#include <proj.h>", "geometry stack"},
                    Planted{"runtime/scene/a.cpp", "#include <libxml/tree.h>", "geometry stack"},
                    Planted{"runtime/results/city/a_expat.cpp", "#include <expat.h>", "never needs Expat"},
                    Planted{"runtime/scene/a_expat.cpp", "#include <expat.h>", "never needs Expat"},
                    Planted{"runtime/results/reproject_gdal.cpp", "#include <GeographicLib/UTMUPS.hpp>", "geometry stack"},
                    Planted{"runtime/receivers/a_gdal.cpp", "#include <ogr_spatialref.h>", "never needs GDAL"},
                    Planted{"runtime/receivers/a_gdal.cpp", "#include \"gdal/gdal_errors.hpp\"", "never needs GDAL"},
                    Planted{"runtime/results/a.cpp", "#include <gdal_priv.h>", "never needs GDAL"},
                    Planted{"runtime/results/a_gdal.hpp", "#include <ogr_spatialref.h>", "never needs GDAL"},
                    Planted{"runtime/evaluate/a_gdal.cpp", "#  include <cpl_conv.h>", "never needs GDAL"},
                    Planted{"runtime/results/raster/a.cpp", "#include \"gdal/gdal_errors.hpp\"", "never needs GDAL"},
                    Planted{"gdal/a_gdal.cpp", "#include \"package/reader.hpp\"", "own side"},
                    Planted{"runtime/evaluate/a.cpp", "#include <ogr_spatialref.h>", "never needs GDAL"},
                    Planted{"runtime/evaluate/a_gdal.cpp", "#include <ogr_spatialref.h>", "never needs GDAL"},
                    Planted{"runtime/evaluate/a_gdal.cpp", "#include \"gdal/gdal_errors.hpp\"", "never needs GDAL"},
                    Planted{"python/binding/a.cpp", "#include \"evaluate/sky_evaluator.hpp\"", "user of the libraries"},
                    Planted{"python/preprocess/module/a.cpp", "#include <gdal.h>", "user of the libraries"},
                    Planted{"python/runtime_module/a.cpp", "#include \"farlod/pack.hpp\"", "under Apache-2.0"},
                    Planted{"python/binding/a.hpp", "#include \"python/preprocess/module/packing.hpp\"", "under Apache-2.0"},
                    Planted{"runtime/view/a.cpp", "#include <zlib.h>", "wrapper of zlib"},
                    Planted{"runtime/view/a_dlopen.cpp", "#include <dlfcn.h>", "one file loads modules"},
                    Planted{"runtime/app/a.cpp", "#include <pybind11/pybind11.h>", "only wrapper of Python"},
                    Planted{"runtime/app/a.cpp", "#include \"package/reader.hpp\"", "a user of the library"},
                    Planted{"runtime/results/a.cpp", "#include \"evaluate/sky_evaluator.hpp\"", "a user of the library"},
                    Planted{"preprocess/app/a.cpp", "#include \"tiles/cutter.hpp\"", "a user of the library"},
                    Planted{"runtime/scene/a_embree.cpp", "#include <embree3/rtcore.h>", "only wrapper of Embree"},
                    Planted{"runtime/scene/a.cpp", "#include \"occlusion/queries_embree.hpp\"", "only wrapper of Embree"},
                    Planted{"runtime/scene/a_embree.hpp", "#include <embree4/rtcore.h>", "only wrapper of Embree"},
                    Planted{"runtime/occlusion/occluder.hpp", "#include <embree4/rtcore.h>", "headers name no foreign library"},
                    Planted{"runtime/scene/a.cpp", "#include <OpenEXR/ImfTiledInputFile.h>", "only the package room"},
                    Planted{"runtime/scene/a.cpp", "#include <boost/interprocess/mapped_region.hpp>", "only the package room"},
                    Planted{"package/a.cpp", "#include <ImfTiledInputFile.h>", "OpenEXR's wrappers"},
                    Planted{"package/a.cpp", "#include <boost/interprocess/mapped_region.hpp>", "one wrapper"},
                    Planted{"package/a.hpp", "#include <xxhash.h>", "no foreign library"},
                    Planted{"package/a.cpp", "#include \"tiles/cutter.hpp\"", "own side"},
                    Planted{"runtime/scene/a.cpp", "#include \"tiles/cutter.hpp\"", "own side"},
                    Planted{"runtime/scene/a.cpp", "#include \"console/progress.hpp\"", "own side"},
                    Planted{"console/a.cpp", "#include \"package/reader.hpp\"", "own side"},
                    Planted{"console/a.cpp", "#include <gdal.h>", "not what about"},
                    Planted{"datasets/generator/a.cpp", "#include \"tiles/cutter.hpp\"", "own side"},
                    Planted{"runtime/scene/a.cpp", "#include \"benchmark/contest.hpp\"", "own side"},
                    Planted{"benchmark/a.cpp", "#include \"tests/oracles/far_view.hpp\"", "and no test"},
                    Planted{"validation/a.hpp", "#include \"tests/analytic/oracles.hpp\"", "and no test"},
                    Planted{"runtime/scene/a.cpp", "#include \"../package/reader.hpp\"", "own side"}));

INSTANTIATE_TEST_SUITE_P(
    IncludeWallsOfPreprocess, PlantedBreach,
    testing::Values(Planted{"preprocess/tiles/a.cpp", "#include <embree3/rtcore.h>", "through runtime/occlusion"},
                    Planted{"preprocess/farmap/a.cpp", "#include \"occlusion/queries_embree.hpp\"", "through runtime/occlusion"},
                    Planted{"preprocess/tiles/a.cpp", "#include <CGAL/Gmpq.h>", "CGAL's wrapper"},
                    Planted{"preprocess/ingest/a.cpp", "#include <ogrsf_frmts.h>", "GDAL's wrappers"},
                    Planted{"preprocess/ingest/a.cpp", "#include \"gdal/gdal_errors.hpp\"", "GDAL's wrappers"},
                    Planted{"preprocess/ingest/a.cpp", "#include <proj.h>", "PROJ's wrapper"},
                    Planted{"preprocess/georeference/a_proj.cpp", "#include <GeographicLib/UTMUPS.hpp>",
                            "GeographicLib's wrapper"},
                    Planted{"preprocess/ingest/a.cpp", "#include <expat.h>", "Expat's wrapper"},
                    Planted{"preprocess/ingest/a.cpp", "#include <nlohmann/json.hpp>", "nlohmann-json's wrapper"},
                    Planted{"preprocess/tiles/a_openexr.cpp", "#include <OpenEXR/ImfArray.h>", "only the package room"},
                    Planted{"preprocess/tiles/a.cpp", "#include \"occlusion/occluder.hpp\"", "only farmap casts rays"},
                    Planted{"preprocess/align/a.cpp", "#include \"tiles/cutter.hpp\"", "that stage is later"},
                    Planted{"preprocess/app/a.cpp", "#include \"scene/scene.hpp\"", "own side"},
                    Planted{"preprocess/farmap/a.cpp", "#include \"evaluate/sky_evaluator.hpp\"", "own side"},
                    Planted{"preprocess/trial/a.cpp", "#include \"horizon/horizon_engine.hpp\"", "own side"},
                    Planted{"preprocess/farmap/a.cpp", "#include \"trial/far_map_trial.hpp\"", "that stage is later"},
                    Planted{"preprocess/farmap/a.cpp", "#include <png.h>", "the wrapper of Cairo"},
                    Planted{"runtime/results/picture/a.cpp", "#include <cairo.h>", "the wrapper of Cairo"},
                    Planted{"runtime/results/raster/a.cpp", "#include <netcdf.h>", "the wrapper of netCDF"},
                    Planted{"runtime/results/a.cpp", "#include <xxhash.h>", "the wrappers of xxHash"},
                    Planted{"runtime/results/picture/a.cpp", "#include <pango/pangocairo.h>", "the wrapper of Cairo"},
                    Planted{"runtime/sun/a.cpp", "#include <erfa.h>", "ERFA's wrapper"},
                    Planted{"runtime/sun/a.cpp", "#include \"run/facing.hpp\"", "a user of the library"},
                    Planted{"runtime/weather/a.cpp", "#include \"evaluate/sky_parts.hpp\"", "a user of the library"},
                    Planted{"runtime/inputs/a.cpp", "#include \"canopy/canopy_sky.hpp\"", "a user of the library"},
                    Planted{"runtime/canopy/a.cpp", "#include \"scene/ray_scenes.hpp\"", "above horizons"},
                    Planted{"preprocess/farmap/a.cpp", "#include <iostream>", "neither print"},
                    Planted{"preprocess/farmap/a.cpp", "#include <CLI/CLI.hpp>", "neither print"},
                    Planted{"preprocess/farmap/a.hpp", "#include <tbb/parallel_for.h>", "headers name no foreign library"},
                    Planted{"preprocess/farmap/a.hpp", "#include <nlohmann/json.hpp>", "headers name no foreign library"}));

TEST(IncludeWalls, WrappersMayInclude) {
  const Planted allowed[]{{"include/farlod/a.hpp", "#include <vector>", ""},
                          {"include/farlod/a.hpp", "#include \"farlod/point.hpp\"", ""},
                          {"base/a.hpp", "#include \"farlod/point.hpp\"", ""},
                          {"package/a.hpp", "#include \"base/grid.hpp\"", ""},
                          {"runtime/results/raster/raster_writer_gdal.cpp", "#include <gdal_priv.h>", ""},
                          {"runtime/results/a_gdal.cpp", "#include \"gdal/gdal_errors.hpp\"", ""},
                          {"runtime/occlusion/occluder_embree.cpp", "#include <embree3/rtcore.h>", ""},
                          {"runtime/occlusion/queries_embree.hpp", "#include <embree4/rtcore.h>", ""},
                          {"runtime/occlusion/a_embree.cpp", "#include \"occlusion/queries_embree.hpp\"", ""},
                          {"package/a_boost.cpp", "#include <boost/interprocess/mapped_region.hpp>", ""},
                          {"runtime/evaluate/a.cpp", "#include \"package/reader.hpp\"", ""},
                          {"runtime/app/a.cpp", "#include \"console/progress.hpp\"", ""},
                          {"runtime/app/a.hpp", "#include <CLI/CLI.hpp>", ""},
                          {"preprocess/tiles/kernel_cgal.hpp", "#include <CGAL/Gmpq.h>", ""},
                          {"preprocess/farmap/a.cpp", "#include \"tiles/cutter.hpp\"", ""},
                          {"preprocess/farmap/a.cpp", "#include \"occlusion/occluder.hpp\"", ""},
                          {"preprocess/trial/a.cpp", "#include \"evaluate/sky_evaluator.hpp\"", ""},
                          {"preprocess/pipeline/a.cpp", "#include \"package/reader.hpp\"", ""},
                          {"validation/a.hpp", "#include \"tests/scenes/packed_city.hpp\"", ""},
                          {"tests/agreement/a.cpp", "#include <CGAL/Gmpq.h>", ""}};
  for (const Planted& planted : allowed)
    EXPECT_THAT(breaches_of_include_walls(tree_with(planted.path, planted.include_line)), IsEmpty()) << planted.path;
}

TEST(IncludeCircles, FoldersOfPreprocessFormNone) {
  EXPECT_THAT(include_circles(read_source_tree(FARLOD_SOURCE_DIR), "preprocess/"), IsEmpty());
}

TEST(IncludeCircles, AFolderAndItsOwnSubfolderAreFound) {
  const std::vector<SourceFile> tree{{"preprocess/ingest/ingest.cpp", {"#include \"ingest/obj/reader.hpp\""}},
                                     {"preprocess/ingest/model.hpp", {}},
                                     {"preprocess/ingest/obj/reader.hpp", {"#include \"ingest/model.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"),
              ElementsAre(AllOf(StartsWith("preprocess/ingest -> preprocess/ingest/obj -> preprocess/ingest: "),
                                HasSubstr("preprocess/ingest/ingest.cpp includes ingest/obj/reader.hpp"),
                                HasSubstr("preprocess/ingest/obj/reader.hpp includes ingest/model.hpp"))));
}

TEST(IncludeCircles, ALongCircleIsFound) {
  const std::vector<SourceFile> tree{{"preprocess/a/a.hpp", {"#include \"b/b.hpp\""}},
                                     {"preprocess/b/b.hpp", {"#include \"c/c.hpp\""}},
                                     {"preprocess/c/c.hpp", {"#include \"a/a.hpp\""}},
                                     {"preprocess/d/d.hpp", {"#include \"a/a.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"), ElementsAre(StartsWith("preprocess/a -> preprocess/b -> preprocess/c -> ")));
}

TEST(IncludeCircles, SharedFoldersAndOtherSidesAreNone) {
  const std::vector<SourceFile> tree{{"preprocess/a/a.hpp", {"#include \"b/b.hpp\"", "#include \"c/c.hpp\""}},
                                     {"preprocess/b/b.hpp", {"#include \"c/c.hpp\"", "#include \"farlod/grid.hpp\""}},
                                     {"preprocess/c/c.hpp", {"#include \"c/d.hpp\"", "#include <vector>"}},
                                     {"preprocess/c/d.hpp", {}},
                                     {"runtime/c/c.hpp", {"#include \"a/a.hpp\""}}};
  EXPECT_THAT(include_circles(tree, "preprocess/"), IsEmpty());
}

}  // namespace
}  // namespace farlod
