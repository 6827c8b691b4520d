// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "validation/raster_comparison.hpp"

// Prints how far one ESRI ASCII grid is from another, as cells of a row of docs/validation.md:
// count | bias | r | rms | 99 % | max

namespace {

struct Options {
  std::string raster, reference, height;
  farlod::ComparedPixels pixels;
};

int run(Options options) {
  std::optional<farlod::AsciiGrid> height;
  if (!options.height.empty()) height = farlod::read_ascii_grid(options.height);
  if (height) options.pixels.height = &*height;
  const farlod::RasterDifference d =
      compare_rasters(farlod::read_ascii_grid(options.raster), farlod::read_ascii_grid(options.reference), options.pixels);
  std::printf("%zu | %+.4f | %.4f | %.4f | %.4f | %.4f\n", d.count, d.bias, d.correlation, d.rms, d.p99_abs, d.max_abs);
  return 0;
}

}  // namespace

// Only a mistake in the description of the options is not caught. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  CLI::App app("farlod-compare-rasters — how far a raster is from a reference", "farlod-compare-rasters");
  Options options;
  app.add_option("RASTER", options.raster, "ESRI ASCII grid")->required();
  app.add_option("REFERENCE", options.reference, "ESRI ASCII grid whose pixels lie on the other's")->required();
  app.add_option("--rim", options.pixels.rim, "Pixels left out along each border of the reference");
  CLI::Option* height = app.add_option("--height", options.height, "ESRI ASCII grid of heights, for --above and --below");
  app.add_option("--above", options.pixels.low_m, "Compare only pixels that are at least this high")->needs(height);
  app.add_option("--below", options.pixels.high_m, "Compare only pixels that are lower than this")->needs(height);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "farlod-compare-rasters: %s\n", error.what());
    return 1;
  }
}
