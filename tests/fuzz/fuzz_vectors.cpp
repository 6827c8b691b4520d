// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/expects.hpp"
#include "farlod/region.hpp"
#include "inputs/vector_reader_gdal.hpp"
#include "inputs/zone_reader_gdal.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace farlod {
namespace {

constexpr const char* package_crs = "EPSG:32632";

void expect_places(const RequestedPoints& read) {
  for (const RequestedPoint& p : read.points) FARLOD_EXPECTS(std::isfinite(p.x) && std::isfinite(p.y));
}

}  // namespace
}  // namespace farlod

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  // What is no JSON goes to GDAL's other readers, which are not ours to fuzz
  if (size == 0 || data[0] != '{') return 0;
  static const ScratchFolder folder;
  const std::filesystem::path file = folder.write({data, size}, "places.geojson");
  expect_answer_or_refusal([&] { expect_places(read_points_gdal(file, "")); });
  expect_answer_or_refusal([&] { expect_places(read_lines_gdal(file, "", {1000.0, "", package_crs})); });
  expect_answer_or_refusal([&] { (void)read_region_gdal(file, package_crs); });
  expect_answer_or_refusal([&] { (void)read_zones_gdal(file, "", package_crs); });
  return 0;
}
