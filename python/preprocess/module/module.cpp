// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "farlod/version.hpp"
#include "python/binding/exceptions.hpp"
#include "python/preprocess/module/packing.hpp"

// farlod/pack.hpp as Python can call it; farlod.pack() is what users call, and has the documentation.
PYBIND11_MODULE(_preprocess, module) {
  farlod::translate_exceptions();
  module.attr("version") = farlod::software_version;
  farlod::add_packing(module);
}
