// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include "farlod/points.hpp"
#include "farlod/version.hpp"
#include "python/binding/exceptions.hpp"
#include "python/runtime_module/evaluation.hpp"
#include "python/runtime_module/light.hpp"
#include "python/runtime_module/package.hpp"
#include "python/runtime_module/settings.hpp"

// The functions of farlod/*.hpp as Python can call them; what users call stands in python/src/farlod, and has the documentation.
PYBIND11_MODULE(_runtime, module) {
  farlod::translate_exceptions();
  module.attr("version") = farlod::software_version;
  module.attr("answered_beyond_grid_m") = farlod::answered_beyond_grid_m;
  farlod::add_package(module);
  farlod::add_cells(module);
  farlod::add_settings(module);
  farlod::add_weather(module);
  farlod::add_evaluation(module);
  farlod::add_surfaces(module);
}
