// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

// open_sky PACKAGE: the runtime library alone. Prints the mean sky view factor of a raster of 4 m, and shows that an error
// arrives as what it is across the library's border.
#include <cstdio>
#include <exception>

#include "farlod/error.hpp"
#include "farlod/raster.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const farlod::Package package(argv[1]);
    const farlod::Raster raster = farlod::evaluate_raster(package, farlod::plan_raster(package, 4.0));
    std::printf("mean %.4f\n", raster.summary.svf_mean.value_or(-1.0));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "open_sky: %s\n", error.what());
    return 1;
  }
  try {
    const farlod::Package nowhere("/nowhere/town.farlod");
  } catch (const farlod::PackageUnusable&) {
    return 0;
  }
  return 1;
}
