// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/picture/histogram.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/expects.hpp"
#include "results/picture/picture.hpp"
#include "results/picture/value_scale.hpp"

namespace farlod {
namespace {

// The blue and the orange of Okabe and Ito, of which the first is darker also in a print in grey
constexpr std::array<Colour, 2> series_colours{{{0, 114, 178}, {230, 159, 0}}};
constexpr Colour grid_line_colour{216, 220, 224};
constexpr double plot_left = 96.0, plot_width = 750.0, plot_top = 170.0, plot_height = 340.0;
constexpr PixelSize histogram_size{900, 680};
constexpr double first_strip = 106.0, step_of_strips = 28.0, half_stroke = 8.0;
constexpr double bottom = plot_top + plot_height;
constexpr double share_of_bin = 0.86;  // that bars take, so that bins are told apart

void add_text(Drawing& drawing, PagePoint place, const std::string& words, Alignment alignment, Colour colour = ink) {
  drawing.shapes.emplace_back(Text{place, words, text_height, alignment, colour});
}

void add_axis_of_values(Drawing& drawing, const std::string& quantity, const ValueScale& scale) {
  constexpr int most_steps = 10;
  constexpr double rounding = 1e-9;
  drawing.shapes.emplace_back(Line{{{plot_left, bottom}, {plot_left + plot_width, bottom}}, 1.5, ink});
  const double step = tick_step(scale.end, most_steps);
  for (int n = 0; n * step <= scale.end * (1.0 + rounding); ++n) {
    const double x = histogram_point(n * step / scale.end, 0.0, 1.0).x;
    drawing.shapes.emplace_back(Line{{{x, bottom}, {x, bottom + 6.0}}, 1.5, ink});
    add_text(drawing, {x, bottom + 24.0}, tick_text(n * step, step), Alignment::centre);
  }
  const std::string unit = scale.unit.empty() ? "" : ", " + scale.unit;
  add_text(drawing, {plot_left + 0.5 * plot_width, bottom + 48.0}, quantity + unit, Alignment::centre);
}

constexpr int most_steps_of_shares = 5;

void add_axis_of_shares(Drawing& drawing, double highest) {
  const double step = tick_step(highest, most_steps_of_shares);
  for (int n = 0; n <= std::lround(highest / step); ++n) {
    const double share = step * n, y = histogram_point(0.0, share, highest).y;
    if (n > 0) drawing.shapes.emplace_back(Line{{{plot_left, y}, {plot_left + plot_width, y}}, 0.8, grid_line_colour});
    add_text(drawing, {plot_left - 10.0, y + half_digit_height * text_height}, tick_text(100.0 * share, 100.0 * step) + " %",
             Alignment::right);
  }
}

void add_bars(Drawing& drawing, std::span<const HistogramSeries> series, double end, double highest) {
  const double width = share_of_bin * plot_width / histogram_bins / static_cast<double>(series.size());
  for (std::size_t s = 0; s < series.size(); ++s) {
    const std::vector<double> shares = series[s].counts.shares(histogram_bins, end);
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
      if (shares[bin] == 0.0) continue;
      const double middle = (static_cast<double>(bin) + 0.5) / histogram_bins;
      PagePoint corner = histogram_point(middle, shares[bin], highest);
      corner.x += (static_cast<double>(s) - 0.5 * static_cast<double>(series.size())) * width;
      drawing.shapes.emplace_back(box(corner, width, bottom - corner.y, colour_of_series(s)));
    }
  }
}

/// A line between the quartiles, a stroke at the median, a dot at the mean.
void add_strip(Drawing& drawing, const HistogramSeries& series, double end, double y, Colour colour) {
  const auto x_at = [&](std::optional<double> value) { return histogram_point(std::min(*value / end, 1.0), 0.0, 1.0).x; };
  const double low = x_at(series.counts.quantile(0.25)), high = x_at(series.counts.quantile(0.75)),
               median = x_at(series.counts.quantile(0.5)), mean = x_at(series.counts.mean());
  drawing.shapes.emplace_back(Line{{{plot_left, y}, {plot_left + plot_width, y}}, 0.8, grid_line_colour});
  drawing.shapes.emplace_back(box({low, y - 4.0}, std::max(high - low, 1.0), 8.0, colour));
  drawing.shapes.emplace_back(Line{{{median, y - half_stroke}, {median, y + half_stroke}}, 2.5, ink});
  drawing.shapes.emplace_back(disc({mean, y}, 6.0, ink));
  drawing.shapes.emplace_back(disc({mean, y}, 4.0, {255, 255, 255}));
}

/// Three digits of a share, and as many of other values.
int decimals_up_to(double end) { return end > 200.0 ? 0 : end > 20.0 ? 1 : end > 2.0 ? 2 : 3; }

/// "roofs, 5678 m²: mean 0.912, quartiles 0.871, 0.943, 0.991".
std::string figures_of(const HistogramSeries& series, double end) {
  const std::string head = series.name + ", " + series.size;
  if (!series.counts.mean()) return head + ": no values";
  const int decimals = decimals_up_to(end);
  const auto text = [&](std::optional<double> value) { return fmt::format("{:.{}f}", *value, decimals); };
  return head + ": mean " + text(series.counts.mean()) + ", quartiles " + text(series.counts.quantile(0.25)) + ", " +
         text(series.counts.quantile(0.5)) + ", " + text(series.counts.quantile(0.75));
}

void add_legend(Drawing& drawing, std::span<const HistogramSeries> series, double end) {
  double y = bottom + 84.0;
  for (std::size_t s = 0; s < series.size(); ++s, y += 24.0) {
    drawing.shapes.emplace_back(box({plot_left, y - 12.0}, 16.0, 14.0, colour_of_series(s)));
    add_text(drawing, {plot_left + 26.0, y}, figures_of(series[s], end), Alignment::left);
  }
  drawing.shapes.emplace_back(Line{{{plot_left + 8.0, y - 13.0}, {plot_left + 8.0, y + 3.0}}, 2.5, ink});
  add_text(drawing, {plot_left + 26.0, y}, "median", Alignment::left, muted);
  drawing.shapes.emplace_back(disc({plot_left + 108.0, y - 5.0}, 6.0, ink));
  drawing.shapes.emplace_back(disc({plot_left + 108.0, y - 5.0}, 4.0, {255, 255, 255}));
  add_text(drawing, {plot_left + 122.0, y}, "mean", Alignment::left, muted);
  drawing.shapes.emplace_back(box({plot_left + 186.0, y - 9.0}, 24.0, 8.0, muted));
  add_text(drawing, {plot_left + 220.0, y}, "lower to upper quartile", Alignment::left, muted);
}

}  // namespace

// Halves of a range that begins this small are as fine as the page, whatever the unit
ValueCounts::ValueCounts(CountedRange range)
    : range_(range), end_(range == CountedRange::shares ? 1.0 : 1.0 / 1024.0), weights_(fine_bins) {}

void ValueCounts::double_range() {
  for (std::size_t bin = 0; bin < fine_bins / 2; ++bin) weights_[bin] = weights_[2 * bin] + weights_[2 * bin + 1];
  std::fill(weights_.begin() + fine_bins / 2, weights_.end(), 0.0);
  end_ *= 2.0;
}

void ValueCounts::add(double value, double weight) {
  if (std::isnan(value)) return;
  while (range_ == CountedRange::from_zero && std::isfinite(value) && value > end_) double_range();
  const double inside = std::clamp(value, 0.0, end_);
  largest_ = std::max(largest_, inside);
  const auto bin = static_cast<std::size_t>(inside / end_ * static_cast<double>(fine_bins));
  weights_[std::min(bin, fine_bins - 1)] += weight;
  weighted_ += weight * inside;
  weight_ += weight;
  ++count_;
}

std::optional<double> ValueCounts::mean() const { return weight_ > 0.0 ? std::optional(weighted_ / weight_) : std::nullopt; }

std::optional<double> ValueCounts::quantile(double share) const {
  if (!(weight_ > 0.0)) return std::nullopt;
  double below = 0.0;
  std::size_t last = 0;
  for (std::size_t bin = 0; bin < fine_bins; ++bin) {
    if (weights_[bin] > 0.0) last = bin;
    below += weights_[bin];
    if (weights_[bin] > 0.0 && below >= share * weight_) break;
  }
  return (static_cast<double>(last) + 0.5) / static_cast<double>(fine_bins) * end_;
}

std::vector<double> ValueCounts::shares(std::size_t bins, double end) const {
  FARLOD_EXPECTS(bins > 0 && fine_bins % bins == 0);
  std::vector<double> shares(bins);
  if (!(weight_ > 0.0)) return shares;
  // By its middle, a fine bin that two of the bins share belongs to one of them
  const double bins_per_fine = end_ / end * static_cast<double>(bins) / static_cast<double>(fine_bins);
  for (std::size_t bin = 0; bin < fine_bins; ++bin) {
    const auto at = static_cast<std::size_t>((static_cast<double>(bin) + 0.5) * bins_per_fine);
    shares[std::min(at, bins - 1)] += weights_[bin] / weight_;
  }
  return shares;
}

PagePoint histogram_point(double value, double share, double highest) {
  return {plot_left + value * plot_width, bottom - share / highest * plot_height};
}

double highest_share(std::span<const HistogramSeries> series, double end) {
  double largest = 0.0;
  for (const HistogramSeries& s : series) {
    const std::vector<double> shares = s.counts.shares(histogram_bins, end);
    largest = std::max(largest, *std::ranges::max_element(shares));
  }
  if (!(largest > 0.0)) return 1.0;
  // Where all values are in one bin, the sum of shares may miss 1 by its rounding
  constexpr double rounding = 1e-9;
  const double step = tick_step(largest, most_steps_of_shares);
  return std::min(step * std::ceil(largest / step - rounding), 1.0);
}

Colour colour_of_series(std::size_t n) {
  FARLOD_EXPECTS(n < series_colours.size());
  return series_colours[n];
}

Drawing draw_histogram(std::span<const HistogramSeries> series, const HistogramCaption& caption) {
  FARLOD_EXPECTS(!series.empty() && series.size() <= series_colours.size());
  Drawing drawing{histogram_size, "Distribution of " + caption.quantity};
  drawing.shapes.emplace_back(Text{{24.0, 46.0}, drawing.title, title_height, Alignment::left, ink});
  double largest = 0.0;
  for (const HistogramSeries& s : series) largest = std::max(largest, s.counts.largest());
  const ValueScale scale = scale_of({caption.quantity, caption.unit, ""}, largest);
  const std::string bin = fmt::format("{:g} {}", scale.end / histogram_bins, scale.unit);
  add_text(drawing, {24.0, 74.0}, caption.shares + " in bins of " + bin, Alignment::left, muted);
  const double highest = highest_share(series, scale.end);
  add_axis_of_shares(drawing, highest);
  add_bars(drawing, series, scale.end, highest);
  add_axis_of_values(drawing, caption.quantity, scale);
  for (std::size_t s = 0; s < series.size(); ++s)
    if (series[s].counts.mean())
      add_strip(drawing, series[s], scale.end, first_strip + static_cast<double>(s) * step_of_strips, colour_of_series(s));
  add_legend(drawing, series, scale.end);
  return drawing;
}

}  // namespace farlod
