// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/canopy_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "farlod/error.hpp"
#include "georeference/crs.hpp"
#include "georeference/output_crs.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod::georeference {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::NanSensitiveFloatEq;

const float none = std::numeric_limits<float>::quiet_NaN();
const Box2d whole_city{{-1000.0, -1000.0}, {1000.0, 1000.0}};

std::vector<float> all_of(const PagedArray<float>& array) { return {array.begin(), array.end()}; }

class CanopyReader : public testing::Test {
 protected:
  /// An ESRI ASCII grid; `sides` are lines such as "cellsize 2".
  [[nodiscard]] std::filesystem::path grid(const std::string& name, const std::string& corner, const std::string& sides,
                                           const std::string& size, const std::string& values) const {
    std::ofstream(folder_.file(name)) << size << corner << sides << "\nNODATA_value -9999\n" << values;
    return folder_.file(name);
  }
  [[nodiscard]] std::filesystem::path tops() const {
    return grid("tops.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 2", "ncols 3\nnrows 2\n", "1 2 3\n4 -9999 6\n");
  }
  [[nodiscard]] static std::pair<CanopyRaster, std::vector<std::string>> read(const CanopyFiles& files,
                                                                              const Box2d& wanted = whole_city) {
    return read_canopy(files, "", georeference_around({1000.0, 2000.0}, *Crs::find("EPSG:25832")), wanted);
  }

  scenes::TemporaryFolder folder_;
};

TEST_F(CanopyReader, TakesSquaresInTheOutputCrsAsTheyAre) {
  const auto [canopy, notes] = read({tops(), {}});
  EXPECT_EQ(canopy.columns, 3U);
  EXPECT_EQ(canopy.rows, 2U);
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{1.0, 3.0})) << "the north-western cell";
  EXPECT_EQ(canopy.centre(2, 1), (Point2d{5.0, 1.0}));
  EXPECT_THAT(all_of(canopy.top_m), ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, NanSensitiveFloatEq(none), 6.0F));
  EXPECT_TRUE(canopy.trunk_m.empty());
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(CanopyReader, ReadsOnlyWhatIsWanted) {
  const auto canopy = read({tops(), {}}, {{-10.0, -10.0}, {0.5, 0.5}}).first;
  EXPECT_EQ(canopy.columns, 2U) << "the wanted column, and one beside it";
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{1.0, 3.0}));
  EXPECT_THROW((void)read({tops(), {}}, {{500.0, 500.0}, {600.0, 600.0}}), InputError);
}

TEST_F(CanopyReader, AsksRastersOfTrunksAtTheCentresOfCells) {
  const auto alike =
      grid("alike.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 2", "ncols 3\nnrows 2\n", "0 1 2\n3 4 -9999\n");
  const auto [canopy, notes] = read({tops(), alike});
  EXPECT_THAT(all_of(canopy.trunk_m), ElementsAre(0.0F, 1.0F, 2.0F, 3.0F, 4.0F, NanSensitiveFloatEq(none)));
  EXPECT_THAT(notes, IsEmpty());
  // Pixels of 4 m, of which the second one covers the last column but for its right half
  const auto coarse = grid("coarse.asc", "xllcorner 1000\nyllcorner 2000\n", "cellsize 4", "ncols 2\nnrows 1\n", "1 2\n");
  const auto [other, told] = read({tops(), coarse});
  EXPECT_THAT(all_of(other.trunk_m), ElementsAre(1.0F, 1.0F, 2.0F, 1.0F, 1.0F, 2.0F));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("another extent or resolution"));
  // One that ends before
  const auto small = grid("small.asc", "xllcorner 1002\nyllcorner 2002\n", "cellsize 2", "ncols 1\nnrows 1\n", "1\n");
  const auto none_there = NanSensitiveFloatEq(none);
  EXPECT_THAT(all_of(read({tops(), small}).first.trunk_m),
              ElementsAre(none_there, 1.0F, none_there, none_there, none_there, none_there));
  const auto elsewhere = grid("elsewhere.asc", "xllcorner 9000\nyllcorner 2002\n", "cellsize 2", "ncols 1\nnrows 1\n", "1\n");
  EXPECT_THAT(all_of(read({tops(), elsewhere}).first.trunk_m), testing::Each(none_there));
}

TEST_F(CanopyReader, BringsOtherPixelsIntoSquares) {
  const auto oblong =
      grid("oblong.asc", "xllcorner 1000\nyllcorner 2000\n", "dx 4\ndy 2", "ncols 2\nnrows 2\n", "1 2\n3 -9999\n");
  const auto [canopy, notes] = read({oblong, {}});
  EXPECT_EQ(canopy.columns, 4U);
  EXPECT_EQ(canopy.rows, 2U);
  EXPECT_NEAR(norm(canopy.column_step), 2.0, 1e-9);
  const auto no = NanSensitiveFloatEq(none);
  EXPECT_THAT(all_of(canopy.top_m), ElementsAre(1.0F, 1.0F, 2.0F, 2.0F, 3.0F, 3.0F, no, no));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0], HasSubstr("its pixels are no squares, it is read in squares of 2 m"));
}

TEST_F(CanopyReader, TurnedSquaresStayTurned) {
  const auto path = folder_.file("turned.vrt");
  // 3 m and 4 m east and north from column to column: squares of 5 m
  std::ofstream(path) << R"(<VRTDataset rasterXSize="3" rasterYSize="2"><GeoTransform>1000, 3, 4, 2000, 4, -3</GeoTransform>)"
                      << R"(<VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">tops.asc)"
                      << "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  (void)tops();
  const auto [canopy, notes] = read({path, {}});
  EXPECT_EQ(canopy.column_step, (Point2d{3.0, 4.0}));
  EXPECT_EQ(canopy.row_step, (Point2d{4.0, -3.0}));
  EXPECT_EQ(canopy.centre(0, 0), (Point2d{3.5, 0.5}));
  EXPECT_EQ(canopy.columns * canopy.rows, 6U);
  EXPECT_THAT(notes, IsEmpty());
}

TEST_F(CanopyReader, RefusesWhatIsNone) {
  EXPECT_THROW((void)read({folder_.file("lost.tif"), {}}), InputError);
  std::ofstream(folder_.file("text.tif")) << "no raster";
  EXPECT_THROW((void)read({folder_.file("text.tif"), {}}), InputError);
  EXPECT_THROW((void)read({tops(), folder_.file("text.tif")}), InputError);
}

}  // namespace
}  // namespace farlod::georeference
