// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/receiver_packets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace farlod {
namespace {

/// The bits of a number with two zeros between each and the next: a third of a Morton code.
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t x = bits & 0x1FFFFFU;
  x = (x | x << 32U) & 0x1F00000000FFFFU;
  x = (x | x << 16U) & 0x1F0000FF0000FFU;
  x = (x | x << 8U) & 0x100F00F00F00F00FU;
  x = (x | x << 4U) & 0x10C30C30C30C30C3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

/// Steps of half a metre, finer than receivers stand, from far below any cell.
std::uint64_t morton_code(const Point3f& p) {
  const auto step = [](float x) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x * 2.0F)) + (1 << 20));
  };
  return spread(step(p.x)) | spread(step(p.y)) << 1U | spread(step(p.z)) << 2U;
}

bool look_alike(std::span<const Receiver> receivers) {
  return std::all_of(receivers.begin(), receivers.end(), [&](const Receiver& r) { return r.normal == receivers[0].normal; });
}

}  // namespace

std::vector<std::uint32_t> packet_order(std::span<const Receiver> receivers) {
  std::vector<std::uint32_t> order(receivers.size());
  std::iota(order.begin(), order.end(), 0U);
  if (look_alike(receivers)) return order;
  std::vector<std::uint64_t> codes;
  for (const Receiver& r : receivers) codes.push_back(morton_code(r.p_cell));
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point3f &m = receivers[a].normal, &n = receivers[b].normal;
    return std::tie(m.x, m.y, m.z, codes[a]) < std::tie(n.x, n.y, n.z, codes[b]);
  });
  return order;
}

}  // namespace farlod
