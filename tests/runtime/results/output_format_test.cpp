// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/output_format.hpp"

#include <gtest/gtest.h>

namespace farlod {
namespace {

TEST(OutputFormat, FollowsTheEndingInAnyCase) {
  EXPECT_EQ(output_format_of("out/a.csv"), OutputFormat::csv);
  EXPECT_EQ(output_format_of("A.CSV"), OutputFormat::csv);
  EXPECT_EQ(output_format_of("a.b.Png"), OutputFormat::png);
  EXPECT_EQ(output_format_of("a.asc"), OutputFormat::esri_ascii);
}

TEST(OutputFormat, UnknownEndingsHaveNone) {
  for (const char* path : {"a", "a.csv.gz", "a.", "csv", "folder.csv/a", ""})
    EXPECT_EQ(output_format_of(path), std::nullopt) << path;
}

TEST(OutputFormat, GeoTiffNeedsGdal) {
#ifdef FARLOD_WITH_GDAL
  EXPECT_EQ(output_format_of("a.tif"), OutputFormat::geotiff);
  EXPECT_EQ(output_format_of("a.TIFF"), OutputFormat::geotiff);
  EXPECT_EQ(known_output_endings(), ".tif, .tiff, .csv, .png, .asc");
#else
  EXPECT_EQ(output_format_of("a.tif"), std::nullopt);
  EXPECT_EQ(known_output_endings(), ".csv, .png, .asc");
#endif
}

}  // namespace
}  // namespace farlod
