// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/energyplus_idf.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;

/// Another quantity stands before the view factors.
const std::vector<std::string> columns_with_views{"svf_solid",   "view_sky",    "view_ground", "view_roof",  "view_wall_n",
                                                  "view_wall_e", "view_wall_s", "view_wall_w", "view_crown", "view_other"};

SurfaceMean surface_that_sees(double area_m2, std::vector<double> views) {
  SurfaceMean mean;
  mean.building = "b,1";
  mean.surface = 7;
  mean.area_m2 = area_m2;
  mean.further_mean = std::move(views);
  if (!mean.further_mean.empty()) mean.further_mean.insert(mean.further_mean.begin(), 0.77);
  return mean;
}

class EnergyPlusIdf : public testing::Test {
 protected:
  /// The fields of all objects, with the object's class first, without comments.
  [[nodiscard]] std::vector<std::vector<std::string>> objects(const std::vector<SurfaceMean>& surfaces) const {
    write_energyplus_idf(surfaces, columns_with_views, path);
    std::vector<std::vector<std::string>> found(1);
    std::istringstream lines(scenes::text_of(path));
    for (std::string line; std::getline(lines, line);) {
      line.erase(std::min(line.find('!'), line.size()));
      const std::size_t end = line.find_first_of(",;");
      if (end == std::string::npos) continue;
      const std::size_t begin = line.find_first_not_of(' ');
      found.back().push_back(line.substr(begin, end - begin));
      if (line[end] == ';') found.emplace_back();
    }
    found.pop_back();
    return found;
  }
  scenes::TemporaryFolder folder;
  std::filesystem::path path = folder.file("o.idf");
};

TEST_F(EnergyPlusIdf, HasTheFieldsOfBothObjects) {
  const auto all = objects({surface_that_sees(10.0, {0.25, 0.375, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.125})});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_THAT(all[0], ElementsAre("SurfaceProperty:LocalEnvironment", "Far-LoD b_1_7", "b_1_7", "", "Far-LoD b_1_7"));
  EXPECT_THAT(all[1],
              ElementsAre("SurfaceProperty:SurroundingSurfaces", "Far-LoD b_1_7", "0.250000", "", "0.374999", "", "Far-LoD Roofs",
                          "0.250000", "Far-LoD Roofs Temperature", "Far-LoD Other", "0.125000", "Far-LoD Other Temperature"));
}

TEST_F(EnergyPlusIdf, PolygonsOfANameAreOneSurfaceAndWhatIsCoveredIsNone) {
  std::vector<SurfaceMean> surfaces{surface_that_sees(30.0, {0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0}),
                                    surface_that_sees(0.0, {}),
                                    surface_that_sees(10.0, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0})};
  surfaces[0].id = surfaces[2].id = "the roof";
  const auto all = objects(surfaces);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0][2], "the roof");
  // (30 m² × .5 + 10 m² × 1) / 40 m²
  EXPECT_THAT(all[1], ElementsAre("SurfaceProperty:SurroundingSurfaces", "Far-LoD the roof", "0.624999", "", "0.000000", "",
                                  "Far-LoD Walls West", "0.375000", "Far-LoD Walls West Temperature"));
}

TEST_F(EnergyPlusIdf, OneSurroundingSurfaceIsThereAlways) {
  EXPECT_THAT(objects({surface_that_sees(1.0, {0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0})})[1],
              ElementsAre("SurfaceProperty:SurroundingSurfaces", "Far-LoD b_1_7", "0.499999", "", "0.500000", "", "Far-LoD Other",
                          "0.000000", "Far-LoD Other Temperature"));
}

TEST_F(EnergyPlusIdf, NeverAddsUpToMoreThanOne) {
  // Each but the last is rounded up
  const auto object = objects({surface_that_sees(
      3.0, {0.2000006, 0.1000006, 0.1000006, 0.1000006, 0.1000006, 0.1000006, 0.1000006, 0.1000006, 0.0999952})})[1];
  double sum = std::stod(object[2]) + std::stod(object[4]);
  for (std::size_t n = 7; n < object.size(); n += 3) sum += std::stod(object[n]);
  EXPECT_LT(sum, 1.0);
  EXPECT_GT(sum, 0.99999);
}

TEST_F(EnergyPlusIdf, ADiskThatRefusesIsTold) {
  EXPECT_THROW(write_energyplus_idf({}, columns_with_views, folder.file("nowhere") / "o.idf"), OutputError);
}

}  // namespace
}  // namespace farlod
