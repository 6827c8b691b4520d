// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace farlod {

/// Adds Package, and what it says of itself: description, check_package, ground_heights, building_outlines, surface_polygons.
void add_package(pybind11::module_& module);

/// Adds cells_of and zones_of: urban form.
void add_cells(pybind11::module_& module);

}  // namespace farlod
