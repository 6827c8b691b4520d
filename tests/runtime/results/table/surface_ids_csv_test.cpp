// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "results/table/sky_table_csv.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

TEST(SurfacesCsv, HasIdsWhereASurfaceHasOne) {
  const scenes::TemporaryFolder folder;
  std::vector<SurfaceMean> rows(2);
  rows[1].id = "UUID,1";
  write_surfaces_csv(rows, {"svf"}, folder.file("a.csv"));
  EXPECT_EQ(scenes::text_of(folder.file("a.csv")),
            "building,surface,kind,azimuth_deg,tilt_deg,area_m2,receivers,nodata,svf_mean,svf_min,svf_max,covered_area_m2,"
            "surface_id\n"
            ",0,unknown,0,0,0,0,0,,,,0,\n"
            ",0,unknown,0,0,0,0,0,,,,0,\"UUID,1\"\n");
}

}  // namespace
}  // namespace farlod
