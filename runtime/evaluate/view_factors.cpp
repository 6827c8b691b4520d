// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/view_factors.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "base/cancellation.hpp"
#include "evaluate/view_columns.hpp"
#include "evaluate/visibility.hpp"
#include "farlod/angle.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {
namespace {

/// A share of the view for each column; of the last there may be none.
using Views = std::array<float, view_class_count>;

/// The rays of a receiver in a part of its view, by what they meet.
class PartOfView {
 public:
  void count(ViewClass met) { ++rays_[static_cast<std::size_t>(met)]; }
  /// Divides the part's share of the view among its columns; all goes to one where there are no rays.
  void add(float share, ViewClass without_rays, const ViewLayout& layout, Views& views) const {
    const std::uint32_t all = std::accumulate(rays_.begin(), rays_.end(), 0U);
    if (all == 0) views[layout.column_of(without_rays)] += share;
    for (std::size_t c = 0; c < view_class_count && all > 0; ++c)
      views[layout.column_of(static_cast<ViewClass>(c))] += share * static_cast<float>(rays_[c]) / static_cast<float>(all);
  }

 private:
  std::array<std::uint32_t, view_class_count> rays_{};
};

/// What a receiver sees: in the sky that nothing solid hides, in the rest of the upper half, and in the lower half.
struct PartsOfView {
  PartOfView sky, hidden, below;
};

/// What the rays of a packet meet in one direction, and the bits of those that meet nothing solid.
struct MetByPacket {
  std::array<ViewClass, RayOrigins::lanes> seen{};
  std::uint32_t free = 0;
};

/// `in_sky` are the bits of the receivers that are known to see the sky there, or a crown.
MetByPacket look(const SeenScene& scene, const RayOrigins& origins, const Point3d& towards, std::uint32_t wanted,
                 std::uint32_t in_sky) {
  const Point3f direction = rounded(towards);
  const Occluder::Hits hits = scene.solid.occluder.nearest(origins, direction, least_distance_m, wanted & ~in_sky);
  // A crown that is met before the end of a ray is seen instead of what is there, or of the sky where the ray has no end
  const std::uint32_t crowns =
      scene.crowns == nullptr
          ? 0
          : scene.crowns->met_before(hits.distances, origins, Occluder::Directions::all_of(direction), least_distance_m, wanted);
  // The city ends where its ground does; the ground goes on
  const ViewClass beyond = towards.z > 0.0 ? ViewClass::sky : ViewClass::ground;
  MetByPacket met;
  for (std::uint32_t bits = wanted; bits != 0; bits &= bits - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(bits));
    const bool is_free = has_bit(in_sky, l) || hits.distances[l] == std::numeric_limits<float>::infinity();
    const ViewClass solid = is_free ? beyond : scene.surfaces.met(hits.triangles[l], direction);
    met.seen[l] = has_bit(crowns, l) ? ViewClass::crown : solid;
    if (is_free) met.free |= 1U << l;
  }
  return met;
}

/// The share of a plane's view that lies below the horizontal.
float share_below(const Point3f& normal, SkyWeight weight) {
  if (weight == SkyWeight::cosine) return 0.5F * (1.0F - normal.z);
  // A lune between the plane and the horizontal, as wide as the plane is tilted
  return std::acos(std::clamp(normal.z, -1.0F, 1.0F)) / std::numbers::pi_v<float>;
}

/// The columns of a receiver.
struct ViewColumns {
  std::span<float> all, below;
};

void write(const PartsOfView& parts, float below, float svf, const ViewLayout& layout, const ViewColumns& columns) {
  const float hidden = std::max(0.0F, 1.0F - below - svf);
  Views all{}, lower{};
  // Where svf knows more sky than there is room for, the lower half gives way
  parts.below.add(std::max(0.0F, 1.0F - hidden - svf), ViewClass::other, layout, lower);
  std::ranges::copy(std::span(lower).subspan(1).first(columns.below.size()), columns.below.begin());
  all = lower;
  parts.sky.add(svf, ViewClass::sky, layout, all);
  parts.hidden.add(hidden, ViewClass::other, layout, all);
  std::ranges::copy(std::span(all).first(columns.all.size()), columns.all.begin());
}

/// Receivers near each other one after the other, as far as they look the same way.
std::vector<Receiver> in_order_of_packets(const CellReceivers& cell, const std::stop_token& stop) {
  std::vector<Receiver> ordered;
  for (const std::uint32_t n : packet_order(cell.receivers, stop).numbers) ordered.push_back(cell.receivers[n]);
  return ordered;
}

/// The places of a packet in the scene.
RayOrigins origins_in(const SeenScene& scene, std::span<const Receiver> packet) {
  std::vector<Point3f> places;
  for (const Receiver& r : packet) places.push_back(placed(r.p_cell, scene.solid.scene_from_cell_m));
  return gathered(places);
}

/// Calls `f` for each packet of receivers that follow each other.
template <class F>
void for_each_packet(std::span<const Receiver> receivers, const F& f) {
  for (std::size_t first = 0; first < receivers.size(); first += RayOrigins::lanes)
    f(receivers.subspan(first, std::min(RayOrigins::lanes, receivers.size() - first)));
}

std::uint32_t bits_of_first(std::size_t count) { return static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1); }

}  // namespace

void ViewFactors::store(const CellReceivers& cell) {
  const std::vector<Receiver> ordered = in_order_of_packets(cell, stop_);
  for_each_normal(ordered, [&](std::span<const Receiver> group) {
    for_each_packet(group, [&](std::span<const Receiver> packet) { store(packet, nullptr); });
  });
}

void ViewFactors::store(std::span<const Receiver> packet, const SkyProfile* profile) {
  std::size_t first_lane = 0;
  for_each_normal(packet, [&](std::span<const Receiver> alike) {
    turn_to(alike.front().normal);
    find_known_sky(profile);
    store_alike(alike, first_lane);
    first_lane += alike.size();
  });
}

void ViewFactors::turn_to(const Point3f& normal) {
  if (normal == normal_) return;
  normal_ = normal;
  around_ = directions_.around(normalized(Point3d{normal.x, normal.y, normal.z}));
  rays_.clear();
  for (const Point3d& d : around_) {
    const auto [before, after] = quantities_.azimuths().around(horizontal(d));
    // A horizon tells nothing of what lies below the horizontal
    const double slope = d.z > 0.0 ? d.z / norm(horizontal(d)) : -1.0;
    rays_.push_back({before, after, static_cast<float>(slope)});
  }
}

void ViewFactors::find_known_sky(const SkyProfile* profile) {
  in_sky_.assign(rays_.size(), 0);
  if (profile != nullptr) sky_kernels().find_rays_above(profile->sky_from.front().data(), rays_, in_sky_.data());
}

void ViewFactors::store_alike(std::span<const Receiver> receivers, std::size_t first_lane) {
  const RayOrigins origins = origins_in(scene_, receivers);
  const std::uint32_t wanted = bits_of_first(receivers.size());
  std::array<PartsOfView, RayOrigins::lanes> parts;
  for (std::size_t k = 0; k < around_.size(); ++k) {
    if (k % directions_between_looks == 0) throw_if_cancelled(stop_);
    const MetByPacket met = look(scene_, origins, around_[k], wanted, (std::uint32_t{in_sky_[k]} >> first_lane) & wanted);
    for (std::size_t l = 0; l < receivers.size(); ++l) {
      PartsOfView& of = parts[l];
      (around_[k].z <= 0.0 ? of.below : has_bit(met.free, l) ? of.sky : of.hidden).count(met.seen[l]);
    }
  }
  const ViewLayout layout(quantities_.quantities().wall_sectors);
  const ViewRanges& ranges = quantities_.view_columns();
  for (std::size_t l = 0; l < receivers.size(); ++l) {
    const Receiver& r = receivers[l];
    const std::span<float> values = answers_.further.subspan(r.index * quantities_.size(), quantities_.size());
    write(parts[l], share_below(r.normal, weight_), answers_.svf[r.index], layout,
          {values.subspan(ranges.all.first, ranges.all.count), values.subspan(ranges.below.first, ranges.below.count)});
  }
}

std::vector<Point3d> eye_directions(double field_deg, std::size_t count, const GridRotation& rotation) {
  const double highest = sin(Angle::degrees(field_deg));
  std::vector<Point3d> directions;
  for (std::size_t k = 0; k < count; ++k) {
    // Rows alike in height are alike in solid angle; the golden section spreads them over the turn
    const double z = highest * ((2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(count) - 1.0);
    const double turns = static_cast<double>(k) * std::numbers::phi, level = std::sqrt(1.0 - z * z);
    const Angle azimuth = Angle::radians(2.0 * std::numbers::pi * (turns - std::floor(turns)));
    directions.push_back(rotation.grid_from_city(Point3d{level * sin(azimuth), level * cos(azimuth), z}));
  }
  return directions;
}

void store_views_of_eye(const CellReceivers& cell, const SeenScene& scene, std::span<const Point3d> directions,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop) {
  const ColumnRange& range = quantities.view_columns().eye;
  const ViewLayout layout(quantities.quantities().wall_sectors);
  const std::vector<Receiver> ordered = in_order_of_packets(cell, stop);
  for_each_packet(ordered, [&](std::span<const Receiver> packet) {
    const RayOrigins origins = origins_in(scene, packet);
    std::array<PartOfView, RayOrigins::lanes> parts;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (k % directions_between_looks == 0) throw_if_cancelled(stop);
      const MetByPacket met = look(scene, origins, directions[k], bits_of_first(packet.size()), 0);
      for (std::size_t l = 0; l < packet.size(); ++l) parts[l].count(met.seen[l]);
    }
    for (std::size_t l = 0; l < packet.size(); ++l) {
      Views views{};
      parts[l].add(1.0F, ViewClass::other, layout, views);
      std::ranges::copy(std::span(views).first(range.count),
                        answers.further.subspan(packet[l].index * quantities.size() + range.first).begin());
    }
  });
}

}  // namespace farlod
