// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/region_of_package.hpp"

#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {
namespace {

Region region_of(const Box2d& box) { return Region({{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}}); }

Region region_in(const std::filesystem::path& file, const PackageDescription& package) {
#ifdef FARLOD_WITH_GDAL
  return gdal_files().read_region(file, package.crs_wkt);
#else
  throw PointsError(file.string() + " needs GDAL, which this farlod-svf was built without: give --bbox in " + package.crs_name +
                    " instead of --mask.");
#endif
}

}  // namespace

std::shared_ptr<const Region> region_of_package(const SvfOptions& options, const PackageDescription& package) {
  if (!options.mask_file.empty()) return std::make_shared<const Region>(region_in(options.mask_file, package));
  if (options.source == ReceiverSource::grid || !options.bbox_projected) return nullptr;
  return std::make_shared<const Region>(region_of(*options.bbox_projected));
}

}  // namespace farlod
