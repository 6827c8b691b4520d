// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "validation/svg_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "evaluate/error_budget.hpp"
#include "validation/report.hpp"

namespace farlod::validation {
namespace {

// The plot's area within the picture, in pixels; the labels of the lines stand to its right
constexpr double left = 80, right = 560, top = 40, bottom = 380, width = 800, height = 440;
constexpr std::array colours{"#c0392b", "#e08e0b", "#1f77b4", "#2e7d32", "#6a1b9a", "#555555"};

bool shows(Scale scale, double value) { return scale == Scale::linear || value > 0.0; }

/// Between the values of an axis and the pixels of the picture.
class Range {
 public:
  Range(Scale scale, double first_px, double last_px) : scale_(scale), first_px_(first_px), last_px_(last_px) {}

  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  /// Widens the range to whole steps.
  void round() {
    if (scale_ == Scale::linear) {
      step_ = nice_step((high_ - std::min(low_, 0.0)) / 5.0);
      low_ = step_ * std::floor(low_ / step_);
      high_ = step_ * std::ceil(high_ / step_);
    } else {
      low_ = *std::prev(std::upper_bound(steps_.begin(), steps_.end(), low_ * 1.0001));
      high_ = *std::lower_bound(steps_.begin(), steps_.end(), high_ * 0.9999);
    }
  }
  [[nodiscard]] double pixel(double value) const {
    const auto place = [this](double v) { return scale_ == Scale::linear ? v : std::log10(v); };
    return first_px_ + (last_px_ - first_px_) * (place(value) - place(low_)) / (place(high_) - place(low_));
  }
  [[nodiscard]] std::vector<double> ticks() const {
    std::vector<double> ticks;
    if (scale_ == Scale::linear)
      for (double v = low_; v < high_ + 0.5 * step_; v += step_) ticks.push_back(std::abs(v) < 1e-9 * step_ ? 0.0 : v);
    else
      for (const double v : steps_)
        if (v >= low_ * 0.9999 && v <= high_ * 1.0001) ticks.push_back(v);
    return ticks;
  }

 private:
  static double nice_step(double wish) {
    const double power = std::pow(10.0, std::floor(std::log10(wish)));
    for (const double m : {1.0, 2.0, 5.0})
      if (m * power >= wish) return m * power;
    return 10.0 * power;
  }
  static std::vector<double> logarithmic_steps() {
    std::vector<double> steps;
    for (int power = -9; power <= 9; ++power)
      for (const double m : {1.0, 2.0, 5.0}) steps.push_back(m * std::pow(10.0, power));
    return steps;
  }

  Scale scale_;
  double first_px_, last_px_, step_ = 1.0;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  std::vector<double> steps_ = logarithmic_steps();
};

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// `<` and `&` would begin something else.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

void put_text(std::ostream& svg, double x, double y, const std::string& anchor, const std::string& text) {
  svg << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << escaped(text) << "</text>\n";
}

void put_line(std::ostream& svg, double x0, double y0, double x1, double y1, const std::string& style) {
  svg << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1 << "\" y2=\"" << y1 << "\" " << style << "/>\n";
}

void put_axes(std::ostream& svg, const Plot& plot, const Range& x, const Range& y) {
  for (const double v : x.ticks()) {
    put_line(svg, x.pixel(v), top, x.pixel(v), bottom, "stroke=\"#e4e4e4\"");
    put_text(svg, x.pixel(v), bottom + 18, "middle", number(v));
  }
  for (const double v : y.ticks()) {
    put_line(svg, left, y.pixel(v), right, y.pixel(v), "stroke=\"#e4e4e4\"");
    put_text(svg, left - 6, y.pixel(v) + 4, "end", number(v));
  }
  svg << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << right - left << "\" height=\"" << bottom - top
      << "\" fill=\"none\" stroke=\"#444444\"/>\n";
  put_text(svg, 0.5 * (left + right), bottom + 42, "middle", plot.x.title);
  const double middle = 0.5 * (top + bottom);
  svg << "<g transform=\"rotate(-90 18 " << middle << ")\">";
  put_text(svg, 18, middle, "middle", plot.y.title);
  svg << "</g>\n";
  put_text(svg, 0.5 * (left + right), top - 14, "middle", plot.title);
}

void put_series(std::ostream& svg, const Series& series, const Plot& plot, const Range& x, const Range& y, double label_y) {
  const std::string stroke = "stroke=\"" + std::string(colours.at(series.colour % colours.size())) + "\" stroke-width=\"2\"" +
                             (series.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
  std::ostringstream line, marks;
  for (const auto& [px, py] : series.points) {
    if (!shows(plot.x.scale, px) || !shows(plot.y.scale, py)) continue;
    line << x.pixel(px) << ',' << y.pixel(py) << ' ';
    marks << "<circle cx=\"" << x.pixel(px) << "\" cy=\"" << y.pixel(py) << "\" r=\"3\" fill=\"white\" " << stroke
          << " style=\"stroke-dasharray:none\"/>\n";
  }
  svg << "<polyline fill=\"none\" " << stroke << " points=\"" << line.str() << "\"/>\n" << marks.str();
  put_line(svg, right + 14, label_y, right + 44, label_y, stroke);
  put_text(svg, right + 50, label_y + 4, "start", series.label);
}

}  // namespace

void write_svg(const Plot& plot, const std::filesystem::path& file) {
  Range x(plot.x.scale, left, right), y(plot.y.scale, bottom, top);
  for (const Series& series : plot.series)
    for (const auto& [px, py] : series.points)
      if (shows(plot.x.scale, px) && shows(plot.y.scale, py)) {
        x.add(px);
        y.add(py);
      }
  x.round();
  y.round();
  std::ofstream svg(file);
  svg << std::fixed << std::setprecision(1) << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
      << height << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  put_axes(svg, plot, x, y);
  double label_y = top + 10;
  for (const Series& series : plot.series) {
    put_series(svg, series, plot, x, y, label_y);
    label_y += 22;
  }
  svg << "</svg>\n";
  if (!svg.flush()) throw std::runtime_error("cannot write " + file.string());
}

namespace {

constexpr std::size_t red = 0, orange = 1, blue = 2, green = 3, violet = 4, grey = 5;

using ErrorOf = double (*)(const ErrorSummary&);
double mean_of(const ErrorSummary& e) { return e.mean_abs_error; }
double max_of(const ErrorSummary& e) { return e.max_abs_error; }

/// Errors against the neighborhood, with cells of 50 m.
Plot far_field_plot(const CityStudy& study) {
  Plot plot{study.name + ": error of the far field, cells of 50 m",
            {"N (cells along the edge of the near field)", Scale::linear},
            {"|error| of the sky view factor", Scale::logarithmic},
            {}};
  const auto add = [&](const std::string& label, std::size_t colour, ErrorSummary FarFieldErrors::*which) {
    Series max{label + ", max", colour, false, {}}, mean{label + ", mean", colour, true, {}};
    for (const FarFieldRow& row : study.rows) {
      if (row.cell_edge_m != 50.0) continue;
      max.points.emplace_back(row.neighborhood, max_of(row.ground.*which));
      mean.points.emplace_back(row.neighborhood, mean_of(row.ground.*which));
    }
    plot.series.push_back(max);
    plot.series.push_back(mean);
  };
  add("dropped", red, &FarFieldErrors::dropped);
  add("paper's map", orange, &FarFieldErrors::box);
  add("ours", blue, &FarFieldErrors::horizon);
  return plot;
}

Plot sampling_plot(const CityResults& city) {
  Plot plot{city.far_field.name + ": error of the sampling",
            {"rays a receiver", Scale::logarithmic},
            {"|error| of the sky view factor", Scale::logarithmic},
            {}};
  const auto add = [&](const std::string& label, std::size_t colour, ErrorSummary SamplingRow::*which, ErrorOf error,
                       bool dashed) {
    Series series{label, colour, dashed, {}};
    for (const SamplingRow& row : city.sampling) series.points.emplace_back(static_cast<double>(row.rays), error(row.*which));
    plot.series.push_back(series);
  };
  add("ground, max", blue, &SamplingRow::ground, max_of, false);
  add("roofs, max", red, &SamplingRow::roofs, max_of, false);
  add("façades, max", green, &SamplingRow::facades, max_of, false);
  add("ground, mean", blue, &SamplingRow::ground, mean_of, true);
  add("roofs, mean", red, &SamplingRow::roofs, mean_of, true);
  add("façades, mean", green, &SamplingRow::facades, mean_of, true);
  Series law{"2.4 · rays^(−3/4)", grey, true, {}};
  for (const SamplingRow& row : city.sampling) {
    const auto rays = static_cast<double>(row.rays);
    law.points.emplace_back(rays, sampling_error_factor * std::pow(rays, -0.75));
  }
  plot.series.push_back(law);
  return plot;
}

Plot alignment_plot(const std::vector<CityResults>& cities) {
  Plot plot{"grid turned away from the streets, cells of 50 m, N = 3",
            {"turned by, degrees", Scale::linear},
            {"|error| of the sky view factor, mean", Scale::logarithmic},
            {}};
  std::size_t colour = red;
  for (const CityResults& city : cities) {
    Series papers{city.far_field.name + ", paper's map", colour, true, {}},
        ours{city.far_field.name + ", ours", colour, false, {}};
    for (const TurnedRow& row : city.alignment.turned) {
      papers.points.emplace_back(row.turn_deg, row.box.mean_abs_error);
      ours.points.emplace_back(row.turn_deg, row.horizon.mean_abs_error);
    }
    plot.series.push_back(papers);
    plot.series.push_back(ours);
    colour = colour == red ? blue : colour == blue ? green : violet;
  }
  return plot;
}

Plot bounds_plot(const std::vector<CityResults>& cities) {
  Plot plot{"width of certain intervals, cells of 50 m",
            {"N (cells along the edge of the near field)", Scale::linear},
            {"high − low", Scale::logarithmic},
            {}};
  std::size_t colour = red;
  for (const CityResults& city : cities) {
    Series max{city.far_field.name + ", max", colour, false, {}}, mean{city.far_field.name + ", mean", colour, true, {}};
    for (const FarFieldRow& row : city.far_field.rows) {
      if (row.cell_edge_m != 50.0) continue;
      max.points.emplace_back(row.neighborhood, row.ground.bounds.max_width);
      mean.points.emplace_back(row.neighborhood, row.ground.bounds.mean_width);
    }
    plot.series.push_back(max);
    plot.series.push_back(mean);
    colour = colour == red ? blue : colour == blue ? green : violet;
  }
  return plot;
}

}  // namespace

void write_plots(const Results& results, const std::filesystem::path& folder) {
  for (const CityResults& city : results.cities) {
    write_svg(far_field_plot(city.far_field), folder / ("far_field_" + city.far_field.name + ".svg"));
    write_svg(sampling_plot(city), folder / ("sampling_" + city.far_field.name + ".svg"));
  }
  write_svg(alignment_plot(results.cities), folder / "alignment.svg");
  write_svg(bounds_plot(results.cities), folder / "bounds.svg");
}

}  // namespace farlod::validation
