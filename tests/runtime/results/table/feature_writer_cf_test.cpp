// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
// Points as netCDF, read back by GDAL's driver of arrays of any dimension.
#include <gdal_priv.h>
#include <gmock/gmock.h>

#include <cmath>

#include "results/output_format.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::HasSubstr;

/// More rows than are written at a time, of which every third has no answer; the longest id comes last.
constexpr std::size_t count = 40'000;

std::string id_of(std::size_t n) { return n + 1 == count ? "die längste von allen" : "p" + std::to_string(n); }

class CfPoints : public testing::Test {
 protected:
  CfPoints() {
    Attributes attributes{{"a/b", "height"}};
    for (std::size_t n = 0; n < count; ++n)
      attributes.add_row(std::vector<std::string>{n == 1 ? "" : std::to_string(n), std::to_string(n) + ".5"});
    std::string id;
    const auto row = [&id](std::size_t n) {
      id = id_of(n);
      PointRow point{id, {500000.0 + static_cast<double>(n), 5700000.5}, 1.5, 0.25, 0.125, 0.5, {}, {}};
      if (n % 3 == 2) point.svf = point.low = point.high = std::nullopt;
      return point;
    };
    const TableFrame frame{
        {"svf", BoundsColumns::yes}, small_raster().crs_wkt, 25832, {}, {"Far-LoD 1", "town.farlod", "0", "-"}};
    output_format_of("p.nc")->write_points({count, row, &attributes, false}, frame, folder_.file("p.nc"));
    GDALAllRegister();
    file_.reset(GDALDataset::Open(folder_.file("p.nc").c_str(), GDAL_OF_MULTIDIM_RASTER));
    root_ = file_ ? file_->GetRootGroup() : nullptr;
  }
  [[nodiscard]] std::shared_ptr<GDALMDArray> column(const std::string& name) const { return root_->OpenMDArray(name); }
  [[nodiscard]] std::vector<double> numbers(const std::string& name) const {
    std::vector<double> values(count);
    const std::vector<GUInt64> first{0};
    const std::vector<size_t> size{count};
    EXPECT_TRUE(column(name)->Read(first.data(), size.data(), nullptr, nullptr, GDALExtendedDataType::Create(GDT_Float64),
                                   values.data()));
    return values;
  }
  [[nodiscard]] std::string text(const std::string& variable, const char* attribute) const {
    const auto found = column(variable)->GetAttribute(attribute);
    return found ? found->ReadAsString() : "";
  }

  scenes::TemporaryFolder folder_;
  GDALDatasetUniquePtr file_;
  std::shared_ptr<GDALGroup> root_;
};

TEST_F(CfPoints, HaveTheirValuesRowByRow) {
  ASSERT_NE(root_, nullptr);
  const std::vector<double> svf = numbers("svf"), x_m = numbers("x_m"), height = numbers("height"), whole = numbers("a_b");
  for (std::size_t n = 0; n < count; ++n) {
    ASSERT_EQ(x_m[n], 500000.0 + static_cast<double>(n));
    ASSERT_EQ(height[n], static_cast<double>(n) + 0.5);
    ASSERT_EQ(std::isnan(svf[n]), n % 3 == 2) << n;
    ASSERT_TRUE(n % 3 == 2 || svf[n] == 0.25) << n;
    ASSERT_EQ(whole[n], n == 1 ? static_cast<double>(INT64_MIN) : static_cast<double>(n));
  }
  EXPECT_EQ(column("a_b")->GetNoDataValueAsInt64(), INT64_MIN);
}

TEST_F(CfPoints, SayWhatTheConventionsWantToKnow) {
  ASSERT_NE(root_, nullptr);
  EXPECT_EQ(std::string(root_->GetAttribute("featureType")->ReadAsString()), "point");
  EXPECT_EQ(std::string(root_->GetAttribute("Conventions")->ReadAsString()), "CF-1.8");
  EXPECT_EQ(std::string(root_->GetAttribute("source")->ReadAsString()), "Far-LoD 1");
  EXPECT_EQ(text("svf_low", "coordinates"), "x_m y_m z_m");
  EXPECT_EQ(text("svf_low", "grid_mapping"), "crs");
  EXPECT_THAT(text("svf_low", "long_name"), HasSubstr("lower bound"));
  EXPECT_EQ(text("x_m", "standard_name"), "projection_x_coordinate");
  EXPECT_EQ(text("crs", "grid_mapping_name"), "transverse_mercator");
  EXPECT_EQ(column("x_m")->GetUnit(), "m");
}

TEST_F(CfPoints, HaveTextsAsLongAsTheLongest) {
  ASSERT_NE(root_, nullptr);
  const auto ids = column("id");
  ASSERT_NE(ids, nullptr);
  for (const std::size_t n : {std::size_t{0}, std::size_t{16'384}, count - 1}) {
    char* id = nullptr;  // GDAL takes rows of characters for texts
    const std::vector<GUInt64> first{n};
    const std::vector<size_t> size{1};
    ASSERT_TRUE(ids->Read(first.data(), size.data(), nullptr, nullptr, GDALExtendedDataType::CreateString(), &id));
    EXPECT_EQ(std::string(id), id_of(n));
    CPLFree(id);
  }
  EXPECT_EQ(text("id", "_Encoding"), "utf-8");
}

TEST_F(CfPoints, HaveTheSameBytesEachTime) {
  const std::string bytes = scenes::text_of(folder_.file("p.nc"));
  const CfPoints_HaveTheSameBytesEachTime_Test again;
  EXPECT_TRUE(bytes == scenes::text_of(again.folder_.file("p.nc")));
  EXPECT_LT(bytes.size(), count * 30);
}

}  // namespace
}  // namespace farlod
