// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/visibility.hpp"

#include <algorithm>
#include <array>

#include "farlod/expects.hpp"

namespace farlod {
namespace {

/// Rays gathered before they are asked; a few packets, so that they stay in the first cache.
constexpr std::size_t batch_size = 256;

/// Rays that wait to be asked; `answer(tag)` is called for each that meets nothing.
template <class Answer>
class RayBatch {
 public:
  RayBatch(const Occluder& occluder, const Answer& answer) : occluder_(occluder), answer_(answer) {}

  void add(const Point3f& origin, const Point3f& direction, std::size_t tag) {
    if (count_ == batch_size) flush();
    rays_[count_] = {origin, direction, least_distance_m};
    tags_[count_++] = tag;
  }
  void flush() {
    occluder_.blocks(std::span(rays_).first(count_), std::span(blocked_).first(count_));
    for (std::size_t k = 0; k < count_; ++k)
      if (blocked_[k] == 0) answer_(tags_[k]);
    count_ = 0;
  }

 private:
  const Occluder& occluder_;
  const Answer& answer_;
  std::array<Ray, batch_size> rays_;
  std::array<std::size_t, batch_size> tags_{};
  std::array<std::uint8_t, batch_size> blocked_{};
  std::size_t count_ = 0;
};

Point3f rounded(const Point3d& d) { return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}; }

}  // namespace

std::vector<std::uint32_t> count_free(const Occluder& occluder, std::span<const Point3f> origins,
                                      std::span<const Point3d> directions) {
  std::vector<std::uint32_t> free(origins.size(), 0);
  const auto count = [&free](std::size_t n) { ++free[n]; };
  RayBatch batch(occluder, count);
  for (std::size_t first = 0; first < origins.size(); first += origins_per_packet) {
    const std::size_t end = std::min(first + origins_per_packet, origins.size());
    for (const Point3d& direction : directions)
      for (std::size_t n = first; n < end; ++n) batch.add(origins[n], rounded(direction), n);
  }
  batch.flush();
  return free;
}

void find_free(const Occluder& occluder, std::span<const Point3f> origins, std::span<const Point3d> directions,
               std::span<const std::uint8_t> wanted, std::span<std::uint8_t> free) {
  FARLOD_EXPECTS(origins.size() <= origins_per_packet && wanted.size() == origins.size() * directions.size() &&
                 free.size() == wanted.size());
  std::fill(free.begin(), free.end(), std::uint8_t{0});
  const auto mark = [free](std::size_t place) { free[place] = 1; };
  RayBatch batch(occluder, mark);
  for (std::size_t d = 0; d < directions.size(); ++d)
    for (std::size_t n = 0; n < origins.size(); ++n)
      if (const std::size_t place = d * origins.size() + n; wanted[place] != 0)
        batch.add(origins[n], rounded(directions[d]), place);
  batch.flush();
}

}  // namespace farlod
