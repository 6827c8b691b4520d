// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

/// Vectors of sixteen lanes for the kernels (kernels.hpp), which are compiled once for each generation of processors. g++ and
/// clang split such a vector into one, two or four registers of the processor. There is no fused multiply-add
/// (-ffp-contract=off), so that all processors give the same bits.
///
/// Each function is inlined always: none is emitted on its own, so that no code for a newer processor can take the place of the
/// same function for an older one.
#define FARLOD_LANES inline __attribute__((always_inline))

namespace farlod {

inline constexpr std::size_t lane_count = 16;
/// Sixteen numbers at once. A comparison must stand within the one choice that it makes (a < b ? x : y): g++ 12 computes it lane
/// by lane if it is stored in a variable, or joined with another (also by nesting choices with the same last value).
using Floats = float __attribute__((vector_size(64)));
using Ints = std::int32_t __attribute__((vector_size(64)));

FARLOD_LANES Floats broadcast(float x) { return Floats{} + x; }
FARLOD_LANES Ints broadcast(std::int32_t n) { return Ints{} + n; }
FARLOD_LANES Floats load(const float* from) {
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
FARLOD_LANES void store(const Floats& v, float* to) { std::memcpy(to, &v, sizeof v); }
FARLOD_LANES Floats min(const Floats& a, const Floats& b) { return a < b ? a : b; }
FARLOD_LANES Floats max(const Floats& a, const Floats& b) { return a > b ? a : b; }
FARLOD_LANES Ints min(const Ints& a, const Ints& b) { return a < b ? a : b; }
FARLOD_LANES Ints max(const Ints& a, const Ints& b) { return a > b ? a : b; }
FARLOD_LANES Floats abs(const Floats& a) { return a < 0.0F ? -a : a; }
FARLOD_LANES Floats sqrt(const Floats& a) {
  Floats r;
  for (std::size_t l = 0; l < lane_count; ++l) r[l] = __builtin_sqrtf(a[l]);
  return r;
}
FARLOD_LANES Ints truncate(const Floats& a) { return __builtin_convertvector(a, Ints); }

/// The least, or the greatest, of all lanes: fold the vector in half four times.
template <class V>
FARLOD_LANES auto min_lane(const V& v) {
  V m = min(v, __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7));
  m = min(m, __builtin_shufflevector(m, m, 4, 5, 6, 7, 0, 1, 2, 3, 12, 13, 14, 15, 8, 9, 10, 11));
  m = min(m, __builtin_shufflevector(m, m, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13));
  m = min(m, __builtin_shufflevector(m, m, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14));
  return m[0];
}
template <class V>
FARLOD_LANES auto max_lane(const V& v) {
  return -min_lane(-v);
}

/// floor(log2(n)) of n ≥ 1: the exponent of n as a float.
FARLOD_LANES Ints floor_log2(const Ints& n) {
  const Floats value = __builtin_convertvector(n, Floats);
  Ints bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 23) - 127;
}

/// arctan t of 0 ≤ t ≤ 1, within 2e-8 (Abramowitz & Stegun, 4.4.49): t + t³ P(t²), P by Horner's rule.
FARLOD_LANES Floats atan_of_fraction(const Floats& t) {
  const Floats s = t * t;
  Floats p = broadcast(0.0028662257F);
  p = p * s - 0.0161657367F;
  p = p * s + 0.0429096138F;
  p = p * s - 0.0752896400F;
  p = p * s + 0.1065626393F;
  p = p * s - 0.1420889944F;
  p = p * s + 0.1999355085F;
  p = p * s - 0.3333314528F;
  return t + t * s * p;
}

/// The azimuth of (x, y) as a pseudo-angle in turns: it increases with the azimuth, counter-clockwise from the x axis, from 0 to
/// 1. The pseudo-angle of farlod/horizon/azimuth.hpp, as floats. Opposite directions differ by half a turn. The pseudo-angle of
/// (0, 0) is 0.
FARLOD_LANES Floats pseudo_angle(const Floats& x, const Floats& y) {
  const Floats sum = abs(x) + abs(y);
  const Floats quarter = 0.25F * y / (sum > 0.0F ? sum : broadcast(1.0F));
  const Floats right = y < 0.0F ? 1.0F + quarter : quarter;
  return x < 0.0F ? 0.5F - quarter : right;
}

}  // namespace farlod
