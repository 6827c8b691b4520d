// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace farlod {

/// Adds evaluate_points, plan_raster, evaluate_raster and look_up to the module.
void add_evaluation(pybind11::module_& module);

/// Adds evaluate_surfaces and view_factor_matrix.
void add_surfaces(pybind11::module_& module);

}  // namespace farlod
