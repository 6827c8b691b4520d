// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "horizon/packet_envelope.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/expects.hpp"
#include "horizon/kernels.hpp"

namespace farlod {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;

WedgeShape shape_of(std::size_t wedges) {
  const double angle = turn_rad / static_cast<double>(wedges);
  constexpr double rounding = 1e-6;
  return {static_cast<float>(angle), static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
          static_cast<float>(std::tan(angle)), static_cast<float>((1.0 + rounding) / std::cos(0.5 * angle))};
}

Wedge wedge_between(Point2d d, Point2d e) {
  const double tangent = (d.x * e.y - d.y * e.x) / (d.x * e.x + d.y * e.y);
  return {(1.0 / std::sqrt(d.x * d.x + d.y * d.y)) * d, tangent};
}

Point3d normal_of(const ReceiverPacket& r, std::size_t lane) { return {r.normal_x[lane], r.normal_y[lane], r.normal_z[lane]}; }

}  // namespace

PacketEnvelope::PacketEnvelope(const AzimuthSampling& azimuths, SkyWeight weight, const BorderEnds& ends)
    : azimuths_(azimuths),
      weight_(weight),
      ends_(ends),
      shape_(shape_of(azimuths.size())),
      edges_(azimuths, ends),
      none_(azimuths.size()),
      own_slopes_(azimuths.size()),
      own_numbers_(azimuths.size() * packet_lanes),
      lower_(azimuths.size()),
      borders_(azimuths.size()),
      minima_(azimuths.size() * static_cast<std::size_t>(std::bit_width(azimuths.size()))),
      others_(azimuths.size()),
      doubtful_(azimuths.size() * packet_lanes) {
  FARLOD_EXPECTS(azimuths.size() >= least_azimuths);
  for (Rows* rows : {&terms_.low, &terms_.high, &terms_.gaps, &lids_}) rows->resize(azimuths.size());
  const auto direction = [&](std::size_t k) { return Point2d{azimuths.cosine()[k], azimuths.sine()[k]}; };
  for (std::size_t k = 0; k < azimuths.size(); ++k)
    wedges_.push_back(wedge_between(direction(k), direction(k + 1 < azimuths.size() ? k + 1 : 0)));
}

void PacketEnvelope::see(const PacketHorizon& horizon, const ReceiverPacket& r) {
  horizon_ = &horizon;
  receivers_ = &r;
  wedge_weight_ = weight_ == SkyWeight::solid_angle ? WedgeWeight::solid_angle
                  : r.all_look_straight_up()        ? WedgeWeight::cosine_up
                                                    : WedgeWeight::cosine;
  slopes_ = horizon.slopes();
  numbers_ = horizon.numbers();
  if (wedge_weight_ != WedgeWeight::cosine_up) {
    wedge_sky_kernels().raise_to_planes(slopes_, numbers_, r, azimuths_.view(), own_slopes_.front().data(), own_numbers_.data());
    slopes_ = own_slopes_.front().data();
    numbers_ = own_numbers_.data();
  }
  wedge_end_kernels().find_lower(slopes_, wedges_.size(), lower_horizons());
}

void PacketEnvelope::raise_to_ends(std::span<const EndBatch> ends, std::span<Row> tops) {
  FARLOD_EXPECTS(tops.size() == size());
  wedge_end_kernels().raise_tops(ends, *receivers_, bounds_of(*receivers_).box, azimuths_.view(), lower_horizons(),
                                 tops.front().data());
}

PacketEnvelope::Eye PacketEnvelope::eye_of(std::span<const Row> tops, const Hiding& hiding, std::size_t l) const {
  const ReceiverPacket& r = *receivers_;
  return {tops, hiding, l, {r.x[l], r.y[l], r.z[l]}, normal_of(r, l)};
}

PacketEnvelope::Bounds PacketEnvelope::bounds(const Occluders& occluders, const Hiding& hiding, double wanted) {
  const ReceiverPacket& r = *receivers_;
  edges_.begin(occluders.edges, minima_.data());
  const SimpleSums simple = sum_simple(occluders.tops, hiding);
  list_doubtful_wedges(nullptr);
  Bounds bounds;
  for (std::size_t l = 0; l < r.count; ++l) {
    const Eye eye = eye_of(occluders.tops, hiding, l);
    const bool looks_down = eye.normal.z < 0.0;
    double low = looks_down ? 0.0 : simple.low[l], high = looks_down ? 0.0 : simple.high[l];
    find_doubts(eye);
    resolve_doubts(eye, high - low, wanted * turn_rad);
    for (std::size_t n = 0; n < doubtful(l).size(); ++n) {
      const Doubt d = doubt(l, n);
      low += static_cast<double>(d.pairs.low[d.n]);
      high += static_cast<double>(d.pairs.high[d.n]);
    }
    if (has_terms_) keep_terms_of(l);
    bounds.low[l] = low / turn_rad;
    bounds.high[l] = high / turn_rad;
  }
  return bounds;
}

PacketEnvelope::Sums PacketEnvelope::most_in_gaps(std::span<const Row> tops, const Gaps& gaps) {
  wedge_sky_kernels().find_simple_gaps({slopes_, numbers_}, {gaps.borders.front().data(), gaps.reached.data()}, *receivers_,
                                       azimuths_.view(), shape_, wedge_weight_, others_.data(), tops.front().data(),
                                       terms_.gaps.front().data());
  list_doubtful_wedges(gaps.reached.data());
  const Hiding nothing{none_, none_};
  Sums sums{};
  for (std::size_t l = 0; l < receivers_->count; ++l) bound_gaps(eye_of(tops, nothing, l), gaps.borders);
  for (std::size_t k = 0; k < wedges_.size(); ++k) {
    if (gaps.reached[k] == 0) continue;
    for (std::size_t l = 0; l < packet_lanes; ++l) sums[l] += static_cast<double>(terms_.gaps[k][l]) / turn_rad;
  }
  return sums;
}

SimpleSums PacketEnvelope::sum_simple(std::span<const Row> tops, const Hiding& hiding) {
  SimpleSums sums;
  if (has_terms_) {
    sums.low_rows = terms_.low.front().data();
    sums.high_rows = terms_.high.front().data();
  }
  wedge_sky_kernels().sum_simple({slopes_, numbers_}, {hiding.least.front().data(), hiding.most.front().data()}, *receivers_,
                                 azimuths_.view(), shape_, wedge_weight_, others_.data(), tops.front().data(), sums);
  return sums;
}

void PacketEnvelope::list_doubtful_wedges(const std::uint8_t* asked) {
  const ReceiverPacket& r = *receivers_;
  doubtful_count_.fill(0);
  std::uint32_t look_down = 0;
  for (std::size_t l = 0; l < r.count; ++l) look_down |= r.normal_z[l] < 0.0F ? 1U << l : 0U;
  const std::uint32_t all = (1U << r.count) - 1U;
  for (std::uint32_t k = 0; k < wedges_.size(); ++k) {
    if (asked != nullptr && asked[k] == 0) continue;
    for (std::uint32_t bits = (others_[k] | look_down) & all; bits != 0; bits &= bits - 1) {
      const auto l = static_cast<std::size_t>(std::countr_zero(bits));
      doubtful_[l * wedges_.size() + doubtful_count_[l]++] = k;
    }
  }
}

// --- Doubts: first from the two edges that are highest at both azimuths
// -----------------------------------------------------------

template <class Answer>
void PacketEnvelope::visit_pairs(const Eye& eye, const Answer& answer) {
  const std::span<const std::uint32_t> wedges = doubtful(eye.lane);
  WedgePairs pairs{};
  pairs.normal_x = receivers_->normal_x[eye.lane];
  pairs.normal_y = receivers_->normal_y[eye.lane];
  pairs.normal_z = receivers_->normal_z[eye.lane];
  for (std::size_t first = 0; first < wedges.size(); first += packet_lanes) {
    const std::size_t count = std::min(packet_lanes, wedges.size() - first);
    for (std::size_t n = 0; n < count; ++n) put_pair(eye, wedges[first + n], n, pairs);
    answer(wedges.subspan(first, count), pairs);
  }
}

void PacketEnvelope::find_doubts(const Eye& eye) {
  pairs_.clear();
  visit_pairs(eye, [&](std::span<const std::uint32_t> wedges, const WedgePairs& pairs) {
    PairsAnswer& answer = pairs_.emplace_back();
    wedge_pair_kernels().bound_pairs(pairs, shape_, wedge_weight_, answer);
    answer.unknown |= beyond_pairs(eye, wedges);
  });
}

/// Where the back of a wall begins, and for who looks down.
std::uint32_t PacketEnvelope::beyond_pairs(const Eye& eye, std::span<const std::uint32_t> wedges) const {
  if (wedge_weight_ == WedgeWeight::cosine_up) return 0;
  if (eye.normal.z < 0.0) return ~0U;
  std::uint32_t bits = 0;
  for (std::size_t n = 0; n < wedges.size(); ++n) {
    const std::size_t k = wedges[n], l = eye.lane;
    if (number_at(k, l) == number_behind || number_at(next(k), l) == number_behind) bits |= 1U << n;
  }
  return bits;
}

void PacketEnvelope::bound_gaps(const Eye& eye, std::span<const Row> borders) {
  const std::size_t l = eye.lane;
  visit_pairs(eye, [&](std::span<const std::uint32_t> wedges, const WedgePairs& pairs) {
    alignas(64) std::array<float, packet_lanes> higher{};
    GapsOfPairs gaps;
    // Between edges, a lower border that is no higher than this receiver's horizons may show sky, too
    for (std::size_t n = 0; n < wedges.size(); ++n)
      higher[n] = std::max(borders[wedges[n]][l], lower_[wedges[n]][l] * shape_.widened);
    wedge_pair_kernels().bound_gaps(pairs, higher.data(), shape_, wedge_weight_, gaps);
    for (std::size_t n = 0; n < wedges.size(); ++n) {
      terms_.gaps[wedges[n]][l] = gaps.most[n];
      lids_[wedges[n]][l] = gaps.lid[n];
    }
  });
}

void PacketEnvelope::put_pair(const Eye& eye, std::size_t k, std::size_t n, WedgePairs& pairs) const {
  const std::size_t l = eye.lane, after = next(k);
  put_edge(eye, number_at(k, l), k, n, pairs.first);
  put_edge(eye, number_at(after, l), k, n, pairs.last);
  pairs.cosine[n] = static_cast<float>(wedges_[k].from.x);
  pairs.sine[n] = static_cast<float>(wedges_[k].from.y);
  pairs.from[n] = slope_at(k, l);
  pairs.to[n] = slope_at(after, l);
  pairs.top[n] = std::max(most(eye.tops, k, l), eye.hiding.most[k][l]);
  pairs.least[n] = eye.hiding.least[k][l];
}

void PacketEnvelope::put_edge(const Eye& eye, std::int32_t number, std::size_t k, std::size_t n, EdgesSeen& edges) const {
  if (number < 0) return put_plane(eye, number, k, n, edges);
  const auto end = 2 * static_cast<std::size_t>(number);
  const Point3f &a = ends_.end(end).p, &b = ends_.end(end + 1).p;
  edges.px[n] = a.x - eye.p.x;
  edges.py[n] = a.y - eye.p.y;
  edges.pz[n] = a.z - eye.p.z;
  edges.qx[n] = b.x - eye.p.x;
  edges.qy[n] = b.y - eye.p.y;
  edges.qz[n] = b.z - eye.p.z;
}

/// Level ground or the receiver's own plane, over all of the wedge.
void PacketEnvelope::put_plane(const Eye& eye, std::int32_t number, std::size_t k, std::size_t n, EdgesSeen& edges) const {
  const Point3d& normal = eye.normal;
  const Wedge& w = wedges_[k];
  const auto place = [&](double tau) {
    const double x = w.from.x - tau * w.from.y, y = w.from.y + tau * w.from.x;
    const double height = number == number_of_plane ? -(normal.x * x + normal.y * y) / normal.z : 0.0;
    return Point3f{static_cast<float>(x), static_cast<float>(y), static_cast<float>(height)};
  };
  const Point3f a = place(-w.tangent), b = place(2.0 * w.tangent);
  edges.px[n] = a.x;
  edges.py[n] = a.y;
  edges.pz[n] = a.z;
  edges.qx[n] = b.x;
  edges.qy[n] = b.y;
  edges.qz[n] = b.z;
}

// --- Then from all edges, in doubles: the widest first
// ----------------------------------------------------------------------------

void PacketEnvelope::resolve_doubts(const Eye& eye, double width, double wanted) {
  const std::size_t l = eye.lane, count = doubtful(l).size();
  for (std::size_t n = 0; n < count; ++n) {
    if (doubt(l, n).is_unknown()) resolve(eye, doubt(l, n));
    width += static_cast<double>(doubt(l, n).width());
  }
  if (width <= wanted) return;
  // Each is resolved once: the heap shrinks
  widest_.clear();
  for (std::size_t n = 0; n < count; ++n)
    if (!doubt(l, n).is_unknown() && doubt(l, n).width() > 0.0F) widest_.push_back({doubt(l, n).width(), n});
  const auto narrower = [](const WidthOfDoubt& a, const WidthOfDoubt& b) { return a.width < b.width; };
  std::make_heap(widest_.begin(), widest_.end(), narrower);
  for (auto end = widest_.end(); width > wanted && end != widest_.begin(); --end) {
    std::pop_heap(widest_.begin(), end, narrower);
    const WidthOfDoubt& widest = *(end - 1);
    resolve(eye, doubt(l, widest.n));
    width += static_cast<double>(doubt(l, widest.n).width()) - static_cast<double>(widest.width);
  }
}

void PacketEnvelope::resolve(const Eye& eye, const Doubt& d) {
  const std::size_t k = d.wedge, l = eye.lane;
  const EdgesInWedges::InWedge& edges = edges_.reaching(k);
  find_edges_above(wedge_eye(eye, d, edges), edges);
  const float hidden = std::max(eye.hiding.most[k][l], minima_[k]), lid = d.pairs.lid[d.n];
  if (!d.is_unknown() && above_.empty() && eye.hiding.least[k][l] <= lid && hidden <= lid)
    d.pairs.low[d.n] = d.pairs.high[d.n];  // nothing else rises above both
  else
    find_sky(eye, edges, d);
}

/// What a further edge must rise above: the envelope of a pair that is known, or else the edges that cross all of the wedge.
WedgeEye PacketEnvelope::wedge_eye(const Eye& eye, const Doubt& d, const EdgesInWedges::InWedge& edges) const {
  const Wedge& w = wedges_[d.wedge];
  const PairsAnswer& p = d.pairs;
  WedgeEye seen{
      eye.p.x, eye.p.y, eye.p.z, static_cast<float>(w.from.x), static_cast<float>(w.from.y), static_cast<float>(w.tangent)};
  if (d.is_unknown()) {
    float lid = eye.hiding.least[d.wedge][eye.lane];
    for (const WedgeEdges& some : std::span(edges.edges).first((edges.size + packet_lanes - 1) / packet_lanes))
      lid = std::max(lid, wedge_pair_kernels().find_lid(some, seen));
    // Less, by more than what floats round
    seen.first = seen.middle = seen.last = 0.9998F * lid - 2e-5F;
    return seen;
  }
  seen.turn = p.turn[d.n];
  seen.first = p.first[d.n];
  // Between edges that are apart anything may rise
  seen.middle = p.lid[d.n] > 0.0F ? std::min(p.before[d.n], p.after[d.n]) : -std::numeric_limits<float>::infinity();
  seen.last = p.last[d.n];
  return seen;
}

void PacketEnvelope::find_edges_above(const WedgeEye& seen, const EdgesInWedges::InWedge& edges) {
  above_.clear();
  for (std::size_t n = 0; n < edges.size; n += packet_lanes) {
    const std::size_t count = std::min(packet_lanes, edges.size - n);
    std::uint32_t bits = wedge_pair_kernels().find_above(edges.edges[n / packet_lanes], seen) & ((1U << count) - 1U);
    for (; bits != 0; bits &= bits - 1)
      above_.push_back(static_cast<std::uint32_t>(n) + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

void PacketEnvelope::find_sky(const Eye& eye, const EdgesInWedges::InWedge& edges, const Doubt& d) {
  const std::size_t k = d.wedge, l = eye.lane;
  const double widest = std::sqrt(1.0 + wedges_[k].tangent * wedges_[k].tangent);
  envelope_.begin(wedges_[k], eye.normal, weight_);
  // Nowhere higher than `least`
  const double least = eye.hiding.least[k][l];
  if (least > 0.0) add_level(wedges_[k], least, least / widest);
  add_edges(eye, edges, k);
  const PicturePlane::Sky known = envelope_.sky();
  // Nor are edges among these that are no higher than all horizons
  const double hidden = std::max(eye.hiding.most[k][l], minima_[k]);
  double low = known.sky;
  if (std::isinf(hidden)) {
    low = 0.0;
  } else if (hidden * widest > known.lowest) {
    add_level(wedges_[k], hidden, hidden);  // nowhere lower than `hidden`
    low = envelope_.sky().sky;
  }
  d.pairs.low[d.n] = static_cast<float>(term_of(low, k, *receivers_, l));
  d.pairs.high[d.n] = static_cast<float>(term_of(known.sky, k, *receivers_, l));
}

/// Adds a straight edge across the wedge, whose ends have these slopes.
void PacketEnvelope::add_level(const Wedge& w, double first, double last) {
  const Point2d d = w.from, e{d.x - w.tangent * d.y, d.y + w.tangent * d.x};
  envelope_.add({d.x, d.y, first}, {e.x, e.y, last * std::sqrt(1.0 + w.tangent * w.tangent)});
}

void PacketEnvelope::add_edges(const Eye& eye, const EdgesInWedges::InWedge& edges, std::size_t k) {
  const Point3d p{eye.p.x, eye.p.y, eye.p.z};
  const auto add_number = [&](std::int32_t number) {
    if (number < 0) return;
    const auto end = 2 * static_cast<std::size_t>(number);
    const Point3f &a = ends_.end(end).p, &b = ends_.end(end + 1).p;
    envelope_.add(Point3d{a.x, a.y, a.z} - p, Point3d{b.x, b.y, b.z} - p);
  };
  add_number(number_at(k, eye.lane));
  if (number_at(next(k), eye.lane) != number_at(k, eye.lane)) add_number(number_at(next(k), eye.lane));
  for (const std::uint32_t n : above_) {
    const WedgeEdges& e = edges.edges[n / packet_lanes];
    const std::size_t m = n % packet_lanes;
    envelope_.add(Point3d{e.ax[m], e.ay[m], e.az[m]} - p, Point3d{e.bx[m], e.by[m], e.bz[m]} - p);
  }
}

double PacketEnvelope::term_of(double sky, std::size_t k, const ReceiverPacket& receivers, std::size_t lane) const {
  const Point3d normal = normal_of(receivers, lane);
  if (wedge_weight_ != WedgeWeight::cosine || normal.z < 0.0) return sky;
  const Wedge& w = wedges_[k];
  const double along = normal.x * w.from.x + normal.y * w.from.y, left = normal.y * w.from.x - normal.x * w.from.y;
  // Upright borders at both azimuths, from the horizons to the zenith
  const auto border = [&](double tau, double slope) {
    return std::atan2(1.0, slope) * (tau * along - left) / std::sqrt(1.0 + tau * tau);
  };
  return sky - (border(w.tangent, slope_at(next(k), lane)) - border(0.0, slope_at(k, lane)));
}

void PacketEnvelope::keep_terms_of(std::size_t l) {
  for (std::size_t n = 0; n < doubtful(l).size(); ++n) {
    const Doubt d = doubt(l, n);
    terms_.low[d.wedge][l] = d.pairs.low[d.n];
    terms_.high[d.wedge][l] = d.pairs.high[d.n];
  }
}

// --- Lower borders
// ----------------------------------------------------------------------------------------------------------------

/// A lower border is drawn like an upper one, and its ends are marked.
std::span<const PacketEnvelope::Row> PacketEnvelope::find_lower_borders(std::span<const EndBatch> ends,
                                                                        const PacketHorizon& lower_borders, const Gaps& others) {
  for (Row& border : borders_) border.fill(0.0F);
  raise_to_ends(ends, borders_);
  for (std::size_t k = 0; k < wedges_.size(); ++k) {
    if (others.reached[k] == 0) continue;
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      float top = borders_[k][l];
      for (const std::size_t azimuth : {k, next(k)})
        if (lower_borders.row(azimuth)[l] > horizon_->row(azimuth)[l]) top = std::max(top, lower_borders.row(azimuth)[l]);
      borders_[k][l] = std::max(top * shape_.widened, others.borders[k][l]);
    }
  }
  return borders_;
}

}  // namespace farlod
