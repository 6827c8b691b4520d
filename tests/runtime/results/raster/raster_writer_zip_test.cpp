// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raster/raster_writer_zip_gdal.hpp"

#include <gmock/gmock.h>

#include "results/raster/raster_writer_gdal.hpp"
#include "tests/runtime/results/raster/small_raster.hpp"
#include "tests/scenes/temporary_folder.hpp"

namespace farlod {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

WholeRaster raster_with_bounds() {
  WholeRaster raster = small_raster();
  raster.bands = svf_bands("svf", RasterBands::svf_and_bounds);
  raster.low = raster.high = raster.svf;
  return raster;
}

TEST(ZippedGeotiffs, AreTheFilesThatTheirBandsWouldBe) {
  const scenes::TemporaryFolder folder;
  write_whole<ZippedGeotiffWriter>(raster_with_bounds(), folder.file("a.zip"));
  EXPECT_THAT(folder.names(), ElementsAre("a.zip"));
  const std::string zip = scenes::text_of(folder.file("a.zip"));
  WholeRaster low = small_raster();
  low.bands = {raster_with_bounds().bands[1]};
  write_whole<GeotiffWriter>(low, folder.file("svf_low.tif"));
  // Stored as it is, so that its bytes stand in the ZIP file
  EXPECT_THAT(zip, HasSubstr(scenes::text_of(folder.file("svf_low.tif"))));
}

TEST(ZippedGeotiffs, HaveTheSameBytesEachTime) {
  const scenes::TemporaryFolder folder;
  write_whole<ZippedGeotiffWriter>(raster_with_bounds(), folder.file("a.zip"));
  write_whole<ZippedGeotiffWriter>(raster_with_bounds(), folder.file("b.zip"));
  EXPECT_EQ(scenes::text_of(folder.file("a.zip")), scenes::text_of(folder.file("b.zip")));
}

TEST(ZippedGeotiffs, LeaveNothingOfAFileThatIsGivenUp) {
  const scenes::TemporaryFolder folder;
  {
    ZippedGeotiffWriter writer(raster_with_bounds(), folder.file("a.zip"));
    writer.write(tile_of(raster_with_bounds(), {0, 0}));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace farlod
