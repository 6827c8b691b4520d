// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/expects.hpp"
#include "inputs/point_reader.hpp"
#include "tests/fuzz/fuzzed_package.hpp"
#include "tests/fuzz/scratch_folder.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace farlod;
  static const ScratchFolder folder;
  const std::filesystem::path file = folder.write({data, size}, "points.csv");
  expect_answer_or_refusal([&] {
    const RequestedPoints read = read_points_csv(file);
    FARLOD_EXPECTS(!read.points.empty());
    for (std::size_t n = 0; n < read.points.size(); ++n) {
      const RequestedPoint& p = read.points[n];
      FARLOD_EXPECTS(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z.value_or(0.0)) && !p.id.empty());
      for (std::size_t k = 0; k < read.attributes.names().size(); ++k) (void)read.attributes.value(n, k);
    }
  });
  return 0;
}
