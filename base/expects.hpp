// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

namespace farlod::detail {

[[noreturn]] inline void abort_with_broken_promise(const char* condition, const char* file, int line) {
  (void)std::fprintf(stderr, "farlod: a promise of the code is broken: %s (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace farlod::detail

/// A promise of our own code. A breach is our bug, never the user's data: it aborts and names the line.
#define FARLOD_EXPECTS(condition) \
  ((condition) ? void(0) : ::farlod::detail::abort_with_broken_promise(#condition, __FILE__, __LINE__))
