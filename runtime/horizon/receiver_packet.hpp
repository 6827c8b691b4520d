// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "farlod/expects.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Receivers that are computed at once, coordinate by coordinate. Lanes without a receiver repeat the last one. Cell frame.
struct ReceiverPacket {
  static constexpr std::size_t lanes = 16;
  using Lanes = std::array<float, lanes>;

  alignas(64) Lanes x{}, y{}, z{}, normal_x{}, normal_y{}, normal_z{};
  std::size_t count = 0;

  void add(const Receiver& r) {
    FARLOD_EXPECTS(count < lanes);
    for (std::size_t l = count; l < lanes; ++l) {
      x[l] = r.p_cell.x;
      y[l] = r.p_cell.y;
      z[l] = r.p_cell.z;
      normal_x[l] = r.normal.x;
      normal_y[l] = r.normal.y;
      normal_z[l] = r.normal.z;
    }
    ++count;
  }
  [[nodiscard]] float lowest_z() const { return *std::min_element(z.begin(), z.end()); }
};

}  // namespace farlod
