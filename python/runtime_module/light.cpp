// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/light.hpp"

#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/weather.hpp"
#include "python/binding/owned_array.hpp"
#include "python/binding/word.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

using LightColumn = std::vector<double>;
constexpr double unknown_lux = std::numeric_limits<double>::quiet_NaN();

/// Intervals of light as Python has them: an array for each of their members, and, one interval after the other, an array for
/// each member of their positions of the sun, of which an interval has `sun_count`.
struct LightColumns {
  const LightColumn &direct_normal_w_m2, &diffuse_w_m2, &direct_normal_lux, &diffuse_lux;  ///< lx are NaN where nobody knows them
  const LightColumn &hours, &extraterrestrial_w_m2, &month;
  const LightColumn& begin_s;  ///< on the clock of the period, since 1970
  const LightColumn& sun_count;
  const LightColumn &sun_azimuth_deg, &sun_elevation_deg, &sun_hours;
};

void require_one_length(const LightColumns& of) {
  double suns = 0.0;
  for (const double count : of.sun_count) {
    if (!(count >= 0.0) || count != std::floor(count))
      throw InvalidArgument("a number of positions of the sun is no whole number");
    suns += count;
  }
  for (const LightColumn* column : {&of.direct_normal_w_m2, &of.diffuse_w_m2, &of.direct_normal_lux, &of.diffuse_lux,
                                    &of.extraterrestrial_w_m2, &of.month, &of.begin_s, &of.sun_count})
    if (column->size() != of.hours.size())
      throw InvalidArgument("the columns of light are not of one length: give one number of each for each interval");
  for (const LightColumn* column : {&of.sun_azimuth_deg, &of.sun_elevation_deg, &of.sun_hours})
    if (static_cast<double>(column->size()) != suns)
      throw InvalidArgument("the positions of the sun are not as many as the intervals say");
}

std::optional<double> if_known(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

/// Within some thousand years.
std::chrono::local_seconds begin_of(double seconds) {
  constexpr double farthest_s = 1e11;
  if (!(std::abs(seconds) < farthest_s)) throw InvalidArgument("an interval begins at no time: give datetime64 for each");
  return std::chrono::local_seconds(std::chrono::seconds(std::llround(seconds)));
}

std::vector<LightInterval> light_intervals(const LightColumns& of) {
  require_one_length(of);
  std::vector<LightInterval> intervals(of.hours.size());
  std::size_t sun = 0;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    if (!(1.0 <= of.month[k] && of.month[k] <= 12.0))
      throw InvalidArgument("a month is " + std::to_string(of.month[k]) + ": give a number from 1 to 12");
    for (const std::size_t end = sun + static_cast<std::size_t>(of.sun_count[k]); sun < end; ++sun)
      intervals[k].sun.push_back(
          {Angle::degrees(of.sun_azimuth_deg[sun]), Angle::degrees(of.sun_elevation_deg[sun]), of.sun_hours[sun]});
    intervals[k].hours = of.hours[k];
    intervals[k].direct_normal_w_m2 = of.direct_normal_w_m2[k];
    intervals[k].diffuse_w_m2 = of.diffuse_w_m2[k];
    intervals[k].direct_normal_lux = if_known(of.direct_normal_lux[k]);
    intervals[k].diffuse_lux = if_known(of.diffuse_lux[k]);
    intervals[k].extraterrestrial_w_m2 = of.extraterrestrial_w_m2[k];
    intervals[k].month = static_cast<unsigned>(of.month[k]);
    intervals[k].begin = begin_of(of.begin_s[k]);
  }
  return intervals;
}

void set_light(Quantities& quantities, const LightColumn& direct_normal_w_m2, const LightColumn& diffuse_w_m2,
               const LightColumn& direct_normal_lux, const LightColumn& diffuse_lux, const LightColumn& hours,
               const LightColumn& extraterrestrial_w_m2, const LightColumn& month, const LightColumn& begin_s,
               const LightColumn& sun_count, const LightColumn& sun_azimuth_deg, const LightColumn& sun_elevation_deg,
               const LightColumn& sun_hours, const std::string& sky_model, double ground_albedo, double facade_albedo,
               bool by_month, bool by_step) {
  quantities.light =
      Light{light_intervals({direct_normal_w_m2, diffuse_w_m2, direct_normal_lux, diffuse_lux, hours, extraterrestrial_w_m2,
                             month, begin_s, sun_count, sun_azimuth_deg, sun_elevation_deg, sun_hours}),
            meaning_of("sky_model", sky_model, sky_model_words),
            ground_albedo,
            facade_albedo,
            by_month,
            by_step};
}

double global_horizontal(const LightColumn& direct_normal_w_m2, const LightColumn& diffuse_w_m2,
                         const LightColumn& direct_normal_lux, const LightColumn& diffuse_lux, const LightColumn& hours,
                         const LightColumn& extraterrestrial_w_m2, const LightColumn& month, const LightColumn& begin_s,
                         const LightColumn& sun_count, const LightColumn& sun_azimuth_deg, const LightColumn& sun_elevation_deg,
                         const LightColumn& sun_hours) {
  return global_horizontal_kwh_m2(
      light_intervals({direct_normal_w_m2, diffuse_w_m2, direct_normal_lux, diffuse_lux, hours, extraterrestrial_w_m2, month,
                       begin_s, sun_count, sun_azimuth_deg, sun_elevation_deg, sun_hours}));
}

/// A value of each of some rows.
template <class Row, class Value>
py::array_t<double> numbers_of(std::span<const Row> rows, const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(static_cast<double>(value(row)));
  return owned_array(std::move(values));
}

py::dict columns_of_intervals(std::span<const LightInterval> intervals) {
  using Row = LightInterval;
  return py::dict(
      "direct_normal"_a = numbers_of(intervals, [](const Row& i) { return i.direct_normal_w_m2; }),
      "diffuse"_a = numbers_of(intervals, [](const Row& i) { return i.diffuse_w_m2; }),
      "direct_normal_lux"_a = numbers_of(intervals, [](const Row& i) { return i.direct_normal_lux.value_or(unknown_lux); }),
      "diffuse_lux"_a = numbers_of(intervals, [](const Row& i) { return i.diffuse_lux.value_or(unknown_lux); }),
      "hours"_a = numbers_of(intervals, [](const Row& i) { return i.hours; }),
      "extraterrestrial"_a = numbers_of(intervals, [](const Row& i) { return i.extraterrestrial_w_m2; }),
      "month"_a = numbers_of(intervals, [](const Row& i) { return i.month; }),
      "begin"_a = numbers_of(intervals, [](const Row& i) { return i.begin.time_since_epoch().count(); }));
}

py::dict columns_of_suns(std::span<const SunPosition> suns) {
  using Row = SunPosition;
  return py::dict("azimuth"_a = numbers_of(suns, [](const Row& s) { return s.azimuth.degrees(); }),
                  "elevation"_a = numbers_of(suns, [](const Row& s) { return s.elevation.degrees(); }),
                  "hours"_a = numbers_of(suns, [](const Row& s) { return s.hours; }));
}

py::dict light_in_python(const std::string& weather_file, const std::string& period, std::int64_t step_minutes,
                         double linke_turbidity, double longitude_deg, double latitude_deg) {
  PeriodLight light;
  {
    const py::gil_scoped_release others_run;
    light = light_of_period({weather_file, period, std::chrono::minutes(step_minutes), linke_turbidity},
                            {Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)});
  }
  std::vector<SunPosition> suns;
  for (const LightInterval& interval : light.intervals) suns.insert(suns.end(), interval.sun.begin(), interval.sun.end());
  const std::span<const LightInterval> intervals(light.intervals);
  return py::dict("intervals"_a = columns_of_intervals(intervals),
                  "sun_count"_a = numbers_of(intervals, [](const LightInterval& i) { return i.sun.size(); }),
                  "suns"_a = columns_of_suns(suns), "hours"_a = light.hours, "source"_a = light.source,
                  "remarks"_a = light.remarks);
}

}  // namespace

void add_light_of(py::class_<Quantities>& quantities) {
  quantities.def("set_light", &set_light, py::arg("direct_normal_w_m2"), py::arg("diffuse_w_m2"), py::arg("direct_normal_lux"),
                 py::arg("diffuse_lux"), py::arg("hours"), py::arg("extraterrestrial_w_m2"), py::arg("month"), py::arg("begin_s"),
                 py::arg("sun_count"), py::arg("sun_azimuth_deg"), py::arg("sun_elevation_deg"), py::arg("sun_hours"),
                 py::arg("sky_model"), py::arg("ground_albedo"), py::arg("facade_albedo"), py::arg("by_month"),
                 py::arg("by_step"));
}

void add_weather(py::module_& module) {
  module.def("light_of_period", &light_in_python, py::arg("weather_file"), py::arg("period"), py::arg("step_minutes"),
             py::arg("linke_turbidity"), py::arg("longitude_deg"), py::arg("latitude_deg"));
  module.def("global_horizontal_kwh_m2", &global_horizontal, py::arg("direct_normal_w_m2"), py::arg("diffuse_w_m2"),
             py::arg("direct_normal_lux"), py::arg("diffuse_lux"), py::arg("hours"), py::arg("extraterrestrial_w_m2"),
             py::arg("month"), py::arg("begin_s"), py::arg("sun_count"), py::arg("sun_azimuth_deg"), py::arg("sun_elevation_deg"),
             py::arg("sun_hours"));
}

}  // namespace farlod
