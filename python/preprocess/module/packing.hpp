// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace farlod {

/// Adds PackSettings, CallerSettings and pack to the module.
void add_packing(pybind11::module_& module);

}  // namespace farlod
