// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/city_sizes.hpp"

#include <algorithm>

#include "benchmark/measurement.hpp"

namespace farlod::benchmark {
namespace {

void open_all(const std::filesystem::path& folder) {
  const PackageReader package(folder);
  const CellRange& cells = package.grid().cells;
  for (std::size_t n = 0; n < static_cast<std::size_t>(cells.size()); ++n) static_cast<void>(package.tile(cells.cell_at(n)));
}

SizeRow study_size(const SizedCity& sized, const OurEngine& ours, Accuracy accuracy, const Extent& extent) {
  const City city(sized.package);
  const PackageReader& package = city.package;
  tell("a city of " + std::to_string(package.manifest().polygons) + " polygons");
  const std::vector<Cell> cells = spread_cells(package.grid(), extent.cells);
  const CityReceivers receivers = place_receivers(package, cells, Place::ground, extent.spacing_m(Place::ground));
  const std::vector<SharedPacket> packets = packets_of(package.grid(), receivers);
  SizeRow row;
  row.polygons = package.manifest().polygons;
  row.triangles = city.triangles.triangles.size();
  row.index_bytes = city.rival.index_bytes();
  row.receivers = receivers.count;
  row.all_receivers =
      static_cast<double>(receivers.count) * static_cast<double>(package.grid().cells.size()) / static_cast<double>(cells.size());
  row.pack_s = sized.pack_s;
  row.open_s = median_seconds(extent.turns, [&] { open_all(sized.package); });
  row.build_s = median_seconds(extent.turns, [&] { static_cast<void>(WholeCityRival(city.triangles)); });
  std::vector<float> svf(receivers.count);
  const std::vector<Point3d> directions = fibonacci_directions(accuracy.rival_rays);
  const Duel result = duel(
      extent.turns, [&] { evaluate(package, ours.settings(accuracy.our_samples), receivers, svf); },
      [&] { city.rival.evaluate(packets, directions, svf); });
  row.ours_s = result.first_s;
  row.rival_s = result.second_s;
  row.ratio = result.ratio;
  return row;
}

}  // namespace

std::optional<double> SizeRow::break_even() const {
  const double gained_s_each = rival_s_each() - ours_s_each();
  if (gained_s_each <= 0.0) return std::nullopt;
  return std::max(0.0, (pack_s + open_s - build_s) / gained_s_each);
}

std::vector<SizeRow> study_sizes(std::span<const SizedCity> cities, const OurEngine& ours, Accuracy accuracy,
                                 const Extent& extent) {
  std::vector<SizeRow> rows;
  for (const SizedCity& city : cities) rows.push_back(study_size(city, ours, accuracy, extent));
  return rows;
}

}  // namespace farlod::benchmark
