// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/morphology.hpp"
#include "farlod/package.hpp"
#include "farlod/run.hpp"
#include "python/binding/interruptible_run.hpp"
#include "python/binding/owned_array.hpp"
#include "python/runtime_module/package.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace farlod {
namespace {

/// The values of all cells or zones, a column after the other; NaN where a cell has nothing to tell.
template <class Form>
std::vector<std::vector<double>> values_of_forms(const std::vector<Form>& forms, std::size_t count) {
  std::vector<std::vector<double>> columns(count);
  for (const UrbanForm& form : forms) {
    const std::vector<std::optional<double>> values = morphology_values(form);
    for (std::size_t n = 0; n < count; ++n) columns[n].push_back(values[n].value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return columns;
}

template <class Form>
py::dict columns_by_name(const std::vector<Form>& forms) {
  const std::vector<ColumnDescription> descriptions = morphology_columns();
  std::vector<std::vector<double>> values = values_of_forms(forms, descriptions.size());
  py::dict columns;
  for (std::size_t n = 0; n < descriptions.size(); ++n)
    columns[py::str(descriptions[n].name)] = owned_array(std::move(values[n]));
  return columns;
}

template <class Form>
void add_sky(const std::vector<CellSky>& skies, std::vector<Form>& forms) {
  for (std::size_t n = 0; n < forms.size(); ++n) forms[n].sky = skies[n];
}

/// With the sky, if receivers have a spacing.
std::vector<CellMorphology> cells_with_sky(const Package& package, std::optional<double> spacing_m,
                                           const EvaluationSettings& settings, const RunSettings& run) {
  std::vector<CellMorphology> cells = morphology_of_cells(package, run);
  if (spacing_m) add_sky(sky_of_cells(package, *spacing_m, settings, run), cells);
  return cells;
}

/// Places and corners of cells, and the columns by their names.
py::dict cells_in_python(const Package& package, std::optional<double> spacing_m, const EvaluationSettings& settings,
                         const CallerSettings& caller) {
  std::vector<CellMorphology> cells;
  run_interruptibly(caller, [&](const RunSettings& run) { cells = cells_with_sky(package, spacing_m, settings, run); });
  std::vector<std::int32_t> i, j;
  std::vector<double> corners;
  for (const CellMorphology& cell : cells) {
    i.push_back(cell.cell.i);
    j.push_back(cell.cell.j);
    for (const Point2d corner : cell.corners_projected) corners.insert(corners.end(), {corner.x, corner.y});
  }
  return py::dict("i"_a = owned_array(std::move(i)), "j"_a = owned_array(std::move(j)),
                  "corners_m"_a = owned_array(std::move(corners), {static_cast<py::ssize_t>(cells.size()), 4, 2}),
                  "columns"_a = columns_by_name(cells));
}

using ZoneInPython = std::vector<std::vector<std::array<double, 2>>>;

std::vector<Zone> zones_of(const std::vector<ZoneInPython>& zones) {
  std::vector<Zone> result;
  for (const ZoneInPython& rings : zones) {
    Zone& zone = result.emplace_back();
    for (const auto& ring : rings) {
      std::vector<Point2d>& corners = zone.emplace_back();
      for (const auto& [x, y] : ring) corners.push_back({x, y});
    }
  }
  return result;
}

py::dict zones_in_python(const Package& package, const std::vector<ZoneInPython>& in_python, std::optional<double> spacing_m,
                         const EvaluationSettings& settings, const CallerSettings& caller) {
  const std::vector<Zone> zones = zones_of(in_python);
  std::vector<UrbanForm> forms;
  run_interruptibly(caller, [&](const RunSettings& run) {
    forms = morphology_of_zones(package, zones, run);
    if (spacing_m) add_sky(sky_of_zones(package, zones, *spacing_m, settings, run), forms);
  });
  return columns_by_name(forms);
}

}  // namespace

void add_cells(py::module_& module) {
  module.def("cells_of", &cells_in_python, py::arg("package"), py::arg("svf_spacing_m"), py::arg("settings"), py::arg("caller"));
  module.def("zones_of", &zones_in_python, py::arg("package"), py::arg("zones_m"), py::arg("svf_spacing_m"), py::arg("settings"),
             py::arg("caller"));
}

}  // namespace farlod
