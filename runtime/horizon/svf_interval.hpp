// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace farlod {

/// A sky view factor, and the bounds that are certain for the same azimuths.
struct SvfInterval {
  float low = 0.0F, estimate = 0.0F, high = 0.0F;

  [[nodiscard]] float width() const { return high - low; }
};

/// The interval with its estimate moved towards the middle, until it is no farther than `error` from either end, as long as
/// that is possible.
[[nodiscard]] inline SvfInterval within_error(const SvfInterval& svf, float error) {
  const float most = std::max(svf.low, svf.high - error), least = std::min(svf.high, svf.low + error);
  return {svf.low, std::clamp(svf.estimate, std::min(most, least), std::max(most, least)), svf.high};
}

}  // namespace farlod
