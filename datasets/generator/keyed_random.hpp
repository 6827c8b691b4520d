// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>

namespace farlod {

/// Random numbers that are a function of a key, the same on every machine (SplitMix64, Steele, Lea & Flood 2014). Each block of
/// the city has its own key, so that its numbers do not depend on the blocks made before. The distributions of the standard
/// library differ between implementations and are not used.
///
/// Draw one number per statement: C++ does not order the operands of an expression.
class KeyedRandom {
 public:
  explicit constexpr KeyedRandom(std::initializer_list<std::uint64_t> key) {
    for (const std::uint64_t part : key) state_ = mixed(state_ + golden_step + part);
  }

  [[nodiscard]] constexpr std::uint64_t bits() { return mixed(state_ += golden_step); }
  /// In [0, 1).
  [[nodiscard]] constexpr double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In [low, high).
  [[nodiscard]] constexpr double between(double low, double high) { return low + (high - low) * unit(); }
  /// A whole number in [low, high].
  [[nodiscard]] constexpr int whole(int low, int high) {
    return low + static_cast<int>(unit() * static_cast<double>(high - low + 1));
  }
  /// True in the given share of cases; never for 0, always for 1.
  [[nodiscard]] constexpr bool chance(double share) { return unit() < share; }

 private:
  static constexpr std::uint64_t golden_step = 0x9E3779B97F4A7C15U;
  [[nodiscard]] static constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
};

/// The uses of the random numbers of a block. Each use has numbers of its own.
enum class RandomStream : std::uint64_t {
  block = 1,
  bridges,
  avenue_line,
  street_line,
  urbanity_noise,
  ground_noise,
  sub_centre,
  hillside_line,
  building_parts,
  projecting_floors,
  wrong_base,
  balconies,
  facade,
  trees
};

[[nodiscard]] constexpr std::uint64_t key_of(RandomStream stream) { return static_cast<std::uint64_t>(stream); }
[[nodiscard]] constexpr std::uint64_t key_of(std::int64_t number) { return static_cast<std::uint64_t>(number); }

}  // namespace farlod
