// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "results/output_format.hpp"

namespace farlod {

/// "choose .csv", or "choose one of .tif, .tiff"; says so when this build has no such format.
template <class Condition>
[[nodiscard]] std::string advice(const Condition& condition) {
  const std::string endings = endings_where(condition);
  if (endings.empty()) return "this farlod-svf was built without such a format";
  return (endings.find(',') == std::string::npos ? "choose " : "choose one of ") + endings;
}

}  // namespace farlod
