// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "farlod/region.hpp"

#include <algorithm>
#include <utility>

#include "base/run_settings.hpp"

namespace farlod {
namespace {

/// A band holds some edges on average: a place is compared with those of one band.
constexpr std::size_t edges_in_band = 4, most_bands = 1 << 16;

}  // namespace

Region::Region(const std::vector<Ring>& rings) {
  for (const Ring& ring : rings) {
    for (const Point2d p : ring) {
      require_coordinate("a coordinate of the region", p.x);
      require_coordinate("a coordinate of the region", p.y);
    }
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Point2d a = ring[n], b = ring[n + 1 < ring.size() ? n + 1 : 0];
      outline_.add(a);
      // Level edges are crossed by nothing level
      if (a.y != b.y) edges_.push_back(a.y < b.y ? Edge{a, b} : Edge{b, a});
    }
  }
  bands_ = std::clamp<std::size_t>(edges_.size() / edges_in_band, 1, most_bands);
  std::vector<std::pair<std::size_t, std::uint32_t>> placed;
  for (std::uint32_t n = 0; n < edges_.size(); ++n)
    for (std::size_t band = band_of(edges_[n].low.y); band <= band_of(edges_[n].high.y); ++band) placed.emplace_back(band, n);
  std::sort(placed.begin(), placed.end());
  first_of_band_.assign(bands_ + 1, 0);
  for (const auto& [band, n] : placed) {
    ++first_of_band_[band + 1];
    numbers_.push_back(n);
  }
  for (std::size_t band = 0; band < bands_; ++band) first_of_band_[band + 1] += first_of_band_[band];
}

std::size_t Region::band_of(double y) const {
  const double height = outline_.high.y - outline_.low.y;
  const double place = height > 0.0 ? (y - outline_.low.y) / height * static_cast<double>(bands_) : 0.0;
  return std::min(static_cast<std::size_t>(std::max(place, 0.0)), bands_ - 1);
}

bool Region::contains(Point2d p) const {
  if (!outline_.contains(p)) return false;
  // A ray to the east; an edge has its lower end, and not its upper one
  bool is_inside = false;
  const std::size_t band = band_of(p.y);
  for (std::size_t k = first_of_band_[band]; k < first_of_band_[band + 1]; ++k) {
    const Edge& e = edges_[numbers_[k]];
    if (p.y < e.low.y || p.y >= e.high.y) continue;
    const double side = (e.high.x - e.low.x) * (p.y - e.low.y) - (p.x - e.low.x) * (e.high.y - e.low.y);
    if (side > 0.0) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace farlod
