// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/run_histogram.hpp"

#include <fmt/core.h>

#include <string>

#include "app/written_run.hpp"
#include "results/picture/histogram.hpp"

namespace farlod {
namespace {

HistogramSeries series_by_area(const char* name, const ValueCounts& counts) {
  return {name, fmt::format("{:.0f} m²", counts.weight()), counts};
}

}  // namespace

void RunHistogram::add(std::span<const float> values) {
  if (!is_wanted_) return;
  for (const float value : values) values_.add(value);
}

void RunHistogram::add(std::span<const SurfacePoint> points) {
  if (!is_wanted_) return;
  for (const SurfacePoint& p : points)
    if (p.svf) (p.kind == SurfaceKind::roof ? roofs_ : walls_).add(*p.svf, p.area_m2);
}

void RunHistogram::write(const SvfOptions& options) const {
  if (!is_wanted_) return;
  std::vector<HistogramSeries> series;
  HistogramCaption caption{quantity_name(options.evaluation.weight), "Share of the area"};
  if (options.source != ReceiverSource::surfaces) {
    const bool is_raster = options.source == ReceiverSource::grid;
    series.push_back({is_raster ? "pixels" : "points", std::to_string(values_.count()), values_});
    caption.shares = is_raster ? "Share of the pixels with data" : "Share of the points with data";
  } else {
    if (options.surfaces.choice != SurfaceChoice::walls) series.push_back(series_by_area("roofs", roofs_));
    if (options.surfaces.choice != SurfaceChoice::roofs) series.push_back(series_by_area("walls", walls_));
  }
  write_drawing(draw_histogram(series, caption), options.histogram_file);
}

}  // namespace farlod
