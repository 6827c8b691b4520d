// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

/// Vectors of sixteen lanes for the kernels (kernels.hpp), which are compiled once for each generation of processors: one, two or
/// four registers of the processor. There is no fused multiply-add (-ffp-contract=off), so that all processors give the same
/// bits.
///
/// Each function is inlined always: none is emitted on its own, so that no code for a newer processor can take the place of the
/// same function for an older one.
#define FARLOD_LANES inline __attribute__((always_inline))

namespace farlod {

inline constexpr std::size_t lane_count = 16;
/// As many as a register of the target holds. g++ and clang take a vector of sixteen, too, and split it. But g++ 12 splits
/// a < b ? x : y lane by lane: with -O3 -mavx2, a function of c = a < b ? a : b takes 83 instructions for vectors of 64 bytes,
/// and 5 for those of 32. tests/runtime/horizon/compare_in_registers counts in the kernels.
#if defined(__AVX512F__)
inline constexpr std::size_t register_lanes = 16;
#elif defined(__AVX2__)
inline constexpr std::size_t register_lanes = 8;
#else
inline constexpr std::size_t register_lanes = 4;
#endif
inline constexpr std::size_t register_count = lane_count / register_lanes;
using FloatRegister = float __attribute__((vector_size(register_lanes * sizeof(float))));
using IntRegister = std::int32_t __attribute__((vector_size(register_lanes * sizeof(std::int32_t))));

/// What a comparison gives: for each lane all bits set, or none.
struct Mask {
  IntRegister registers[register_count];
};

/// Sixteen numbers at once. In an operation of two, one may be a number: it counts for all lanes.
template <class Number, class Register>
struct Vector {
  Register registers[register_count];

  Vector() = default;
  FARLOD_LANES Vector(Number n) {
    // Not n + 0, which is another number for −0, so that the compiler must add. NOLINTNEXTLINE(modernize-loop-convert)
    for (std::size_t r = 0; r < register_count; ++r) registers[r] = n - Register{};
  }

#define FARLOD_OPERATOR(Result, op)                                                                     \
  friend FARLOD_LANES Result operator op(const Vector& a, const Vector& b) {                            \
    Result v;                                                                                           \
    for (std::size_t r = 0; r < register_count; ++r) v.registers[r] = a.registers[r] op b.registers[r]; \
    return v;                                                                                           \
  }
  FARLOD_OPERATOR(Vector, +)
  FARLOD_OPERATOR(Vector, -)
  FARLOD_OPERATOR(Vector, *)
  FARLOD_OPERATOR(Vector, /)
  FARLOD_OPERATOR(Vector, &)
  FARLOD_OPERATOR(Vector, <<)
  FARLOD_OPERATOR(Vector, >>)
  FARLOD_OPERATOR(Mask, <)
  FARLOD_OPERATOR(Mask, >)
  FARLOD_OPERATOR(Mask, >=)
  FARLOD_OPERATOR(Mask, <=)
  FARLOD_OPERATOR(Mask, ==)
#undef FARLOD_OPERATOR
  FARLOD_LANES Vector operator-() const {
    Vector v;
    for (std::size_t r = 0; r < register_count; ++r) v.registers[r] = -registers[r];
    return v;
  }
  FARLOD_LANES Vector& operator+=(const Vector& b) { return *this = *this + b; }
};
using Floats = Vector<float, FloatRegister>;
using Ints = Vector<std::int32_t, IntRegister>;

FARLOD_LANES Floats broadcast(float x) { return x; }
FARLOD_LANES Ints broadcast(std::int32_t n) { return n; }
/// Loads and stores copy register by register: g++ 12 keeps a vector in memory that is copied as a whole, which makes kernels of
/// AVX2 up to three times as slow.
FARLOD_LANES Floats load(const float* from) {
  Floats v;
  for (std::size_t r = 0; r < register_count; ++r) std::memcpy(&v.registers[r], from + r * register_lanes, sizeof v.registers[r]);
  return v;
}
FARLOD_LANES Ints load(const std::int32_t* from) {
  Ints v;
  for (std::size_t r = 0; r < register_count; ++r) std::memcpy(&v.registers[r], from + r * register_lanes, sizeof v.registers[r]);
  return v;
}
template <class N, class R>
FARLOD_LANES void store(const Vector<N, R>& v, N* to) {
  for (std::size_t r = 0; r < register_count; ++r) std::memcpy(to + r * register_lanes, &v.registers[r], sizeof v.registers[r]);
}
/// To read lanes one by one.
template <class N, class R>
FARLOD_LANES std::array<N, lane_count> to_array(const Vector<N, R>& v) {
  std::array<N, lane_count> lanes;
  store(v, lanes.data());
  return lanes;
}

/// x where the mask is set, y elsewhere.
template <class N, class R>
FARLOD_LANES Vector<N, R> choose(const Mask& mask, const Vector<N, R>& x, const Vector<N, R>& y) {
  Vector<N, R> v;
  for (std::size_t r = 0; r < register_count; ++r) v.registers[r] = mask.registers[r] ? x.registers[r] : y.registers[r];
  return v;
}
template <class N, class R>
FARLOD_LANES Vector<N, R> min(const Vector<N, R>& a, const Vector<N, R>& b) {
  return choose(a < b, a, b);
}
template <class N, class R>
FARLOD_LANES Vector<N, R> max(const Vector<N, R>& a, const Vector<N, R>& b) {
  return choose(a > b, a, b);
}
/// The bits of floats as integers, and back.
FARLOD_LANES Ints to_bits(const Floats& a) {
  Ints bits;
  for (std::size_t r = 0; r < register_count; ++r) std::memcpy(&bits.registers[r], &a.registers[r], sizeof a.registers[r]);
  return bits;
}
FARLOD_LANES Floats from_bits(const Ints& bits) {
  Floats v;
  for (std::size_t r = 0; r < register_count; ++r) std::memcpy(&v.registers[r], &bits.registers[r], sizeof bits.registers[r]);
  return v;
}
/// Without the sign bit.
FARLOD_LANES Floats abs(const Floats& a) { return from_bits(to_bits(a) & 0x7FFFFFFF); }
FARLOD_LANES Floats sqrt(const Floats& a) {
  Floats v;
  for (std::size_t r = 0; r < register_count; ++r)
    for (std::size_t l = 0; l < register_lanes; ++l) v.registers[r][l] = __builtin_sqrtf(a.registers[r][l]);
  return v;
}
FARLOD_LANES Ints truncate(const Floats& a) {
  Ints v;
  for (std::size_t r = 0; r < register_count; ++r) v.registers[r] = __builtin_convertvector(a.registers[r], IntRegister);
  return v;
}
FARLOD_LANES Floats to_floats(const Ints& n) {
  Floats v;
  for (std::size_t r = 0; r < register_count; ++r) v.registers[r] = __builtin_convertvector(n.registers[r], FloatRegister);
  return v;
}

/// Each lane in the place of the one `apart` lanes away.
template <std::size_t apart, std::size_t... lane>
FARLOD_LANES Floats swap_lanes(const Floats& v, std::index_sequence<lane...>) {
  Floats swapped;
  for (std::size_t r = 0; r < register_count; ++r) {
    if constexpr (apart >= register_lanes)
      swapped.registers[r] = v.registers[r ^ (apart / register_lanes)];
    else
      swapped.registers[r] = __builtin_shufflevector(v.registers[r], v.registers[r], (lane ^ apart)...);
  }
  return swapped;
}
/// The least, or the greatest, of all lanes: fold the vector in half four times. Registers that do not matter any more are left
/// out by the compiler.
template <std::size_t apart = lane_count / 2>
FARLOD_LANES float min_lane(const Floats& v) {
  if constexpr (apart == 0)
    return v.registers[0][0];
  else
    return min_lane<apart / 2>(min(v, swap_lanes<apart>(v, std::make_index_sequence<register_lanes>())));
}
FARLOD_LANES float max_lane(const Floats& v) { return -min_lane(-v); }

/// Two vectors that hold parts of 2 · half lanes each, as one that holds, of each part in turn, the lesser of its halves' lanes.
template <std::size_t half, std::size_t... lane>
FARLOD_LANES Floats fold_halves(const Floats& a, const Floats& b, std::index_sequence<lane...>) {
  Floats folded;
  const auto both = [&](std::size_t r) -> const FloatRegister& {
    return r < register_count ? a.registers[r] : b.registers[r - register_count];
  };
  for (std::size_t r = 0; r < register_count; ++r) {
    FloatRegister first, second;
    if constexpr (half >= register_lanes) {
      constexpr std::size_t apart = half / register_lanes;
      first = both(r / apart * 2 * apart + r % apart);
      second = both(r / apart * 2 * apart + r % apart + apart);
    } else {
      first = __builtin_shufflevector(both(2 * r), both(2 * r + 1), (lane / half * 2 * half + lane % half)...);
      second = __builtin_shufflevector(both(2 * r), both(2 * r + 1), (lane / half * 2 * half + lane % half + half)...);
    }
    folded.registers[r] = first < second ? first : second;
  }
  return folded;
}
/// The least lane of each of sixteen vectors.
FARLOD_LANES Floats min_lanes(Floats (&v)[lane_count]) {
  constexpr std::make_index_sequence<register_lanes> lanes;
  for (std::size_t n = 0; n < 8; ++n) v[n] = fold_halves<8>(v[2 * n], v[2 * n + 1], lanes);
  for (std::size_t n = 0; n < 4; ++n) v[n] = fold_halves<4>(v[2 * n], v[2 * n + 1], lanes);
  for (std::size_t n = 0; n < 2; ++n) v[n] = fold_halves<2>(v[2 * n], v[2 * n + 1], lanes);
  return fold_halves<1>(v[0], v[1], lanes);
}

/// A bit for each lane that is set. Processors have an instruction for it that no vector extension says.
FARLOD_LANES std::uint32_t bits_of(const Mask& mask) {
  std::uint32_t bits = 0;
  for (std::size_t r = 0; r < register_count; ++r) {
#if defined(__AVX512F__)
    const auto of_register = static_cast<std::uint32_t>(__builtin_ia32_cvtd2mask512(mask.registers[r]));
#elif defined(__AVX2__)
    const auto of_register =
        static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<FloatRegister>(mask.registers[r])));
#elif defined(__SSE2__)
    const auto of_register =
        static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<FloatRegister>(mask.registers[r])));
#else
    std::uint32_t of_register = 0;
    for (std::size_t l = 0; l < register_lanes; ++l) of_register |= (static_cast<std::uint32_t>(mask.registers[r][l]) & 1U) << l;
#endif
    bits |= of_register << (r * register_lanes);
  }
  return bits;
}

/// floor(log2(n)) of n ≥ 1: the exponent of n as a float.
FARLOD_LANES Ints floor_log2(const Ints& n) { return (to_bits(to_floats(n)) >> 23) - 127; }

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
  const Floats quarter = 0.25F * y / choose(sum > 0.0F, sum, broadcast(1.0F));
  const Floats right = choose(y < 0.0F, 1.0F + quarter, quarter);
  return choose(x < 0.0F, 0.5F - quarter, right);
}

}  // namespace farlod
