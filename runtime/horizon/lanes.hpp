// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

/// Compiles a function for several generations of processors; the one that fits is chosen when the program starts. Vectors of 16
/// lanes become one, two or four of the processor's registers, without fused multiply-add, so that all of them give the same
/// bits.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
#define FARLOD_FOR_EACH_PROCESSOR __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define FARLOD_FOR_EACH_PROCESSOR
#endif
/// For the parts of such functions: only what is inlined is compiled for each processor.
#define FARLOD_LANES inline __attribute__((always_inline))

namespace farlod {

inline constexpr std::size_t lane_count = 16;
/// Sixteen numbers at once. A comparison must stand within the one choice that it makes (a < b ? x : y): g++ 12 takes one apart
/// lane by lane that is kept in a variable, or joined with another (also by nesting choices with the same last value).
using Floats = float __attribute__((vector_size(64)));
using Ints = std::int32_t __attribute__((vector_size(64)));

FARLOD_LANES Floats broadcast(float x) { return Floats{} + x; }
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

/// The least, or the greatest, of all lanes.
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

/// Arc tangent of 0 ≤ t ≤ 1, within 2e-8 (Abramowitz & Stegun, 4.4.49).
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

/// Grows with the azimuth of (x, y), counter-clockwise from the x axis, from 0 to 1 in a turn: a quarter of the pseudo-angle
/// (farlod/horizon/azimuth.hpp), as floats. Opposite directions are half a turn apart. Of (0, 0) it is 0.
FARLOD_LANES Floats pseudo_angle(const Floats& x, const Floats& y) {
  const Floats sum = abs(x) + abs(y);
  const Floats across = 0.25F * y / (sum > 0.0F ? sum : broadcast(1.0F));
  const Floats right = y < 0.0F ? 1.0F + across : across;
  return x < 0.0F ? 0.5F - across : right;
}

}  // namespace farlod
