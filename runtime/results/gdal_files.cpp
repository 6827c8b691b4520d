// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "results/gdal_files.hpp"

#include "results/module.hpp"

namespace farlod {

const GdalFiles& gdal_files() {
  static const auto& files = *static_cast<const GdalFiles*>(functions_of_module("farlod_gdal", "GDAL"));
  return files;
}

}  // namespace farlod
