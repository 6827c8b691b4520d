// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include "farlod/quantities.hpp"

namespace farlod {

/// Adds set_light() to the quantities.
void add_light_of(pybind11::class_<Quantities>& quantities);

/// Adds light_of_period() and global_horizontal_kwh_m2() to the module.
void add_weather(pybind11::module_& module);

}  // namespace farlod
