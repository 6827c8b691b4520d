// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/acceptance/packed_town.hpp"
#include "tests/acceptance/real_city.hpp"

namespace farlod::acceptance {
namespace {

/// The system in which the buildings' places are compared, by receivers at the same whole metres.
constexpr const char* same_place = " --crs EPSG:6697 --out-crs EPSG:6677 --align none --quiet";
constexpr const char* exactly = " --grid 1 --engine exact --rays 1000 --quiet";
/// Two towns are not cut alike, so that of a receiver's rays one may graze an edge here and there.
constexpr double two_rays = 2.0 / 1000.0;

const std::string clean_town = "tokyo/53392633_bldg_6697_2_op.gml";

/// A copy of a CityGML file with one of its buildings only.
std::string with_one_building(const std::string& file, const std::string& id) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  const std::string all = std::move(text).str(), begin = "<core:cityObjectMember>", end = "</core:cityObjectMember>";
  const std::size_t wanted = all.find("\"" + id + "\""), from = all.rfind(begin, wanted), to = all.find(end, wanted) + end.size();
  return all.substr(0, all.find(begin)) + all.substr(from, to - from) + all.substr(all.rfind(end) + end.size());
}

/// A damaged copy of the town, or of one building of it.
struct Damage {
  const char* file;
  const char* only_building;  ///< of which there are damaged copies, and nothing else
  std::vector<int> codes;     ///< that are reported because of the damage, besides other levels of detail
};
void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.file; }

class RepairedTowns : public RealCity, public testing::WithParamInterface<Damage> {
 protected:
  void pack(const std::string& file, const std::string& package) const {
    folder.must("farlod-pack " + file + same_place + " -o " + package + " --report " + package + ".json");
  }
  /// The map on the ground, or on top of whatever stands there.
  [[nodiscard]] RasterFile map_of(const std::string& package, const char* where) const {
    folder.must("farlod-svf " + package + " -o " + package + ".asc " + where + exactly);
    return read_raster(folder.path(package + ".asc"));
  }
  void expect_same(const RasterFile& clean, const RasterFile& repaired) const {
    ASSERT_EQ(clean.values.size(), repaired.values.size());
    for (std::size_t n = 0; n < clean.values.size(); ++n) {
      ASSERT_EQ(clean.values[n].has_value(), repaired.values[n].has_value()) << n;
      if (clean.values[n]) {
        EXPECT_NEAR(*clean.values[n], *repaired.values[n], two_rays) << n;
      }
    }
  }
};

/// What was damaged in these files is hidden by the rest of its building, or is a copy of what is sound, or lies nowhere in town:
/// so that the repaired town has the sky of the clean one everywhere, not only far from the damage.
TEST_P(RepairedTowns, HaveTheSkyOfTheCleanTown) {
  const std::string damaged = data(std::string("broken/") + GetParam().file);
  needs({clean_town, std::string("broken/") + GetParam().file});
  if (IsSkipped()) return;
  std::string clean = data(clean_town);
  if (*GetParam().only_building != '\0') {
    folder.write("one.gml", with_one_building(clean, GetParam().only_building));
    clean = "one.gml";
  }
  pack(clean, "clean");
  pack(damaged, "repaired");
  for (const char* where : {"", "--on-surface"}) expect_same(map_of("clean", where), map_of("repaired", where));
  std::set<int> codes;
  for (const nlohmann::json& entry : folder.json_of("repaired.json")) codes.insert(entry.at("code").get<int>());
  for (const int code : GetParam().codes) EXPECT_TRUE(codes.contains(code)) << code;
}

INSTANTIATE_TEST_SUITE_P(All, RepairedTowns,
                         testing::Values(Damage{"invalid.gml", "", {207}}, Damage{"L13.gml", "", {105, 207}},
                                         Damage{"C01_C04_L05_L06_L07_L11_L13_T03_invalid_demo.gml",
                                                "bldg_1290f570-9df8-4956-bef3-6d0976c835be",
                                                {105, 204, 207}}));

}  // namespace
}  // namespace farlod::acceptance
