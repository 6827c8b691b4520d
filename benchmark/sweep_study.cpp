// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/sweep_study.hpp"

#include <array>

#include "benchmark/line_sweep.hpp"
#include "benchmark/measurement.hpp"

namespace farlod::benchmark {
namespace {

constexpr std::array<std::size_t, 2> azimuth_counts{64, 128};
constexpr float eye_height_m = 1.5F;

/// The pixels on whose centres receivers stand: both come from the same plan.
std::vector<std::size_t> pixels_of(const PackageReader& package, const RasterPlan& plan, const CityReceivers& receivers) {
  std::vector<std::size_t> pixels;
  for (const CellReceivers& cell : receivers.cells)
    for (const Receiver& r : cell.receivers) {
      const Point2d corner = package.grid().corner_of(cell.cell);
      const Point3d p = package.manifest().projected_from_grid({corner.x + r.p_cell.x, corner.y + r.p_cell.y, 0.0});
      const auto column = static_cast<std::size_t>((p.x - plan.north_west_m.x) / plan.step_m);
      const auto row = static_cast<std::size_t>((plan.north_west_m.y - p.y) / plan.step_m);
      pixels.push_back(row * plan.columns + column);
    }
  return pixels;
}

/// Receivers whose pixel is a building's in the raster, by a hair, have no answer: they are left out.
SweepRow compare(std::size_t azimuths, const std::vector<float>& svf, const std::vector<std::size_t>& pixels,
                 const std::vector<float>& truth) {
  std::vector<float> answers, answered_truth;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    if (svf[pixels[n]] == 0.0F) continue;
    answers.push_back(svf[pixels[n]]);
    answered_truth.push_back(truth[n]);
  }
  return {azimuths, errors_of(answers, answered_truth), 0.0};
}

}  // namespace

SweepStudy study_sweep(const City& city, const Extent& extent) {
  const SampledField field = prepare_field(city, Place::ground, extent);
  SweepStudy study;
  HeightRaster raster;
  study.raster_s = median_seconds(extent.turns, [&] { raster = rasterise(city.package, extent.spacing_m(Place::ground)); });
  const LineSweep sweep(raster, eye_height_m);
  study.pixel_m = extent.spacing_m(Place::ground);
  study.pixels = raster.surface_m.size();
  study.receivers = sweep.receiver_count();
  study.compared = field.truth.size();
  const std::vector<std::size_t> pixels = pixels_of(city.package, raster.plan, field.sample.receivers);
  for (const std::size_t azimuths : azimuth_counts) {
    tell("line sweep: " + std::to_string(azimuths) + " azimuths");
    std::vector<float> svf;
    const double seconds = median_seconds(extent.turns, [&] { svf = sweep.sky_view_factors(azimuths); });
    study.rows.push_back(compare(azimuths, svf, pixels, field.truth));
    study.rows.back().seconds = seconds;
  }
  return study;
}

}  // namespace farlod::benchmark
