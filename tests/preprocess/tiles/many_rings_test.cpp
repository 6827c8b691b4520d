// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "city/geometry.hpp"
#include "farlod/point.hpp"
#include "tests/counted/steps.hpp"
#include "tiles/facet_repair.hpp"
#include "tiles/ring_sides.hpp"

namespace farlod::tiles::test {
namespace {

/// The rule of misplaced holes, word for word: each ring with each ring, each edge with each edge.
class PairwiseRings {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  using Outline = std::vector<Point>;

  explicit PairwiseRings(const std::vector<std::vector<Point2d>>& rings) : is_misplaced(rings.size(), false) {
    for (const auto& ring : rings) {
      outlines_.emplace_back();
      for (const Point2d& p : ring) outlines_.back().emplace_back(p.x, p.y);
    }
    place();
  }

  static CGAL::Bounded_side side_of(const Point& p, const Outline& ring) {
    return CGAL::bounded_side_2(ring.begin(), ring.end(), p, Kernel());
  }

  static bool rings_cross(const Outline& a, const Outline& b) {
    for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)})
      if (has_corner_on(*one, *other, CGAL::ON_BOUNDED_SIDE) && has_corner_on(*one, *other, CGAL::ON_UNBOUNDED_SIDE)) return true;
    for (std::size_t j = 0; j < a.size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k)
        if (edges_cross(a[j], a[(j + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return true;
    return false;
  }

  std::optional<std::size_t> true_outer;
  std::vector<bool> is_misplaced;

 private:
  static bool are_same(const Outline& a, Outline b) {
    if (a.size() != b.size()) return false;
    for (int way = 0; way < 2; ++way) {
      for (std::size_t turn = 0; turn < b.size(); ++turn) {
        if (a == b) return true;
        std::rotate(b.begin(), b.begin() + 1, b.end());
      }
      std::reverse(b.begin(), b.end());
    }
    return false;
  }

  static CGAL::Bounded_side side_of(const Outline& other, const Outline& ring) {
    for (const Point& p : other)
      if (const auto side = side_of(p, ring); side != CGAL::ON_BOUNDARY) return side;
    for (std::size_t k = 0; k < other.size(); ++k)
      if (const auto side = side_of(CGAL::midpoint(other[k], other[(k + 1) % other.size()]), ring); side != CGAL::ON_BOUNDARY)
        return side;
    return CGAL::ON_BOUNDARY;
  }

  static bool edges_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
    return CGAL::orientation(a, b, c) * CGAL::orientation(a, b, d) < 0 &&
           CGAL::orientation(c, d, a) * CGAL::orientation(c, d, b) < 0;
  }

  static bool has_corner_on(const Outline& other, const Outline& ring, CGAL::Bounded_side side) {
    return std::any_of(other.begin(), other.end(), [&](const Point& p) { return side_of(p, ring) == side; });
  }

  [[nodiscard]] bool lies_in(std::size_t inner, std::size_t outer) const {
    return side_of(outlines_[inner], outlines_[outer]) == CGAL::ON_BOUNDED_SIDE &&
           !rings_cross(outlines_[inner], outlines_[outer]);
  }

  void place() {
    for (std::size_t k = 1; k < outlines_.size() && !true_outer; ++k)
      if (!are_same(outlines_[0], outlines_[k]) && lies_in(0, k)) true_outer = k;
    const std::size_t outer = true_outer.value_or(0);
    for (std::size_t k = 0; k < outlines_.size(); ++k)
      if (k != outer)
        is_misplaced[k] =
            are_same(outlines_[outer], outlines_[k]) ||
            (side_of(outlines_[k], outlines_[outer]) == CGAL::ON_UNBOUNDED_SIDE && !rings_cross(outlines_[outer], outlines_[k]));
    for (std::size_t k = 0; k < outlines_.size(); ++k)
      for (std::size_t j = 0; j < outlines_.size() && !is_misplaced[k]; ++j)
        if (j != k && j != outer && k != outer && !is_misplaced[j]) compare(j, k);
  }

  void compare(std::size_t j, std::size_t k) {
    if (are_same(outlines_[j], outlines_[k]))
      is_misplaced[std::max(j, k)] = true;
    else if (lies_in(k, j))
      is_misplaced[k] = true;
  }

  std::vector<Outline> outlines_;
};

using FlatRing = std::vector<Point2d>;
using FlatRings = std::vector<FlatRing>;

RingPlaces places(const FlatRings& rings) {
  std::vector<std::vector<Point3d>> level(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (const Point2d& p : rings[r]) level[r].push_back({p.x, p.y, 0.0});
  const std::vector<std::span<const Point3d>> spans(level.begin(), level.end());
  return places_of_rings(spans);
}

PairwiseRings::Outline outline_of(const FlatRing& ring) {
  PairwiseRings::Outline outline;
  for (const Point2d& p : ring) outline.emplace_back(p.x, p.y);
  return outline;
}

/// Random rings on a coarse lattice: corners coincide, edges overlap, rings touch, cross each other and themselves.
class RandomRings {
 public:
  explicit RandomRings(unsigned int seed) : random_(seed) {}

  std::size_t number(std::size_t low, std::size_t high) { return std::uniform_int_distribution<std::size_t>(low, high)(random_); }

  FlatRing ring(std::size_t corners, std::size_t lattice) {
    FlatRing ring;
    while (ring.size() < corners) {
      const Point2d p{static_cast<double>(number(0, lattice)), static_cast<double>(number(0, lattice))};
      if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
    }
    return ring;
  }

  FlatRing rectangle(std::size_t lattice) {
    const auto x = static_cast<double>(number(0, lattice)), y = static_cast<double>(number(0, lattice));
    const auto w = static_cast<double>(number(1, lattice)), h = static_cast<double>(number(1, lattice));
    FlatRing ring{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(number(0, 3)), ring.end());
    if (number(0, 1) == 1) std::reverse(ring.begin(), ring.end());
    return ring;
  }

  /// A star-shaped ring that does not cross itself.
  FlatRing star(std::size_t corners, Point2d centre, double radius) {
    FlatRing ring;
    std::uniform_real_distribution<double> share(0.5, 1.0);
    for (std::size_t k = 0; k < corners; ++k) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners),
                   r = radius * share(random_);
      ring.push_back({centre.x + r * std::cos(turn), centre.y + r * std::sin(turn)});
    }
    return ring;
  }

 private:
  std::mt19937 random_;
};

TEST(ManyRings, SidesAreThoseOfEachEdge) {
  for (unsigned int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomRings random(seed);
    const FlatRing ring = seed % 3 == 0 ? random.star(random.number(3, 200), {5, 5}, 5) : random.ring(random.number(3, 60), 10);
    const PairwiseRings::Outline outline = outline_of(ring);
    RingSides sides(ring);
    for (int k = 0; k < 100; ++k) {
      const Point2d p = 0.5 * random.ring(1, 22)[0] - Point2d{0.5, 0.5};
      const CGAL::Bounded_side expected = PairwiseRings::side_of({p.x, p.y}, outline);
      const RingSide side = sides.side_of(p);
      EXPECT_EQ(side == RingSide::inside, expected == CGAL::ON_BOUNDED_SIDE) << p.x << ' ' << p.y;
      EXPECT_EQ(side == RingSide::on_ring, expected == CGAL::ON_BOUNDARY) << p.x << ' ' << p.y;
    }
  }
}

TEST(ManyRings, CrossWhereEdgesDo) {
  std::size_t crossings = 0, others = 0;
  for (unsigned int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    RandomRings random(seed);
    FlatRing a = random.star(random.number(80, 150), {0, 0}, 10), b = random.star(random.number(80, 150), {0, 0}, 4.9);
    if (seed % 4 == 1) b = random.star(100, {0.3 * static_cast<double>(seed % 50), 1}, 5);
    if (seed % 4 == 2) a = random.ring(90, 30), b = random.ring(70, 30);
    if (seed % 4 == 3) b = {a[0], a[1], {0, 0}}, b.resize(80, Point2d{0.1, 0.1});  // touches from inside
    RingSides one(a), other(b);
    const bool expected = PairwiseRings::rings_cross(outline_of(a), outline_of(b));
    (expected ? crossings : others) += 1;
    EXPECT_EQ(one.crosses(other), expected);
    EXPECT_EQ(other.crosses(one), expected);
  }
  EXPECT_GT(crossings, 100U);
  EXPECT_GT(others, 100U);
}

/// A line that goes up and down `teeth` times, and back to its beginning outside.
FlatRing comb(int teeth, double low, double high) {
  FlatRing ring;
  for (int k = 0; k < teeth; ++k)
    ring.insert(ring.end(), {{1.0 * k, k % 2 == 0 ? low : high}, {1.0 * k + 0.4, k % 2 == 0 ? high : low}});
  ring.push_back({1.0 * teeth, high + 1.0});
  ring.push_back({-1.0, high + 1.0});
  return ring;
}

TEST(ManyRings, CrossWithoutACornerOfOneInTheOther) {
  const FlatRing standing = comb(80, -10, 110);
  FlatRing lying = comb(80, -10, 110), beside;
  for (Point2d& p : lying) p = {p.y, p.x};
  for (const Point2d& p : comb(80, -10, 50)) beside.push_back({p.x + 200.0, p.y});
  RingSides one(standing), other(lying), third(beside);
  ASSERT_TRUE(PairwiseRings::rings_cross(outline_of(standing), outline_of(lying)));
  EXPECT_TRUE(one.crosses(other));
  EXPECT_FALSE(one.crosses(third));
  std::vector<RisingEdge> edges, others;
  std::vector<Point2d> borders;
  for (int k = 0; k < 200; ++k) {
    edges.push_back(rising({1.0 * k, 0}, {1.0 * k + 5.0, 100}));
    others.push_back(rising({1.0 * k + 0.5, 0}, {1.0 * k + 5.5, 100}));
  }
  for (const auto* some : {&edges, &others})
    for (const RisingEdge& edge : *some) borders.insert(borders.end(), {edge.low, edge.high});
  const RisingEdge across = rising(borders[0], borders[5]);
  const SlabTree tree(edges, borders);
  for (const RisingEdge& edge : others) EXPECT_FALSE(tree.crosses(edge));
  for (std::size_t k = 0; k + 1 < 100; ++k) EXPECT_TRUE(tree.crosses(rising(others[k].low, others[k + 1].high))) << k;
  EXPECT_EQ(tree.crosses(across),
            std::any_of(edges.begin(), edges.end(), [&](const RisingEdge& e) { return edges_cross(e, across); }));
}

TEST(ManyRings, ArePlacedAsByPairs) {
  std::size_t misplaced = 0, exchanged = 0;
  for (unsigned int seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    RandomRings random(seed);
    FlatRings rings{random.rectangle(12)};
    for (std::size_t k = random.number(1, 30); k > 0; --k)
      rings.push_back(random.number(0, 2) == 0 ? random.ring(random.number(3, 8), 12) : random.rectangle(8));
    if (seed % 5 == 0) rings.push_back(rings[random.number(0, rings.size() - 1)]);
    if (seed % 7 == 0) rings.insert(rings.begin() + 1, random.star(70, {6, 6}, 6));
    const PairwiseRings expected(rings);
    const RingPlaces found = places(rings);
    EXPECT_EQ(found.true_outer, expected.true_outer);
    std::vector<bool> is_misplaced(rings.size(), false);
    for (const MisplacedHole& hole : found.misplaced) is_misplaced[hole.ring] = true;
    EXPECT_EQ(is_misplaced, expected.is_misplaced);
    misplaced += found.misplaced.size();
    exchanged += found.true_outer ? 1 : 0;
  }
  EXPECT_GT(misplaced, 1000U);
  EXPECT_GT(exchanged, 50U);
}

TEST(ManyRings, AreTheSameWhereverTheyBegin) {
  for (unsigned int seed = 0; seed < 500; ++seed) {
    RandomRings random(seed);
    const FlatRing ring = random.ring(random.number(3, 9), 1);
    for (std::size_t turn = 0; turn < ring.size(); ++turn) {
      FlatRing turned = ring;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
      EXPECT_TRUE(is_rotation_of(ring, turned)) << seed;
      turned[0].x += 2.0;
      EXPECT_FALSE(is_rotation_of(ring, turned)) << seed;
    }
  }
}

std::uint64_t steps_of_placing(const FlatRings& rings) {
  const CountedSteps steps;
  (void)places(rings);
  return steps.count();
}

/// Eight times the corners take 64 times as many steps if each is compared with each, and some 10 times if they are sorted.
template <class MakeRings>
void expect_no_square(const MakeRings& make, std::size_t small) {
  const std::uint64_t of_few = steps_of_placing(make(small)), of_many = steps_of_placing(make(8 * small));
  EXPECT_GT(of_few, small) << "nothing is counted";
  EXPECT_LT(of_many, 16 * of_few);
}

FlatRing square(double x, double y, double edge) { return {{x, y}, {x + edge, y}, {x + edge, y + edge}, {x, y + edge}}; }

FlatRing circle(std::size_t corners, Point2d centre, double radius) {
  FlatRing ring;
  for (std::size_t k = 0; k < corners; ++k) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    ring.push_back({centre.x + radius * std::cos(turn), centre.y + radius * std::sin(turn)});
  }
  return ring;
}

TEST(ManyRings, TakeNoSquareOfTheHoles) {
  expect_no_square(
      [](std::size_t count) {
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
        FlatRings rings{square(-1, -1, 3.0 * static_cast<double>(side))};
        for (std::size_t k = 0; k < count; ++k)
          rings.push_back(square(2.0 * static_cast<double>(k % side), 2.0 * static_cast<double>(k / side), 1));
        return rings;
      },
      6000);
}

TEST(ManyRings, TakeNoSquareOfTheHolesInARoundOuterRing) {
  expect_no_square(
      [](std::size_t count) {
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
        FlatRings rings{
            circle(4 * count, {static_cast<double>(side), static_cast<double>(side)}, 1.2 * static_cast<double>(side))};
        for (std::size_t k = 0; k < count; ++k)
          rings.push_back(square(2.0 * static_cast<double>(k % side), 2.0 * static_cast<double>(k / side), 1));
        return rings;
      },
      2000);
}

TEST(ManyRings, TakeNoSquareOfTheCornersOfAHole) {
  expect_no_square([](std::size_t count) { return FlatRings{circle(count, {0, 0}, 9), circle(count, {0, 0}, 8)}; }, 8000);
  // One within the other: whether they cross is asked of all their edges
  expect_no_square(
      [](std::size_t n) {
        return FlatRings{circle(9, {0, 0}, 9), circle(n, {0, 0}, 8), circle(n, {0, 0}, 7)};
      },
      4000);
}

TEST(ManyRings, TakeNoSquareOfRingsThatRepeatThemselves) {
  expect_no_square(
      [](std::size_t count) {
        FlatRing teeth{{0, 0}};
        for (std::size_t k = 0; k < count; ++k) teeth.insert(teeth.end(), {{5, 1}, {5, 2}});
        FlatRing other = teeth;
        other[1] = {5, 2};
        other[2] = {5, 1};
        other.push_back({0, 1});
        teeth.push_back({0, 1});
        return FlatRings{square(-9, -9, 30), teeth, other};
      },
      2000);
}

TEST(ManyRings, ThatLieAcrossEachOtherAreGivenUp) {
  FlatRings rings{square(-10, -10, 40'000)};
  // Slivers from corner to corner: none crosses another, but the boxes of all meet
  for (int k = 0; k < 12'000; ++k) rings.push_back({{1.0 * k, 0}, {10'000 + 1.0 * k, 10'000}, {10'000 + 1.0 * k, 9'999.5}});
  const RingPlaces found = places(rings);
  ASSERT_FALSE(found.misplaced.empty());
  EXPECT_LT(found.misplaced.size(), rings.size() - 1);
  for (const MisplacedHole& hole : found.misplaced) EXPECT_NE(hole.reason.find("so many rings"), std::string_view::npos);
}

}  // namespace
}  // namespace farlod::tiles::test
