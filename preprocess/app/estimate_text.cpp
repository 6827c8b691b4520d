// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/estimate_text.hpp"

#include <fmt/core.h>

#include "console/rough_number.hpp"

namespace farlod {

std::string estimate_text(const PackEstimate& e) {
  const std::string far_maps = e.far_maps < e.cells ? ", far maps to make for " + with_commas(e.far_maps) : "";
  return fmt::format("{} cells{}: about {} from here on, {} of memory, and a package of {}", with_commas(e.cells), far_maps,
                     rough_duration(e.seconds), rough_size(e.memory_mib), rough_size(e.package_mib));
}

}  // namespace farlod
