// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "python/binding/interruptible_run.hpp"
#include "python/binding/owned_array.hpp"
#include "python/binding/word.hpp"
#include "python/runtime_module/evaluation.hpp"
#include "python/runtime_module/summary.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

/// A column of a table: a value of each of its rows.
template <class T, class Row, class Value>
py::array_t<T> column(const std::vector<Row>& rows, const Value& value) {
  std::vector<T> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(static_cast<T>(value(row)));
  return owned_array(std::move(values));
}

template <class Row>
py::list buildings_of(const std::vector<Row>& rows) {
  py::list names;
  for (const Row& row : rows) names.append(row.building);
  return names;
}

std::vector<std::string> ids_of(const std::vector<SurfaceMean>& rows) {
  std::vector<std::string> ids;
  ids.reserve(rows.size());
  for (const SurfaceMean& row : rows) ids.push_back(row.id);
  return ids;
}

/// Values of further columns, row by row; NaN where a row has none.
template <class Row, class Values>
py::array_t<double> further_of(const std::vector<Row>& rows, std::size_t columns, const Values& values_of) {
  std::vector<double> table(rows.size() * columns, no_data);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const auto& values = values_of(rows[n]);
    std::copy(values.begin(), values.end(), table.begin() + static_cast<std::ptrdiff_t>(n * columns));
  }
  return owned_array(std::move(table), {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(columns)});
}

py::dict dict_of(const std::vector<SurfaceMean>& surfaces, std::size_t further_columns) {
  using Row = SurfaceMean;
  return py::dict(
      "building"_a = buildings_of(surfaces),
      "surface"_a = column<std::uint32_t>(surfaces, [](const Row& s) { return s.surface; }), "surface_id"_a = ids_of(surfaces),
      "kind"_a = column<std::uint8_t>(surfaces, [](const Row& s) { return s.kind; }),
      "azimuth_deg"_a = column<double>(surfaces, [](const Row& s) { return s.azimuth.degrees(); }),
      "tilt_deg"_a = column<double>(surfaces, [](const Row& s) { return s.tilt.degrees(); }),
      "area_m2"_a = column<double>(surfaces, [](const Row& s) { return s.area_m2; }),
      "covered_area_m2"_a = column<double>(surfaces, [](const Row& s) { return s.covered_area_m2; }),
      "receivers"_a = column<std::int64_t>(surfaces, [](const Row& s) { return s.receivers; }),
      "nodata"_a = column<std::int64_t>(surfaces, [](const Row& s) { return s.nodata; }),
      "svf_mean"_a = column<double>(surfaces, [](const Row& s) { return s.svf_mean.value_or(no_data); }),
      "svf_min"_a = column<double>(surfaces, [](const Row& s) { return s.svf_min.value_or(no_data); }),
      "svf_max"_a = column<double>(surfaces, [](const Row& s) { return s.svf_max.value_or(no_data); }),
      "irradiation_kwh"_a = column<double>(surfaces, [](const Row& s) { return s.irradiation ? s.irradiation->kwh : no_data; }),
      "area_above_m2"_a = column<double>(
          surfaces, [](const Row& s) { return s.irradiation ? s.irradiation->area_above_m2.value_or(no_data) : no_data; }),
      "further"_a = further_of(
          surfaces, further_columns, [](const Row& s) -> const auto& { return s.further_mean; }));
}

py::dict dict_of(const std::vector<SurfacePoint>& points, std::size_t further_columns) {
  using Row = SurfacePoint;
  return py::dict("building"_a = buildings_of(points),
                  "surface"_a = column<std::uint32_t>(points, [](const Row& p) { return p.surface; }),
                  "kind"_a = column<std::uint8_t>(points, [](const Row& p) { return p.kind; }),
                  "x_m"_a = column<double>(points, [](const Row& p) { return p.p_projected.x; }),
                  "y_m"_a = column<double>(points, [](const Row& p) { return p.p_projected.y; }),
                  "z_m"_a = column<double>(points, [](const Row& p) { return p.p_projected.z; }),
                  "azimuth_deg"_a = column<double>(points, [](const Row& p) { return p.azimuth.degrees(); }),
                  "tilt_deg"_a = column<double>(points, [](const Row& p) { return p.tilt.degrees(); }),
                  "area_m2"_a = column<double>(points, [](const Row& p) { return p.area_m2; }),
                  "svf"_a = column<double>(points, [](const Row& p) { return p.svf.value_or(no_data); }),
                  "low"_a = column<double>(points, [](const Row& p) { return p.low.value_or(no_data); }),
                  "high"_a = column<double>(points, [](const Row& p) { return p.high.value_or(no_data); }),
                  "further"_a = further_of(
                      points, further_columns, [](const Row& p) -> const auto& { return p.further; }));
}

py::dict evaluate_surfaces_in_python(const Package& package, const std::string& which, double spacing_m,
                                     std::optional<double> irradiation_threshold_kwh_m2, bool wants_points,
                                     const EvaluationSettings& settings, const CallerSettings& caller) {
  const SurfaceSettings surfaces{meaning_of("which", which, surface_choice_words), spacing_m, irradiation_threshold_kwh_m2};
  std::vector<SurfacePoint> points;
  const OnSurfacePoints keep = [&points](std::size_t, std::span<const SurfacePoint> of_cell) {
    points.insert(points.end(), of_cell.begin(), of_cell.end());
  };
  SurfaceMeans means;
  run_interruptibly(caller, [&](const RunSettings& run) {
    means = evaluate_surfaces(package, surfaces, settings, wants_points ? keep : OnSurfacePoints(), run);
  });
  const std::size_t further_columns = columns_of(settings.further).size();
  return py::dict("means"_a = dict_of(means.surfaces, further_columns), "points"_a = dict_of(points, further_columns),
                  "summary"_a = summary_dict(means.summary));
}

py::dict dict_of(const MatrixFigures& figures) {
  const auto spread = [](double mean, double max) { return py::dict("mean"_a = mean, "max"_a = max); };
  return py::dict("receivers"_a = figures.receivers, "rays"_a = figures.rays,
                  "reciprocity"_a = spread(figures.reciprocity_mean, figures.reciprocity_max),
                  "closure"_a = spread(figures.closure_mean, figures.closure_max),
                  "dropped"_a = spread(figures.dropped_mean, figures.dropped_max), "divided_rows"_a = figures.divided_rows);
}

/// The arrays of a sparse matrix by SciPy's names and types, and what its rows and columns are.
py::dict dict_of(ViewFactorMatrix matrix, const std::vector<SurfaceMean>& surfaces) {
  std::vector<std::int64_t> begins{0};
  for (const std::uint64_t end : matrix.row_end) begins.push_back(static_cast<std::int64_t>(end));
  std::vector<std::int32_t> cells;
  std::vector<double> centres;
  for (const GroundColumn& ground : matrix.ground) {
    cells.insert(cells.end(), {ground.cell.i, ground.cell.j});
    centres.insert(centres.end(), {ground.centre_projected.x, ground.centre_projected.y});
  }
  const std::vector<py::ssize_t> pairs{static_cast<py::ssize_t>(matrix.ground.size()), 2};
  return py::dict("data"_a = owned_array(std::move(matrix.values)),
                  "indices"_a = owned_array(std::vector<std::int32_t>(matrix.columns.begin(), matrix.columns.end())),
                  "indptr"_a = owned_array(std::move(begins)), "building"_a = buildings_of(surfaces),
                  "surface"_a = column<std::uint32_t>(surfaces, [](const SurfaceMean& s) { return s.surface; }),
                  "area_m2"_a = owned_array(std::move(matrix.area_m2)), "ground_cells"_a = owned_array(std::move(cells), pairs),
                  "ground_centres_m"_a = owned_array(std::move(centres), pairs), "figures"_a = dict_of(matrix.figures));
}

py::dict view_factor_matrix_in_python(const Package& package, const std::string& which, double spacing_m, double threshold,
                                      const EvaluationSettings& settings, const CallerSettings& caller) {
  const SurfaceSettings surfaces{meaning_of("which", which, surface_choice_words), spacing_m, {}};
  SurfaceMeans means;
  ViewFactorMatrix matrix;
  run_interruptibly(caller, [&](const RunSettings& run) {
    means = evaluate_surfaces(package, surfaces, settings, {}, run);
    matrix = view_factor_matrix(package, surfaces, means.surfaces, {threshold}, settings, run);
  });
  return dict_of(std::move(matrix), means.surfaces);
}

}  // namespace

void add_surfaces(py::module_& module) {
  module.def("evaluate_surfaces", &evaluate_surfaces_in_python, py::arg("package"), py::arg("which"), py::arg("spacing_m"),
             py::arg("irradiation_threshold_kwh_m2"), py::arg("points"), py::arg("settings"), py::arg("caller"));
  module.def("view_factor_matrix", &view_factor_matrix_in_python, py::arg("package"), py::arg("which"), py::arg("spacing_m"),
             py::arg("threshold"), py::arg("settings"), py::arg("caller"));
}

}  // namespace farlod
