// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "tiles/bounded_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tiles/exact_cutting_cgal.hpp"

namespace farlod::tiles {
namespace {

/// A number, and what it stands for.
struct Pair {
  BoundedNumber bounded;
  Rational exact;
};

bool is_within_bounds(const Pair& p) {
  return !std::isfinite(p.bounded.error()) || abs(p.exact - Rational(p.bounded.value())) <= Rational(p.bounded.error());
}

/// Of either sign and of any size, many of them with few digits.
double random_double(std::mt19937_64& random) {
  const auto digits = static_cast<double>(random() % 4 == 0 ? random() % 8 : random() >> 11);
  return std::ldexp(random() % 2 == 0 ? digits : -digits, static_cast<int>(random() % 80) - 60);
}

Pair combined(std::uint64_t operation, const Pair& a, const Pair& b) {
  if (operation == 0) return {a.bounded + b.bounded, a.exact + b.exact};
  if (operation == 1) return {a.bounded - b.bounded, a.exact - b.exact};
  if (operation == 2 || b.exact == 0) return {a.bounded * b.bounded, a.exact * b.exact};
  return {a.bounded / b.bounded, a.exact / b.exact};
}

TEST(BoundedNumber, IsNoFartherFromTheExactOneThanItsError) {
  std::mt19937_64 random(3);
  std::size_t finite = 0;
  for (int turn = 0; turn < 2'000; ++turn) {
    std::vector<Pair> pairs;
    for (int n = 0; n < 4; ++n) {
      const double x = random_double(random);
      pairs.push_back({x, Rational(x)});
    }
    for (int n = 0; n < 8; ++n) {
      const Pair p = combined(random() % 4, pairs[random() % pairs.size()], pairs[random() % pairs.size()]);
      ASSERT_TRUE(is_within_bounds(p)) << p.bounded.value() << " ± " << p.bounded.error() << " for " << p.exact;
      finite += std::isfinite(p.bounded.error()) ? 1 : 0;
      if (std::isfinite(p.bounded.error())) {
        EXPECT_LE(Rational(p.bounded.low()), p.exact);
        EXPECT_GE(Rational(p.bounded.high()), p.exact);
      }
      pairs.push_back(p);
    }
  }
  EXPECT_GT(finite, 10'000U);
}

TEST(BoundedNumber, StaysExactWhereNothingIsRounded) {
  const BoundedNumber a = 0.1, b = 1e-17;
  EXPECT_TRUE((a + a).is_exact());
  EXPECT_TRUE((a - 0.1).is_exact());
  EXPECT_FALSE((a + b).is_exact());
  // A coordinate that does not change along an edge
  const BoundedNumber share = (BoundedNumber(50.0) - 0.3) / (BoundedNumber(71.1) - 0.3),
                      same = a + share * (BoundedNumber(0.1) - a);
  EXPECT_FALSE(share.is_exact());
  EXPECT_TRUE(same.is_exact());
  EXPECT_EQ(same.value(), 0.1);
}

TEST(BoundedNumber, SaysThatItKnowsNothing) {
  const BoundedNumber nearly_zero = BoundedNumber(0.1) * 10.0 - 1.0;
  EXPECT_FALSE(std::isfinite((BoundedNumber(1.0) / nearly_zero).error()));
  EXPECT_FALSE(std::isfinite((BoundedNumber(1e-200) * 1e-200).error())) << "underflow";
}

}  // namespace
}  // namespace farlod::tiles
