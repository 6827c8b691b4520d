// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/evaluation.hpp"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/hemisphere.hpp"
#include "farlod/points.hpp"
#include "farlod/raster.hpp"
#include "python/binding/interruptible_run.hpp"
#include "python/binding/owned_array.hpp"
#include "python/runtime_module/summary.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

/// One coordinate, or angle, of each point, without a copy where it lies in one piece.
using Column = py::array_t<double, py::array::c_style>;

std::span<const double> span_of(const Column& column) { return {column.data(), static_cast<std::size_t>(column.size())}; }

std::vector<Angle> angles_of(const std::optional<Column>& column_deg) {
  std::vector<Angle> angles;
  if (!column_deg) return angles;
  angles.reserve(static_cast<std::size_t>(column_deg->size()));
  for (const double degrees : span_of(*column_deg)) angles.push_back(Angle::degrees(degrees));
  return angles;
}

std::span<float> span_of(py::array_t<float>& array) { return {array.mutable_data(), static_cast<std::size_t>(array.size())}; }

py::ssize_t signed_size(std::size_t size) { return static_cast<py::ssize_t>(size); }

/// Arrays of points in Python are as long as each other, or the library says which is not.
struct PointColumns {
  Column x_m, y_m;
  std::optional<Column> z_m, azimuth_deg, tilt_deg;
};

py::dict evaluate_points_in_python(const Package& package, const PointColumns& columns, const Placing& placing,
                                   const EvaluationSettings& settings, const CallerSettings& caller) {
  const std::vector<Angle> azimuth = angles_of(columns.azimuth_deg), tilt = angles_of(columns.tilt_deg);
  const Points points{span_of(columns.x_m), span_of(columns.y_m), columns.z_m ? span_of(*columns.z_m) : std::span<const double>(),
                      azimuth, tilt};
  const py::ssize_t count = columns.x_m.size(), bounds = settings.bounds ? count : 0;
  const py::ssize_t further_columns = signed_size(columns_of(settings.further).size());
  py::array_t<float> svf(count), low(bounds), high(bounds), further({count, further_columns});
  py::array_t<double> height_m(count);
  const PointAnswerSpans answers{
      span_of(svf), span_of(low), span_of(high), {height_m.mutable_data(), static_cast<std::size_t>(count)}, span_of(further)};
  EvaluationSummary summary;
  run_interruptibly(caller,
                    [&](const RunSettings& run) { summary = evaluate_points(package, points, placing, settings, answers, run); });
  return py::dict("svf"_a = svf, "low"_a = low, "high"_a = high, "height_m"_a = height_m, "further"_a = further,
                  "summary"_a = summary_dict(summary));
}

/// The bands of a raster as arrays (row, column), and the figures of the run.
py::dict dict_of(Raster raster) {
  const std::vector<py::ssize_t> shape{signed_size(raster.plan.rows), signed_size(raster.plan.columns)};
  const auto band = [&](std::vector<float>& values) -> py::object {
    return values.empty() ? py::none() : py::object(owned_array(std::move(values), shape));
  };
  py::list further;
  for (std::vector<float>& values : raster.further) further.append(band(values));
  return py::dict("svf"_a = band(raster.svf), "low"_a = band(raster.low), "high"_a = band(raster.high), "further"_a = further,
                  "summary"_a = summary_dict(raster.summary));
}

py::dict evaluate_raster_in_python(const Package& package, const RasterPlan& plan, const Placing& placing,
                                   const EvaluationSettings& settings, const CallerSettings& caller) {
  Raster raster;
  run_interruptibly(caller, [&](const RunSettings& run) { raster = evaluate_raster(package, plan, placing, settings, run); });
  return dict_of(std::move(raster));
}

/// `window`: first column, first row, columns, rows.
py::dict evaluate_window_in_python(const Package& package, const RasterPlan& plan, const std::array<std::size_t, 4>& window,
                                   const Placing& placing, const EvaluationSettings& settings, const CallerSettings& caller) {
  const RasterWindow pixels{window[0], window[1], window[2], window[3]};
  Raster raster;
  run_interruptibly(caller,
                    [&](const RunSettings& run) { raster = evaluate_window(package, plan, pixels, placing, settings, run); });
  return dict_of(std::move(raster));
}

py::object look_up_in_python(const Package& package, std::pair<double, double> place_m, std::optional<double> height_m,
                             const Placing& placing, const EvaluationSettings& settings, const CallerSettings& caller) {
  std::optional<Hemisphere> sky;
  run_interruptibly(caller, [&](const RunSettings& run) {
    sky = look_up(package, {place_m.first, place_m.second}, height_m, placing, settings, run);
  });
  if (!sky) return py::none();
  std::vector<std::uint8_t> parts;
  parts.reserve(sky->parts.size());
  for (const SkyPart part : sky->parts) parts.push_back(static_cast<std::uint8_t>(part));
  return py::dict("svf"_a = sky->svf, "height_m"_a = sky->height_m,
                  "parts"_a = owned_array(std::move(parts), {signed_size(sky->azimuths), signed_size(sky->elevations)}),
                  "horizon_tangent"_a = owned_array(std::move(sky->horizon)));
}

RasterPlan planned_in_python(const Package& package, double step_m, const std::optional<std::array<double, 4>>& bbox_m) {
  if (!bbox_m) return plan_raster(package, step_m);
  const auto& [west, south, east, north] = *bbox_m;
  return plan_raster(package, step_m, Box2d{{west, south}, {east, north}});
}

std::optional<RasterPlan> plan_of_surface_model_in_python(const Package& package,
                                                          const std::optional<std::array<double, 4>>& bbox_m) {
  if (!bbox_m) return plan_of_surface_model(package);
  const auto& [west, south, east, north] = *bbox_m;
  return plan_of_surface_model(package, Box2d{{west, south}, {east, north}});
}

void add_raster(py::module_& module) {
  py::class_<RasterPlan>(module, "RasterPlan")
      .def(py::init([](std::pair<double, double> north_west_m, double step_m, std::size_t columns, std::size_t rows) {
             return RasterPlan{{north_west_m.first, north_west_m.second}, step_m, columns, rows};
           }),
           py::arg("north_west_m"), py::arg("step_m"), py::arg("columns"), py::arg("rows"))
      .def_property_readonly("north_west_m",
                             [](const RasterPlan& plan) { return std::pair(plan.north_west_m.x, plan.north_west_m.y); })
      .def_readonly("step_m", &RasterPlan::step_m)
      .def_readonly("columns", &RasterPlan::columns)
      .def_readonly("rows", &RasterPlan::rows);
  module.def("plan_raster", &planned_in_python, py::arg("package"), py::arg("step_m"), py::arg("bbox_m"));
  module.def("plan_of_surface_model", &plan_of_surface_model_in_python, py::arg("package"), py::arg("bbox_m"));
  module.def("evaluate_raster", &evaluate_raster_in_python, py::arg("package"), py::arg("plan"), py::arg("placing"),
             py::arg("settings"), py::arg("caller"));
  module.def("evaluate_window", &evaluate_window_in_python, py::arg("package"), py::arg("plan"), py::arg("window"),
             py::arg("placing"), py::arg("settings"), py::arg("caller"));
}

}  // namespace

void add_evaluation(py::module_& module) {
  py::class_<CallerSettings>(module, "CallerSettings", py::module_local())
      .def(py::init([](std::size_t threads, std::optional<std::uint64_t> memory_limit_mib, const py::object& progress) {
             return CallerSettings{threads, memory_limit_mib, progress};
           }),
           py::arg("threads"), py::arg("memory_limit_mib"), py::arg("progress"));
  py::class_<PointColumns>(module, "PointColumns")
      .def(py::init([](Column x_m, Column y_m, std::optional<Column> z_m, std::optional<Column> azimuth_deg,
                       std::optional<Column> tilt_deg) {
             return PointColumns{std::move(x_m), std::move(y_m), std::move(z_m), std::move(azimuth_deg), std::move(tilt_deg)};
           }),
           py::arg("x_m"), py::arg("y_m"), py::arg("z_m"), py::arg("azimuth_deg"), py::arg("tilt_deg"));
  module.def("evaluate_points", &evaluate_points_in_python, py::arg("package"), py::arg("points"), py::arg("placing"),
             py::arg("settings"), py::arg("caller"));
  add_raster(module);
  module.def("look_up", &look_up_in_python, py::arg("package"), py::arg("place_m"), py::arg("height_m"), py::arg("placing"),
             py::arg("settings"), py::arg("caller"));
}

}  // namespace farlod
