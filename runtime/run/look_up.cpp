// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "evaluate/sky_parts.hpp"
#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "receivers/point_receivers.hpp"
#include "run/package_contents.hpp"
#include "run/resolved_settings.hpp"

namespace farlod {
namespace {

HemisphereDirections directions_of(const package::Manifest& manifest) {
  HemisphereDirections directions;
  for (std::size_t n = 0; n < hemisphere_azimuths; ++n) {
    const double turn = (static_cast<double>(n) + 0.5) / static_cast<double>(hemisphere_azimuths);
    // true azimuth = grid azimuth + convergence
    const Angle azimuth = Angle::radians(2.0 * std::numbers::pi * turn) - manifest.convergence;
    directions.azimuths.push_back(manifest.grid.rotation.grid_from_city(Point3d{sin(azimuth), cos(azimuth), 0.0}));
  }
  for (std::size_t e = 0; e < hemisphere_elevations; ++e) {
    const double share = (static_cast<double>(e) + 0.5) / static_cast<double>(hemisphere_elevations);
    directions.slopes.push_back(static_cast<float>(std::tan(0.5 * std::numbers::pi * share)));
  }
  return directions;
}

}  // namespace

std::optional<Hemisphere> look_up(const Package& package, Point2d place_m, std::optional<double> height_m, const Placing& placing,
                                  const EvaluationSettings& evaluation, const RunSettings& run) {
  const double z_m = height_m.value_or(std::numeric_limits<double>::quiet_NaN());
  const PointAnswers answer = evaluate_points(package, {{&place_m.x, 1}, {&place_m.y, 1}, {&z_m, 1}}, placing, evaluation, run);
  if (std::isnan(answer.svf.front())) return std::nullopt;
  const PackageInUse in_use(package);
  const PackageReader& reader = in_use.reader();
  const Placing placed = resolved(placing);
  const PlaceOfReceiver place{place_m, height_m};
  const std::size_t chosen = 0;
  const Cell cell = places_by_cell(reader, {&place, 1}).front().first;
  const CellReceivers receivers =
      receivers_at(reader, cell, {&place, 1}, {&chosen, 1}, placed.above, package_height_m(placed, reader.manifest()), run.stop);
  const SkyEvaluator evaluator(reader, resolved(evaluation, run).sky, run.stop);
  SkyParts seen = evaluator.parts_of_sky(receivers, directions_of(reader.manifest()));
  return Hemisphere{hemisphere_azimuths,     hemisphere_elevations, std::move(seen.parts), std::move(seen.horizon),
                    answer.height_m.front(), answer.svf.front(),    answer.summary,        answer.further};
}

}  // namespace farlod
