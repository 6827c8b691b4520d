// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/table/sky_table_ply.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "results/picture/colour_map.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

/// A PLY file, read by its own header.
struct Ply {
  std::vector<std::string> names, types;
  std::vector<std::string> comments;
  std::vector<std::vector<double>> vertices;

  explicit Ply(const std::string& bytes) {
    const std::string end = "end_header\n";
    const std::size_t data = bytes.find(end) + end.size();
    std::istringstream header(bytes.substr(0, data));
    std::size_t count = 0;
    for (std::string line; std::getline(header, line);) take(line, count);
    std::size_t place = data;
    for (std::size_t n = 0; n < count; ++n) {
      vertices.emplace_back();
      for (const std::string& type : types) vertices.back().push_back(value(bytes, place, type));
    }
    EXPECT_EQ(place, bytes.size());
  }
  [[nodiscard]] double at(std::size_t vertex, const std::string& name) const {
    for (std::size_t n = 0; n < names.size(); ++n)
      if (names[n] == name) return vertices.at(vertex)[n];
    ADD_FAILURE() << "no property " << name;
    return 0.0;
  }

 private:
  void take(const std::string& line, std::size_t& count) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type >> name;
    if (word == "comment") comments.push_back(line.substr(8));
    if (word == "element") count = std::stoul(name);
    if (word != "property") return;
    types.push_back(type);
    names.push_back(name);
  }
  static double value(const std::string& bytes, std::size_t& place, const std::string& type) {
    const auto read = [&]<class Number>(Number number) {
      std::memcpy(&number, bytes.data() + place, sizeof(number));
      place += sizeof(number);
      return static_cast<double>(number);
    };
    return type == "double" ? read(0.0) : type == "float" ? read(0.0F) : read(static_cast<unsigned char>(0));
  }
};

constexpr double rounding_of_float = 1e-7;  // of numbers up to 1

TEST(Ply, HasPlacesNormalsAnswersAndColours) {
  const scenes::TemporaryFolder folder;
  const std::vector<float> further{12.5F};
  const std::vector<PointRow> rows{{"a", {500000.125, 5700010.5}, 7.25, 0.5, 0.25, 0.75, 92.0, 90.0, further},
                                   {"in a house", {1.0, 2.0}, {}, {}, {}, {}, {}, {}, further},
                                   {"no answer", {3.0, 4.0}, 5.0, {}, {}, {}, {}, {}, further}};
  TableFrame frame{{"svf", BoundsColumns::yes, {{"sun_h"}}}};
  frame.epsg = 25832;
  frame.convergence = Angle::degrees(2.0);
  frame.provenance = {"Far-LoD", "two\nlines", "", ""};
  write_points_ply({rows.size(), [&](std::size_t n) { return rows[n]; }, nullptr, true}, frame, folder.file("a.ply"));
  const Ply ply(scenes::text_of(folder.file("a.ply")));
  EXPECT_THAT(ply.comments, testing::ElementsAre("software: Far-LoD", "package: two lines", "crs: EPSG:25832"));
  EXPECT_THAT(ply.names, testing::ElementsAre("x", "y", "z", "nx", "ny", "nz", "svf", "svf_low", "svf_high", "sun_h", "red",
                                              "green", "blue"));
  ASSERT_EQ(ply.vertices.size(), 2U);
  EXPECT_EQ(ply.at(0, "x"), 500000.125);
  EXPECT_EQ(ply.at(0, "y"), 5700010.5);
  EXPECT_EQ(ply.at(0, "z"), 7.25);
  // 92° from true north is 90° from the north of the grid
  EXPECT_NEAR(ply.at(0, "nx"), 1.0, rounding_of_float);
  EXPECT_NEAR(ply.at(0, "ny"), 0.0, rounding_of_float);
  EXPECT_NEAR(ply.at(0, "nz"), 0.0, rounding_of_float);
  EXPECT_EQ(ply.at(0, "svf_high"), 0.75);
  EXPECT_EQ(ply.at(0, "sun_h"), 12.5);
  EXPECT_EQ(ply.at(0, "green"), colour_of_svf(0.5).green);
  EXPECT_TRUE(std::isnan(ply.at(1, "svf")));
  EXPECT_EQ(ply.at(1, "nz"), 1.0);
  EXPECT_EQ(ply.at(1, "blue"), nodata_colour.blue);
}

TEST(Ply, HasTheReceiversOfSurfacesInOrder) {
  const scenes::TemporaryFolder folder;
  SurfaceSpool spool(folder.file("a.ply"));
  std::vector<SurfacePoint> rows(3);
  for (std::size_t n = 0; n < rows.size(); ++n) rows[n].p_projected.x = static_cast<double>(n);
  spool.add(2, std::span(rows).subspan(1));
  spool.add(1, std::span(rows).first(1));
  write_receivers_ply(spool, {{"svf_solid"}}, folder.file("a.ply"));
  const Ply ply(scenes::text_of(folder.file("a.ply")));
  ASSERT_EQ(ply.vertices.size(), 3U);
  for (std::size_t n = 0; n < rows.size(); ++n) EXPECT_EQ(ply.at(n, "x"), static_cast<double>(n));
  EXPECT_EQ(ply.names[6], "svf_solid");
}

}  // namespace
}  // namespace farlod
