// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/visibility.hpp"

#include <algorithm>
#include <array>

namespace farlod {
namespace {

/// Origins that are asked together: one packet of Embree.
constexpr std::size_t group_size = 16;
/// Rays gathered before they are asked; a few packets, so that they stay in the first cache.
constexpr std::size_t batch_size = 256;

/// Rays of a group of origins, waiting to be asked.
class RayBatch {
 public:
  RayBatch(const Occluder& occluder, std::span<std::uint32_t> free) : occluder_(occluder), free_(free) {}

  void add(const Point3f& origin, std::size_t n, const Point3f& direction) {
    if (count_ == batch_size) flush();
    rays_[count_] = {origin, direction, least_distance_m};
    origin_of_[count_++] = n;
  }
  void flush() {
    occluder_.blocks(std::span(rays_).first(count_), std::span(blocked_).first(count_));
    for (std::size_t k = 0; k < count_; ++k) free_[origin_of_[k]] += blocked_[k] == 0 ? 1U : 0U;
    count_ = 0;
  }

 private:
  const Occluder& occluder_;
  std::span<std::uint32_t> free_;
  std::array<Ray, batch_size> rays_;
  std::array<std::size_t, batch_size> origin_of_{};
  std::array<std::uint8_t, batch_size> blocked_{};
  std::size_t count_ = 0;
};

}  // namespace

std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                      std::span<const Point3d> directions) {
  std::vector<std::uint32_t> free(origins.size(), 0);
  std::vector<Point3f> rounded;
  for (const Point3d& d : directions)
    rounded.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
  RayBatch batch(occluder, free);
  for (std::size_t first = 0; first < origins.size(); first += group_size) {
    const std::size_t end = std::min(first + group_size, origins.size());
    for (const Point3f& direction : rounded)
      for (std::size_t n = first; n < end; ++n) batch.add(origins[n], n, direction);
  }
  batch.flush();
  return free;
}

}  // namespace farlod
