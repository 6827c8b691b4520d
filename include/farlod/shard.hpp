// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace farlod {

/// One of several equal parts of a work, each for a process of its own.
struct Shard {
  std::size_t index = 0;  ///< from 0, below `count`
  std::size_t count = 1;
  bool operator==(const Shard&) const = default;
};

}  // namespace farlod
