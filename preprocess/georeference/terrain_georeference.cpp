// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "city/input_error.hpp"
#include "georeference/input_crs.hpp"
#include "georeference/output_crs.hpp"
#include "georeference/terrain_reader.hpp"

namespace farlod {

Georeference georeference_of_terrain(const std::filesystem::path& file, const GeoreferenceSettings& settings) {
  const TerrainExtent extent = read_terrain_extent(file);
  const Crs input = crs_of_input(file.string(), extent.crs_wkt, settings.crs).crs;
  const Point2d centre = 0.5 * (extent.box.low + extent.box.high);
  const Crs output = choose_output_crs(input, centre, settings.out_crs);
  const auto place = input.equals(output) ? centre : CrsTransformation(input, output, centre).apply(centre);
  if (!place) throw InputError(file.string() + ": its centre has no place in " + output.name() + ": check its CRS");
  return georeference_around(*place, output);
}

}  // namespace farlod
