// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "georeference/file_axes.hpp"

#include <gtest/gtest.h>

namespace farlod::georeference {
namespace {

TEST(FileAxes, LeadToTheMapAndBack) {
  const Point3d p{32'365'000.25, 5'621'000.5, 200.0};
  const FileAxes zone{AxisOrder::easting_first, 32e6, 1.0}, swapped{AxisOrder::northing_first, 0.0, 0.5};
  EXPECT_EQ(zone.p_map(p), (Point3d{365'000.25, 5'621'000.5, 200.0}));
  EXPECT_EQ(swapped.p_map(p), (Point3d{p.y, p.x, 100.0}));
  for (const FileAxes& axes : {FileAxes{}, zone, swapped, FileAxes{AxisOrder::northing_first, 32e6, 0.5}}) {
    EXPECT_EQ(axes.p_file(axes.p_map(p)), p);
    EXPECT_EQ(axes.p_map(axes.p_file(p)), p);
  }
}

}  // namespace
}  // namespace farlod::georeference
