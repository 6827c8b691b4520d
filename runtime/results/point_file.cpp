// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/point_file.hpp"

#include "base/lower_case.hpp"
#include "inputs/point_reader.hpp"
#ifdef FARLOD_WITH_GDAL
#include "results/gdal_files.hpp"
#endif

namespace farlod {

bool is_point_table(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

RequestedPoints read_point_file(const std::filesystem::path& file, const std::string& layer, [[maybe_unused]] bool may_be_empty) {
#ifdef FARLOD_WITH_GDAL
  if (!is_point_table(file) && gdal_files().is_vector_file(file)) return gdal_files().read_points(file, layer, may_be_empty);
#else
  if (const std::string ending = lower_case(file.extension().string());
      ending == ".gpkg" || ending == ".geojson" || ending == ".shp" || ending == ".fgb")
    throw PointsError(file.string() + " needs GDAL, which this program was built without: give the points as CSV.");
#endif
  if (!layer.empty()) throw PointsError(file.string() + " is a table: it has no layers (--points-layer)");
  return read_points_csv(file);
}

}  // namespace farlod
