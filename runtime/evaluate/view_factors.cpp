// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/view_factors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {
namespace {

constexpr std::array<std::pair<const char*, const char*>, view_class_count> view_words{
    {{"sky", "sky"},
     {"ground", "ground"},
     {"roof", "roofs"},
     {"wall_n", "walls that face north, by less than 45 degrees from true north"},
     {"wall_e", "walls that face east"},
     {"wall_s", "walls that face south"},
     {"wall_w", "walls that face west"},
     {"crown", "crowns of trees, as if nothing passed them"},
     {"other", "undersides"}}};

/// A share of the view of each class.
using Views = std::array<float, view_class_count>;

/// The rays of a receiver in a part of its view, by what they meet.
class PartOfView {
 public:
  void count(ViewClass met) { ++rays_[static_cast<std::size_t>(met)]; }
  /// Divides the part's share of the view among its classes; all goes to one where there are no rays.
  void add(float share, ViewClass without_rays, Views& views) const {
    const std::uint32_t all = std::accumulate(rays_.begin(), rays_.end(), 0U);
    if (all == 0) views[static_cast<std::size_t>(without_rays)] += share;
    for (std::size_t c = 0; c < view_class_count && all > 0; ++c)
      views[c] += share * static_cast<float>(rays_[c]) / static_cast<float>(all);
  }

 private:
  std::array<std::uint32_t, view_class_count> rays_{};
};

/// What a receiver sees: in the sky that nothing solid hides, in the rest of the upper half, and in the lower half.
struct PartsOfView {
  PartOfView sky, hidden, below;
};
using PartsOfPacket = std::array<PartsOfView, RayOrigins::lanes>;

void look(const SeenScene& scene, const RayOrigins& origins, const Point3d& towards, std::size_t count, PartsOfPacket& parts) {
  const Point3f direction = rounded(towards);
  const auto wanted = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
  const Occluder::Hits hits = scene.solid.occluder.nearest(origins, direction, least_distance_m, wanted);
  // A crown that is met before the end of a ray is seen instead of what is there, or of the sky where the ray has no end
  const std::uint32_t crowns =
      scene.crowns == nullptr
          ? 0
          : scene.crowns->met_before(hits.distances, origins, Occluder::Directions::all_of(direction), least_distance_m, wanted);
  for (std::size_t l = 0; l < count; ++l) {
    const bool is_free = hits.distances[l] == std::numeric_limits<float>::infinity();
    // The city ends where its ground does; the ground goes on
    const ViewClass beyond = towards.z > 0.0 ? ViewClass::sky : ViewClass::ground;
    const ViewClass met = is_free ? beyond : scene.surfaces.met(hits.triangles[l], direction);
    const ViewClass seen = has_bit(crowns, l) ? ViewClass::crown : met;
    PartsOfView& of = parts[l];
    (towards.z <= 0.0 ? of.below : is_free ? of.sky : of.hidden).count(seen);
  }
}

/// The columns of a receiver.
struct ViewColumns {
  std::span<float> all, below;
};

void write(const PartsOfView& parts, const Receiver& receiver, float svf, const ViewColumns& columns) {
  // The half of the sphere below the horizontal fills so much of the view of a tilted plane
  const float below = 0.5F * (1.0F - receiver.normal.z);
  const float hidden = std::max(0.0F, 1.0F - below - svf);
  Views all{}, lower{};
  // Where svf knows more sky than there is room for, the lower half gives way
  parts.below.add(std::max(0.0F, 1.0F - hidden - svf), ViewClass::other, lower);
  std::ranges::copy(std::span(lower).subspan(1).first(columns.below.size()), columns.below.begin());
  all = lower;
  parts.sky.add(svf, ViewClass::sky, all);
  parts.hidden.add(hidden, ViewClass::other, all);
  std::ranges::copy(std::span(all).first(columns.all.size()), columns.all.begin());
}

/// Receivers near each other one after the other, as far as they look the same way.
std::vector<Receiver> in_order_of_packets(const CellReceivers& cell, const std::stop_token& stop) {
  std::vector<Receiver> ordered;
  for (const std::uint32_t n : packet_order(cell.receivers, stop).numbers) ordered.push_back(cell.receivers[n]);
  return ordered;
}

}  // namespace

void describe_views(const Quantities&, std::vector<ColumnDescription>& columns) {
  for (const auto& [word, meaning] : view_words)
    columns.push_back({std::string("view_") + word, "1", std::string("share of the view, weighted by the cosine: ") + meaning});
}

void describe_views_below(const Quantities&, std::vector<ColumnDescription>& columns) {
  for (const auto& [word, meaning] : std::span(view_words).subspan(1))
    columns.push_back(
        {"view_" + (word + std::string("_below")), "1", std::string("share of the view, below the horizontal: ") + meaning});
}

void store_view_factors(const CellReceivers& cell, const SeenScene& scene, const SkyDirections& directions,
                        const FurtherQuantities& quantities, const SkyAnswers& answers, const std::stop_token& stop) {
  const ColumnRange all = quantities.view_columns(), below = quantities.view_below_columns();
  const std::vector<Receiver> ordered = in_order_of_packets(cell, stop);
  for_each_normal(ordered, [&](std::span<const Receiver> group) {
    const Point3f& n = group.front().normal;
    const std::vector<Point3d> around = directions.around(normalized(Point3d{n.x, n.y, n.z}));
    for (std::size_t first = 0; first < group.size(); first += RayOrigins::lanes) {
      const std::span<const Receiver> packet = group.subspan(first, std::min(RayOrigins::lanes, group.size() - first));
      std::vector<Point3f> places;
      for (const Receiver& r : packet) places.push_back(placed(r.p_cell, scene.solid.scene_from_cell_m));
      const RayOrigins origins = gathered(places);
      PartsOfPacket parts;
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (k % directions_between_looks == 0) throw_if_cancelled(stop);
        look(scene, origins, around[k], packet.size(), parts);
      }
      for (std::size_t l = 0; l < packet.size(); ++l) {
        const std::span<float> values = answers.further.subspan(packet[l].index * quantities.size(), quantities.size());
        write(parts[l], packet[l], answers.svf[packet[l].index],
              {values.subspan(all.first, all.count), values.subspan(below.first, below.count)});
      }
    }
  });
}

}  // namespace farlod
