// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/run_settings.hpp"
#include "farlod/morphology.hpp"
#include "run/cell_amounts.hpp"
#include "run/cell_crowns.hpp"
#include "run/cell_faces.hpp"
#include "run/cells_in_parallel.hpp"
#include "run/memory_limit.hpp"
#include "run/morphology_of_package.hpp"
#include "run/package_contents.hpp"
#include "run/zone_plan.hpp"
#include "run/zones_of_grid.hpp"

namespace farlod {
namespace {

/// What a cell has of a zone.
struct ZoneInCell {
  std::size_t zone = 0;
  CellForm form;
  std::optional<CellVegetation> vegetation;
};

std::vector<ZoneInCell> zones_in(const PackageReader& reader, Cell cell, const ZonesInCell& zones, const WindDirections& winds) {
  const CellFaces faces = faces_of(reader, cell);
  std::vector<ZoneInCell> result;
  for (const auto& [zone, trapezoids] : zones)
    result.push_back({zone, form_of(faces, winds, &trapezoids), vegetation_of(reader, cell, faces, &trapezoids)});
  return result;
}

void add_vegetation(const CellVegetation& from, CellVegetation& to) {
  to.plan_area_m2 += from.plan_area_m2;
  const std::size_t count = to.count + from.count;
  if (count > 0)
    to.height_mean_m = (to.height_mean_m * static_cast<double>(to.count) + from.height_mean_m * static_cast<double>(from.count)) /
                       static_cast<double>(count);
  to.count = count;
}

/// In the order of the cells, whatever the number of threads.
std::vector<UrbanForm> sums_of(const std::vector<std::vector<ZoneInCell>>& parts, const ZonesOfGrid& zones, std::size_t count,
                               bool has_crowns) {
  std::vector<CellForm> forms(count);
  std::vector<UrbanForm> result(count);
  if (has_crowns)
    for (UrbanForm& form : result) form.vegetation = CellVegetation{};
  for (const auto& of_cell : parts)
    for (const ZoneInCell& part : of_cell) {
      forms[part.zone].add(part.form);
      if (part.vegetation) add_vegetation(*part.vegetation, *result[part.zone].vegetation);
    }
  for (std::size_t n = 0; n < count; ++n) {
    result[n].amounts = forms[n].all();
    result[n].amounts.plan_area_m2 = zones.plan_area_m2(n);
  }
  return result;
}

}  // namespace

std::vector<UrbanForm> morphology_of_zones(const Package& package, const std::vector<Zone>& zones, const RunSettings& run) {
  require_usable(run);
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  require_buildings_cut_at_borders(reader.manifest());
  const ZonesOfGrid where(reader.manifest(), zones);
  require_memory(run, static_cast<double>(zones.size() * sizeof(UrbanForm) + bytes_of_blocks_at_work(reader.manifest())),
                 "describing zones", "give fewer of them at a time");
  const WindDirections winds = winds_of(reader.manifest());
  std::vector<std::vector<ZoneInCell>> parts(where.cells().size());
  for_each_cell(parts.size(), run, "cells", [&](std::size_t n) {
    const auto& [index, in_cell] = where.cells()[n];
    parts[n] = zones_in(reader, reader.grid().cells.cell_at(index), in_cell, winds);
  });
  return sums_of(parts, where, zones.size(), reader.has_crowns());
}

}  // namespace farlod
