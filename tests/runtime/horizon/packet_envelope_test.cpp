// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "horizon/kernels.hpp"
#include "horizon/wedge_envelope.hpp"
#include "horizon/wedge_kernels.hpp"
#include "tests/runtime/horizon/random_places.hpp"

// Bounds of a packet, in floats, against the envelope of all edges in each wedge, in doubles.

namespace farlod {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
/// Floats of coordinates below 128 m around receivers within 30 m, of edges that are some metres away.
constexpr double float_error = 1e-5;

struct EnvelopeCase {
  const char* name;
  std::size_t azimuths;
  SkyWeight weight;
  std::vector<Point3f> normals;  ///< of the receivers, in turn
};
void PrintTo(const EnvelopeCase& c, std::ostream* out) { *out << c.name; }

/// Sixteen receivers among edges, each of which hides all that is below it.
class PacketEnvelopes : public testing::TestWithParam<EnvelopeCase> {
 protected:
  PacketEnvelopes() {
    for (std::size_t n = 0; n < ReceiverPacket::lanes; ++n)
      receivers_.add({n, random_.place(12.0, 0.0, 6.0), GetParam().normals[n % GetParam().normals.size()]});
    std::vector<HorizonEdge> edges;
    for (const double reach_m : {40.0, 100.0})
      for (int n = 0; n < 25; ++n) {
        // Short and long ones, as on roofs: some share an end
        const Point3f a = n % 3 == 0 || edges.empty() ? random_.place(reach_m, 3.0, 30.0) : edges.back().b;
        const float length = random_.between(0.1, 20.0);
        edges.push_back({a, a + length * random_.direction_at(0.3)});
      }
    draw(edges);
  }

  void draw(std::vector<HorizonEdge>& edges) {
    for (HorizonEdge& e : edges) e.adjacent = {AdjacentSlopes::straight_down, AdjacentSlopes::straight_down};
    edges_ = silhouettes_of(edges);
    edges_.number_from(0);
    ends_of_numbers_ = BorderEnds(std::array<const SilhouetteEdges*, 1>{&edges_});
    ends_.find(numbers_of(list_), ends_of_numbers_);
    horizon_ = PacketHorizon(azimuths_, PacketHorizon::Edges::tracked);
    horizon_.raise(edges_, receivers_);
    envelope_.see(horizon_, receivers_);
    tops_ = rows_of(0.0F);
    envelope_.raise_to_ends(ends_.batches(), tops_);
  }

  [[nodiscard]] PacketEnvelope::Occluders occluders() const { return {drawn_, tops_}; }
  /// The sky of a wedge above all edges, and above a level edge across it whose ends have this slope.
  [[nodiscard]] double exact_sky(std::size_t k, std::size_t l, double slope) {
    const Wedge& w = envelope_.wedge(k);
    const Point3d p{receivers_.x[l], receivers_.y[l], receivers_.z[l]}, d{w.from.x, w.from.y, 0.0};
    const auto relative = [&](const Point3f& end) { return Point3d{end.x, end.y, end.z} - p; };
    exact_.begin(w, normalized(Point3d{receivers_.normal_x[l], receivers_.normal_y[l], receivers_.normal_z[l]}),
                 GetParam().weight);
    for (std::size_t n = 0; n < edges_.size(); ++n) exact_.add(relative(edges_.at(n).a), relative(edges_.at(n).b));
    const double widest = std::sqrt(1.0 + w.tangent * w.tangent);
    if (slope > 0.0)
      exact_.add(d + Point3d{0.0, 0.0, slope}, d + w.tangent * Point3d{-d.y, d.x, 0.0} + Point3d{0.0, 0.0, slope * widest});
    return exact_.sky().sky;
  }
  [[nodiscard]] double exact_share(std::size_t l, double slope) {
    double sum = 0.0;
    for (std::size_t k = 0; k < envelope_.size(); ++k) sum += exact_sky(k, l, slope);
    return sum / turn_rad;
  }
  [[nodiscard]] PacketEnvelope::Rows rows_of(float slope) const {
    PacketEnvelope::Row row;
    row.fill(slope);
    return PacketEnvelope::Rows(azimuths_.size(), row);
  }

  RandomPlaces random_;
  const AzimuthSampling azimuths_ = AzimuthSampling::even(GetParam().azimuths, GridRotation(Angle::degrees(20.0)));
  ReceiverPacket receivers_;
  SilhouetteEdges edges_;
  const std::array<const SilhouetteEdges*, 1> list_{&edges_};
  BorderEnds ends_of_numbers_;
  EndPlaces ends_;
  PacketHorizon horizon_{azimuths_, PacketHorizon::Edges::tracked};
  const std::array<const DrawnEdges*, 1> drawn_{&horizon_.drawn()};
  PacketEnvelope envelope_{azimuths_, GetParam().weight, ends_of_numbers_};
  PacketEnvelope::Rows tops_;
  WedgeEnvelope exact_;
};

TEST_P(PacketEnvelopes, BoundTheSkyAboveAllEdges) {
  const PacketEnvelope::Rows nothing = rows_of(0.0F);
  for (const double wanted : {1.0, 0.005, 0.0}) {
    const PacketEnvelope::Bounds bounds = envelope_.bounds(occluders(), {nothing, nothing}, wanted);
    for (std::size_t l = 0; l < receivers_.count; ++l) {
      const double exact = exact_share(l, 0.0);
      EXPECT_LE(bounds.low[l], exact + float_error) << l << ", wanted " << wanted;
      EXPECT_GE(bounds.high[l], exact - float_error) << l << ", wanted " << wanted;
      // What is lower than the horizons of all receivers is not looked at
      constexpr double dents = 1e-3;
      EXPECT_LE(bounds.high[l] - bounds.low[l], wanted + dents) << l;
    }
  }
}

TEST_P(PacketEnvelopes, BoundTheSkyOfWedgesInWhichAnEdgeDips) {
  // Borders of gables, steep and near: they fall below the level, and below the planes of tilted receivers, where others begin
  envelope_.keep_terms(true);
  const PacketEnvelope::Rows nothing = rows_of(0.0F);
  for (int scene = 0; scene < 10; ++scene) {
    std::vector<HorizonEdge> gables;
    for (int n = 0; n < 12; ++n) {
      const Point3f ridge = random_.place(25.0, 2.0, 9.0);
      gables.push_back({ridge, ridge + random_.between(2.0, 12.0) * random_.direction_at(-0.8)});
    }
    draw(gables);
    // The horizons of azimuths between which edges dip have errors of floats, too
    constexpr double term_error = 2e-6;
    const PacketEnvelope::Bounds bounds = envelope_.bounds(occluders(), {nothing, nothing}, 1.0);
    for (std::size_t l = 0; l < receivers_.count; ++l) {
      EXPECT_LE(bounds.low[l], bounds.high[l]) << l;
      for (std::size_t k = 0; k < envelope_.size(); ++k) {
        const double exact = envelope_.term_of(exact_sky(k, l, 0.0), k, receivers_, l);
        EXPECT_LE(envelope_.terms().low[k][l], exact + term_error) << l << ", wedge " << k;
        EXPECT_GE(envelope_.terms().high[k][l], exact - term_error) << l << ", wedge " << k;
      }
    }
  }
}

TEST_P(PacketEnvelopes, BoundWhatElseMayHide) {
  constexpr float least = 0.15F, most = 0.5F;
  const PacketEnvelope::Rows least_rows = rows_of(least), most_rows = rows_of(most);
  const PacketEnvelope::Bounds bounds = envelope_.bounds(occluders(), {least_rows, most_rows}, 0.005);
  for (std::size_t l = 0; l < receivers_.count; ++l) {
    // A level edge is steepest in the middle of a wedge
    const double ends = most * std::cos(0.5 * turn_rad / static_cast<double>(azimuths_.size()));
    EXPECT_LE(bounds.low[l], exact_share(l, ends) + float_error) << l;
    EXPECT_GE(bounds.high[l], exact_share(l, least) - float_error) << l;
  }
}

TEST_P(PacketEnvelopes, BoundWhatIsSeenBelowBorders) {
  constexpr float border = 0.6F;
  const PacketEnvelope::Rows borders = rows_of(border);
  std::vector<std::uint8_t> reached(azimuths_.size(), 1);
  reached[3] = 0;
  const PacketEnvelope::Sums gaps = envelope_.most_in_gaps(tops_, {borders, reached});
  for (std::size_t l = 0; l < receivers_.count; ++l) {
    double between = 0.0;
    // A level edge lies above the slope of its ends: less of the sky is below the slope
    const double lower = border * std::cos(turn_rad / static_cast<double>(azimuths_.size()));
    for (std::size_t k = 0; k < envelope_.size(); ++k)
      if (reached[k] != 0) between += (exact_sky(k, l, 0.0) - exact_sky(k, l, lower)) / turn_rad;
    EXPECT_GE(gaps[l], between - float_error) << l;
    EXPECT_LE(gaps[l], 1.0) << l;
  }
}

TEST_P(PacketEnvelopes, BoundWhatIsSeenBelowBordersBetweenHorizons) {
  // No border is given: those that are no higher than a receiver's horizons at both azimuths are nowhere told
  const std::vector<std::uint8_t> reached(azimuths_.size(), 1);
  const PacketEnvelope::Sums gaps = envelope_.most_in_gaps(tops_, {rows_of(0.0F), reached});
  for (std::size_t l = 0; l < receivers_.count; ++l) {
    double between = 0.0;
    for (std::size_t k = 0; k < envelope_.size(); ++k) {
      const double border = std::min(horizon_.row(k)[l], horizon_.row(k + 1 < envelope_.size() ? k + 1 : 0)[l]);
      const double lower = border * std::cos(turn_rad / static_cast<double>(azimuths_.size()));
      between += (exact_sky(k, l, 0.0) - exact_sky(k, l, lower)) / turn_rad;
    }
    EXPECT_GE(gaps[l], between - float_error) << l;
  }
}

TEST_P(PacketEnvelopes, AreTheSumsOfTheirTerms) {
  const PacketEnvelope::Rows nothing = rows_of(0.0F);
  envelope_.keep_terms(true);
  const PacketEnvelope::Bounds bounds = envelope_.bounds(occluders(), {nothing, nothing}, 0.005);
  for (std::size_t l = 0; l < receivers_.count; ++l) {
    double low = 0.0, high = 0.0, exact = 0.0;
    for (std::size_t k = 0; k < envelope_.size(); ++k) {
      low += static_cast<double>(envelope_.terms().low[k][l]) / turn_rad;
      high += static_cast<double>(envelope_.terms().high[k][l]) / turn_rad;
      exact += envelope_.term_of(exact_sky(k, l, 0.0), k, receivers_, l) / turn_rad;
    }
    EXPECT_NEAR(low, bounds.low[l], float_error) << l;
    EXPECT_NEAR(high, bounds.high[l], float_error) << l;
    EXPECT_NEAR(exact, exact_share(l, 0.0), float_error) << l;
  }
}

/// The slope at which a receiver sees an edge at an azimuth, if it does.
std::optional<double> slope_of(const HorizonEdge& e, const Point3d& eye, const Point2d& d) {
  const Point3d p = Point3d{e.a.x, e.a.y, e.a.z} - eye, q = Point3d{e.b.x, e.b.y, e.b.z} - eye;
  const double cross = p.x * q.y - p.y * q.x, u = (p.x * d.y - p.y * d.x) / cross, v = (d.x * q.y - d.y * q.x) / cross;
  return u >= 0.0 && v >= 0.0 ? std::optional(p.z * v + q.z * u) : std::nullopt;
}

TEST_P(PacketEnvelopes, ListTheEdgesThatRiseInAWedge) {
  EdgesInWedges in_wedges(azimuths_, ends_of_numbers_);
  in_wedges.begin(drawn_, envelope_.least_horizons());
  std::vector<std::uint8_t> marks(envelope_.size(), 0);
  wedge_end_kernels().mark_reached(drawn_[0]->spans(), drawn_[0]->size(), envelope_.least_horizons(),
                                   static_cast<std::uint32_t>(marks.size()), marks.data());
  DrawnEdges rising;
  find_rising(drawn_, envelope_.least_horizons(), envelope_.size(), rising);
  std::size_t listed = 0;
  for (std::size_t k = 0; k < envelope_.size(); ++k) {
    const EdgesInWedges::InWedge& edges = in_wedges.reaching(k);
    EXPECT_EQ(marks[k] != 0, edges.size > 0) << k;
    const auto is_listed = [&](const HorizonEdge& e) {
      for (std::size_t n = 0; n < edges.size; ++n)
        if (edges.edges[n / 16].ax[n % 16] == e.a.x && edges.edges[n / 16].by[n % 16] == e.b.y) return true;
      return false;
    };
    for (std::size_t n = 0; n < edges_.size(); ++n) {
      double highest = 0.0;
      for (std::size_t l = 0; l < receivers_.count; ++l)
        for (const double share : {0.01, 0.25, 0.5, 0.75, 0.99}) {
          const Wedge& w = envelope_.wedge(k);
          const Point2d d{w.from.x - share * w.tangent * w.from.y, w.from.y + share * w.tangent * w.from.x};
          const auto slope = slope_of(edges_.at(n), {receivers_.x[l], receivers_.y[l], receivers_.z[l]}, d);
          highest = std::max(highest, slope.value_or(0.0) / std::sqrt(1.0 + share * share * w.tangent * w.tangent));
        }
      if (highest <= 1.0001 * static_cast<double>(envelope_.least_horizons()[k])) continue;
      EXPECT_TRUE(is_listed(edges_.at(n))) << "edge " << n << ", wedge " << k;
      EXPECT_NE(std::ranges::find(rising.numbers(), n), rising.numbers().end());
      ++listed;
    }
  }
  EXPECT_GT(listed, envelope_.size());
}

TEST_P(PacketEnvelopes, HaveALidThatTheEdgesHide) {
  EdgesInWedges in_wedges(azimuths_, ends_of_numbers_);
  in_wedges.begin(drawn_, envelope_.least_horizons());
  std::size_t lids = 0;
  for (std::size_t k = 0; k < envelope_.size(); ++k) {
    const EdgesInWedges::InWedge& edges = in_wedges.reaching(k);
    const Wedge& w = envelope_.wedge(k);
    for (std::size_t l = 0; l < receivers_.count; ++l) {
      const WedgeEye eye{receivers_.x[l],
                         receivers_.y[l],
                         receivers_.z[l],
                         static_cast<float>(w.from.x),
                         static_cast<float>(w.from.y),
                         static_cast<float>(w.tangent)};
      float lid = 0.0F;
      for (const WedgeEdges& some : std::span(edges.edges).first((edges.size + 15) / 16))
        lid = std::max(lid, wedge_pair_kernels().find_lid(some, eye));
      lids += lid > 0.0F ? 1U : 0U;
      // The sky above all edges is that above these and a straight edge that is nowhere higher than the lid
      const double slope = 0.9999 * static_cast<double>(lid) / std::sqrt(1.0 + w.tangent * w.tangent);
      EXPECT_NEAR(exact_sky(k, l, slope), exact_sky(k, l, 0.0), 1e-12) << l << ", wedge " << k;
    }
  }
  EXPECT_GE(lids, envelope_.size());
}

const std::vector<Point3f> looking_up{{0, 0, 1}}, looking_almost_up{{2.4e-4F, 0, 1}},
    looking_anywhere{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -0.8F, 0.6F}, {-0.8F, 0.6F, 0}, {0, 1, 0}},
    looking_down{{0.8F, 0, -0.6F}, {0, 0.6F, -0.8F}};
INSTANTIATE_TEST_SUITE_P(Receivers, PacketEnvelopes,
                         testing::Values(EnvelopeCase{"Up8", 8, SkyWeight::cosine, looking_up},
                                         EnvelopeCase{"Up64", 64, SkyWeight::cosine, looking_up},
                                         EnvelopeCase{"Up320", 320, SkyWeight::cosine, looking_up},
                                         EnvelopeCase{"AlmostUp320", 320, SkyWeight::cosine, looking_almost_up},
                                         EnvelopeCase{"Any8", 8, SkyWeight::cosine, looking_anywhere},
                                         EnvelopeCase{"Any320", 320, SkyWeight::cosine, looking_anywhere},
                                         EnvelopeCase{"Down320", 320, SkyWeight::cosine, looking_down},
                                         EnvelopeCase{"Solid64", 64, SkyWeight::solid_angle, looking_anywhere},
                                         EnvelopeCase{"SolidDown64", 64, SkyWeight::solid_angle, looking_down}),
                         [](const auto& test) { return test.param.name; });

/// What the kernels of one target make of a packet.
struct Made {
  std::vector<float> lower, minima, tops, gaps, raised;
  std::vector<std::int32_t> numbers;
  std::vector<std::uint16_t> others;
  SimpleSums sums;
  PairsAnswer pairs;
  GapsOfPairs in_gaps;
  float lid;
};

class WedgeTargets : public PacketEnvelopes {
 protected:
  [[nodiscard]] Made made_by(const KernelTarget& target) const {
    const std::size_t count = azimuths_.size(), lanes = ReceiverPacket::lanes;
    Made m{std::vector<float>(count * lanes),
           std::vector<float>(count * 16),
           std::vector<float>(count * lanes),
           std::vector<float>(count * lanes),
           std::vector<float>(count * lanes),
           std::vector<std::int32_t>(count * lanes),
           std::vector<std::uint16_t>(count),
           {},
           {},
           {},
           0.0F};
    const WedgeShape w{0.1F, std::cos(0.1F), std::sin(0.1F), std::tan(0.1F), 1.01F};
    target.wedge_sky->raise_to_planes(horizon_.slopes(), horizon_.numbers(), receivers_, azimuths_.view(), m.raised.data(),
                                      m.numbers.data());
    target.wedge_end->find_lower(m.raised.data(), count, {m.lower.data(), m.minima.data()});
    target.wedge_end->raise_tops(ends_.batches(), receivers_, bounds_of(receivers_).box, azimuths_.view(),
                                 {m.lower.data(), m.minima.data()}, m.tops.data());
    const PacketEnvelope::Rows hiding = rows_of(0.2F);
    const std::vector<std::uint8_t> asked(count, 1);
    target.wedge_sky->find_simple_gaps({m.raised.data(), m.numbers.data()}, {hiding.front().data(), asked.data()}, receivers_,
                                       azimuths_.view(), w, WedgeWeight::cosine, m.others.data(), m.tops.data(), m.gaps.data());
    target.wedge_sky->sum_simple({m.raised.data(), m.numbers.data()}, {hiding.front().data(), hiding.front().data()}, receivers_,
                                 azimuths_.view(), w, WedgeWeight::solid_angle, m.others.data(), m.tops.data(), m.sums);
    target.wedge_pair->bound_pairs(pairs(), w, WedgeWeight::cosine, m.pairs);
    alignas(64) std::array<float, 16> borders;
    borders.fill(0.9F);
    target.wedge_pair->bound_gaps(pairs(), borders.data(), w, WedgeWeight::cosine, m.in_gaps);
    m.lid = lid_of(target);
    return m;
  }
  /// Over a wedge in which an edge stands across.
  [[nodiscard]] static float lid_of(const KernelTarget& target) {
    WedgeEdges edges{};
    for (std::size_t n = 0; n < 16; ++n) {
      edges.ax[n] = edges.bx[n] = 20.0F + static_cast<float>(n);
      edges.ay[n] = -5.0F, edges.by[n] = 9.0F;
      edges.az[n] = 3.0F, edges.bz[n] = 7.0F + static_cast<float>(n);
    }
    return target.wedge_pair->find_lid(edges, {0.3F, 0.1F, 1.5F, 1.0F, 0.0F, 0.1F});
  }
  [[nodiscard]] WedgePairs pairs() const {
    WedgePairs p{};
    for (std::size_t n = 0; n < 16; ++n) {
      const HorizonEdge first = edges_.at(n), last = edges_.at(n + 1);
      p.first.px[n] = first.a.x, p.first.py[n] = first.a.y, p.first.pz[n] = first.a.z;
      p.first.qx[n] = first.b.x, p.first.qy[n] = first.b.y, p.first.qz[n] = first.b.z;
      p.last.px[n] = last.a.x, p.last.py[n] = last.a.y, p.last.pz[n] = last.a.z;
      p.last.qx[n] = last.b.x, p.last.qy[n] = last.b.y, p.last.qz[n] = last.b.z;
      p.cosine[n] = azimuths_.cosine()[n], p.sine[n] = azimuths_.sine()[n];
      p.from[n] = p.to[n] = 0.3F, p.top[n] = 0.7F, p.least[n] = 0.1F;
    }
    p.normal_x = 0.6F, p.normal_z = 0.8F;
    return p;
  }
};

TEST_P(WedgeTargets, GiveTheSameBits) {
  const Made baseline = made_by(runnable_kernels().back());
  EXPECT_GT(*std::max_element(baseline.tops.begin(), baseline.tops.end()), 0.0F);
  EXPECT_GT(*std::max_element(std::begin(baseline.in_gaps.most), std::end(baseline.in_gaps.most)), 0.0F);
  EXPECT_GT(baseline.lid, 0.0F);
  for (const KernelTarget& target : runnable_kernels()) {
    const Made m = made_by(target);
    EXPECT_EQ(m.lower, baseline.lower) << target.name;
    EXPECT_EQ(m.minima, baseline.minima) << target.name;
    EXPECT_EQ(m.tops, baseline.tops) << target.name;
    EXPECT_EQ(m.gaps, baseline.gaps) << target.name;
    EXPECT_EQ(m.others, baseline.others) << target.name;
    EXPECT_TRUE(std::ranges::equal(m.in_gaps.most, baseline.in_gaps.most)) << target.name;
    EXPECT_TRUE(std::ranges::equal(m.in_gaps.lid, baseline.in_gaps.lid)) << target.name;
    EXPECT_EQ(m.lid, baseline.lid) << target.name;
    EXPECT_EQ(std::memcmp(m.sums.low, baseline.sums.low, sizeof m.sums.low), 0) << target.name;
    EXPECT_EQ(std::memcmp(m.sums.high, baseline.sums.high, sizeof m.sums.high), 0) << target.name;
    EXPECT_EQ(std::memcmp(&m.pairs, &baseline.pairs, sizeof m.pairs), 0) << target.name;
  }
}
INSTANTIATE_TEST_SUITE_P(Kernels, WedgeTargets, testing::Values(EnvelopeCase{"Any96", 96, SkyWeight::cosine, looking_anywhere}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlod
