// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

// village_sky CITY PACKAGE: packs a city file, and prints the sky view factor in the middle of the city, 1.5 m above the ground.
#include <cstdio>
#include <exception>
#include <vector>

#include "farlod/pack.hpp"
#include "farlod/points.hpp"

namespace {

void pack_city(const char* city, const char* folder) {
  farlod::PackSettings settings;
  settings.inputs = {city};
  settings.output = folder;
  settings.overwrite = farlod::Overwrite::replace;
  farlod::Report report;
  const farlod::PackResult packed = farlod::pack(settings, report);
  std::printf("%llu buildings, %zu problems\n", static_cast<unsigned long long>(packed.package.buildings),
              report.problems().size());
}

void print_sky(const char* folder) {
  const farlod::Package package(folder);
  const auto& [low, high] = package.description().outline_projected;
  const std::vector<double> x{0.5 * (low.x + high.x)}, y{0.5 * (low.y + high.y)};
  const farlod::PointAnswers answers = farlod::evaluate_points(package, {x, y});
  std::printf("svf %.4f\n", static_cast<double>(answers.svf[0]));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    pack_city(argv[1], argv[2]);
    print_sky(argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "village_sky: %s\n", error.what());
    return 1;
  }
}
