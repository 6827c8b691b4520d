// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace farlod {

/// Adds Placing, Quantities, Region and EvaluationSettings to the module, with the words of the programs for what is an enum
/// here.
void add_settings(pybind11::module_& module);

}  // namespace farlod
