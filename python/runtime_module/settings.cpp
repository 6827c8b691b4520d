// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "python/runtime_module/settings.hpp"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "farlod/error.hpp"
#include "farlod/evaluation.hpp"
#include "farlod/region.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "python/binding/word.hpp"
#include "python/runtime_module/light.hpp"

namespace py = pybind11;

namespace farlod {
namespace {

template <class Words>
py::tuple texts_of(const Words& words, std::string_view Words::value_type::*text = &Words::value_type::text) {
  py::tuple texts(words.size());
  for (std::size_t k = 0; k < words.size(); ++k) texts[k] = std::string(words[k].*text);
  return texts;
}

/// A property that is a word in Python and an enum in C++.
template <class Class, class T, std::size_t n>
auto setter_of(const char* name, T Class::*member, const std::array<Word<T>, n>& words) {
  return [name, member, &words](Class& object, const std::string& word) { object.*member = meaning_of(name, word, words); };
}

/// Positions of the sun, given as three arrays of one length.
std::vector<SunPosition> sun_positions(const std::vector<double>& azimuth_deg, const std::vector<double>& elevation_deg,
                                       const std::vector<double>& hours) {
  if (elevation_deg.size() != azimuth_deg.size() || hours.size() != azimuth_deg.size())
    throw InvalidArgument("the sun's azimuths are " + std::to_string(azimuth_deg.size()) + ", its elevations " +
                          std::to_string(elevation_deg.size()) + " and the hours " + std::to_string(hours.size()) +
                          ": give one of each for each position");
  std::vector<SunPosition> positions(azimuth_deg.size());
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k] = {Angle::degrees(azimuth_deg[k]), Angle::degrees(elevation_deg[k]), hours[k]};
  return positions;
}

using RingInPython = std::vector<std::pair<double, double>>;

std::shared_ptr<Region> region_of(const std::vector<RingInPython>& rings_m) {
  std::vector<Region::Ring> rings;
  for (const RingInPython& ring_m : rings_m) {
    Region::Ring& ring = rings.emplace_back();
    for (const auto& [x, y] : ring_m) ring.push_back({x, y});
  }
  return std::make_shared<Region>(rings);
}

/// What crowns of trees do, as properties of the quantities themselves.
void add_canopy(py::class_<Quantities>& quantities) {
  quantities.def_readonly("svf_total", &Quantities::svf_total)
      .def_readwrite("svf_total_bounds", &Quantities::svf_total_bounds)
      .def_property(
          "leaf_off", [](const Quantities& q) { return q.canopy.season == Season::leaf_off; },
          [](Quantities& q, bool is_off) { q.canopy.season = is_off ? Season::leaf_off : Season::leaf_on; })
      .def_property(
          "transmissivity", [](const Quantities& q) { return q.canopy.transmissivity; },
          [](Quantities& q, std::optional<double> share) { q.canopy.transmissivity = share; })
      .def_property(
          "extinction", [](const Quantities& q) { return q.canopy.extinction_per_m; },
          [](Quantities& q, double per_m) { q.canopy.extinction_per_m = per_m; })
      .def(
          "set_canopy_rule",
          [](Quantities& q, const std::string& rule) { q.canopy.rule = meaning_of("canopy_rule", rule, canopy_rule_words); },
          py::arg("rule"));
}

/// Numbers that are chosen, as properties of the quantities themselves.
void add_numbers_of(py::class_<Quantities>& quantities) {
  quantities.def_readwrite("horizons", &Quantities::horizons)
      .def_readwrite("wall_sectors", &Quantities::wall_sectors)
      .def_readwrite("eye_field_deg", &Quantities::eye_field_deg)
      .def_readwrite("seen_building", &Quantities::seen_building);
}

void add_quantities(py::module_& module) {
  py::class_<Quantities> exposed(module, "Quantities");
  add_canopy(exposed);
  add_numbers_of(exposed);
  add_light_of(exposed);
  exposed.def(py::init<>())
      .def(
          "ask",
          [](Quantities& quantities, const std::string& word) {
            if (!ask_for(word, quantities)) throw InvalidArgument("there is no quantity \"" + word + "\"");
          },
          py::arg("word"))
      .def_readwrite("horizon_distances", &Quantities::horizon_distances)
      .def("set_sky_patches", setter_of("sky_patches", &Quantities::sky_patches, sky_patch_words), py::arg("patches"))
      .def(
          "set_sun",
          [](Quantities& quantities, const std::vector<double>& azimuth_deg, const std::vector<double>& elevation_deg,
             const std::vector<double>& hours) { quantities.sun = sun_positions(azimuth_deg, elevation_deg, hours); },
          py::arg("azimuth_deg"), py::arg("elevation_deg"), py::arg("hours"))
      .def("columns", &columns_of)
      .def("descriptions", [](const Quantities& quantities) {
        std::vector<std::tuple<std::string, std::string, std::string>> columns;
        for (const ColumnDescription& column : column_descriptions_of(quantities))
          columns.emplace_back(column.name, column.unit, column.definition);
        return columns;
      });
}

void add_evaluation_settings(py::module_& module) {
  py::class_<EvaluationSettings>(module, "EvaluationSettings")
      .def(py::init<>())
      .def("set_engine", setter_of("engine", &EvaluationSettings::engine, engine_words), py::arg("engine"))
      .def("set_metric", setter_of("metric", &EvaluationSettings::weight, sky_weight_words), py::arg("metric"))
      .def("set_directions", setter_of("directions", &EvaluationSettings::directions, direction_set_words), py::arg("directions"))
      .def(
          "set_region", [](EvaluationSettings& settings, const std::shared_ptr<Region>& region) { settings.region = region; },
          py::arg("region"))
      .def_readwrite("azimuths", &EvaluationSettings::azimuths)
      .def_readwrite("rays", &EvaluationSettings::rays)
      .def_readwrite("max_error", &EvaluationSettings::max_error)
      .def_readwrite("bounds", &EvaluationSettings::bounds)
      .def_readwrite("verify", &EvaluationSettings::verify)
      .def_readwrite("dry_run", &EvaluationSettings::dry_run)
      .def_readwrite("within_m", &EvaluationSettings::within_m)
      .def_readwrite("further", &EvaluationSettings::further);
}

}  // namespace

void add_settings(py::module_& module) {
  py::class_<Placing>(module, "Placing")
      .def(py::init([](const std::string& above, double height_m) {
             return Placing{meaning_of("above", above, height_above_words), height_m};
           }),
           py::arg("above"), py::arg("height_m"));
  py::class_<Region, std::shared_ptr<Region>>(module, "Region").def(py::init(&region_of), py::arg("rings_m"));
  add_quantities(module);
  add_evaluation_settings(module);
  // A test compares them with the types of the package
  py::dict words;
  words["engine"] = texts_of(engine_words);
  words["metric"] = texts_of(sky_weight_words);
  words["directions"] = texts_of(direction_set_words);
  words["above"] = texts_of(height_above_words);
  words["sky_model"] = texts_of(sky_model_words);
  words["sky_patches"] = texts_of(sky_patch_words);
  words["quantity"] = texts_of(quantity_words(), &QuantityWord::word);
  words["canopy_rule"] = texts_of(canopy_rule_words);
  words["which"] = texts_of(surface_choice_words);
  words["kind"] = texts_of(surface_kind_words);
  words["matrix_rest"] = texts_of(matrix_rest_words);
  module.attr("words") = words;
}

}  // namespace farlod
