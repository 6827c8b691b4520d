// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

namespace farlod {

/// Whether two closed sequences are the same, wherever each of them begins. Takes time in proportion to their length: the
/// sequences of hostile files repeat themselves, so that each of their turns has to be compared nearly to its end.
template <class Sequence, class Other>
[[nodiscard]] bool is_rotation_of(const Sequence& a, const Other& b) {
  const std::size_t n = std::size(a);
  if (n != std::size(b)) return false;
  if (n == 0) return true;
  // Knuth, Morris & Pratt: search a in b b. failure[k] is the longest beginning of a that ends at a[k], without all of it
  std::vector<std::size_t> failure(n, 0);
  for (std::size_t k = 1, length = 0; k < n; ++k) {
    while (length > 0 && !(a[k] == a[length])) length = failure[length - 1];
    if (a[k] == a[length]) ++length;
    failure[k] = length;
  }
  for (std::size_t k = 0, length = 0; k < 2 * n; ++k) {
    while (length > 0 && !(b[k % n] == a[length])) length = failure[length - 1];
    if (b[k % n] == a[length]) ++length;
    if (length == n) return true;
  }
  return false;
}

}  // namespace farlod
