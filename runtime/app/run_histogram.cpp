// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/run_histogram.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/picture_options.hpp"
#include "app/written_run.hpp"
#include "results/picture/histogram.hpp"
#include "results/raster/raster_writer.hpp"

namespace farlod {
namespace {

HistogramSeries series_by_area(const char* name, const ValueCounts& counts) {
  return {name, fmt::format("{:.0f} m²", counts.weight()), counts};
}

/// The value of a receiver that is drawn, NaN where there is none.
double value_of(const SurfacePoint& p, std::size_t drawn) {
  if (!p.svf) return std::nan("");
  return drawn == 0 ? *p.svf : static_cast<double>(p.further[drawn - 1]);
}

}  // namespace

RunHistogram::RunHistogram(const SvfOptions& options) : is_wanted_(!options.histogram_file.empty()) {
  std::vector<ColumnDescription> columns = svf_bands(quantity_name(options.evaluation.weight), RasterBands::svf);
  for (ColumnDescription& column : column_descriptions_of(options.evaluation.further)) columns.push_back(std::move(column));
  drawn_ = drawn_band_of(options, columns);
  column_ = columns[drawn_];
  values_ = roofs_ = walls_ = ValueCounts(column_.unit == "1" ? CountedRange::shares : CountedRange::from_zero);
}

void RunHistogram::add(const PointAnswers& points) {
  if (!is_wanted_ || points.svf.empty()) return;
  if (drawn_ == 0) return add(points.svf);
  const std::size_t columns = points.further.size() / points.svf.size();
  for (std::size_t n = 0; n < points.svf.size(); ++n) values_.add(points.further[n * columns + drawn_ - 1]);
}

void RunHistogram::add(std::span<const float> values) {
  if (!is_wanted_) return;
  for (const float value : values) values_.add(value);
}

void RunHistogram::add(std::span<const SurfacePoint> points) {
  if (!is_wanted_) return;
  for (const SurfacePoint& p : points) (p.kind == SurfaceKind::roof ? roofs_ : walls_).add(value_of(p, drawn_), p.area_m2);
}

void RunHistogram::write(const SvfOptions& options) const {
  if (!is_wanted_) return;
  std::vector<HistogramSeries> series;
  HistogramCaption caption{column_.name, "Share of the area", column_.unit};
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
