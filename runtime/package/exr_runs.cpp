// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "package/exr_runs.hpp"

#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

using Bytes = std::span<const std::uint8_t>;
/// Bytes are written in blocks of always the same size, which need neither a call nor a decision; what is too much, the next run
/// overwrites.
constexpr std::size_t block = 16;
/// What stands for no difference between two bytes.
constexpr std::uint8_t no_difference = 128;

void copy(Bytes rest, std::size_t count, std::uint8_t* to) {
  if (rest.size() < count + block) {
    std::memcpy(to, rest.data(), count);
    return;
  }
  for (std::size_t n = 0; n < count; n += block) std::memcpy(to + n, rest.data() + n, block);
}

void repeat(std::uint8_t byte, std::size_t count, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; n += block) std::memset(to + n, byte, block);
}

/// Runs of up to 128 bytes, each behind a byte that says how many: less than 0 of different bytes, from 0 on one more of the
/// same. `bytes` has room for a block more than `size`.
bool undo_runs(Bytes rest, std::size_t size, std::uint8_t* bytes) {
  while (!rest.empty()) {
    const auto head = static_cast<std::int8_t>(rest[0]);
    const std::size_t count = static_cast<std::size_t>(head < 0 ? -head : head + 1), needs = head < 0 ? count : 1;
    rest = rest.subspan(1);
    if (count > size || needs > rest.size()) return false;
    head < 0 ? copy(rest, count, bytes) : repeat(rest[0], count, bytes);
    rest = rest.subspan(needs);
    bytes += count;
    size -= count;
  }
  return size == 0;
}

/// The first half of the differences leads through the low bytes, the second half on through the high ones. Both at once, since
/// one byte waits for the one before.
void undo_differences(Bytes differences, std::span<std::byte> pixels) {
  const std::size_t half = differences.size() / 2;
  const auto plus = [](std::uint8_t byte, std::uint8_t difference) {
    return static_cast<std::uint8_t>(byte + difference - no_difference);
  };
  std::uint8_t low = no_difference;
  std::uint8_t high = std::accumulate(differences.begin(), differences.begin() + static_cast<std::ptrdiff_t>(half), low, plus);
  for (std::size_t n = 0; n < half; ++n) {
    low = plus(low, differences[n]);
    high = plus(high, differences[half + n]);
    pixels[2 * n] = std::byte{low};
    pixels[2 * n + 1] = std::byte{high};
  }
}

}  // namespace

bool undo_exr_runs(std::span<const std::byte> packed, std::span<std::byte> pixels) {
  FARLOD_EXPECTS(pixels.size() % 2 == 0);
  std::vector<std::uint8_t> differences(pixels.size() + block);
  if (!undo_runs({reinterpret_cast<const std::uint8_t*>(packed.data()), packed.size()}, pixels.size(), differences.data()))
    return false;
  undo_differences(Bytes(differences).first(pixels.size()), pixels);
  return true;
}

}  // namespace farlod
