// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "canopy/crown_batches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/expects.hpp"
#include "canopy/crown_kernels.hpp"

namespace farlod {

CrownBatches::CrownBatches(std::span<const Crown> crowns, const CanopySettings& settings) : rule_(settings.rule) {
  batches_.reserve((crowns.size() + lanes - 1) / lanes);
  for (const Crown& crown : crowns) add(crown, settings);
}

void CrownBatches::add(const Crown& crown, const CanopySettings& settings) {
  FARLOD_EXPECTS(crown.bottom_m < crown.top_m && crown.half_width_m > 0.0F);
  const std::size_t lane = size_ % lanes;
  Batch& b = next_batch();
  const double transmissivity = transmissivity_of(crown.foliage, settings);
  b.used |= 1U << lane;
  b.x[lane] = crown.x_m;
  b.y[lane] = crown.y_m;
  b.bottom[lane] = crown.bottom_m;
  b.top[lane] = crown.top_m;
  b.half_width[lane] = crown.half_width_m;
  b.plan_radius[lane] = crown.half_width_m * (crown.shape == CrownShape::prism ? std::numbers::sqrt2_v<float> : 1.0F);
  const bool is_spheroid = crown.shape == CrownShape::spheroid;
  const float half_height = 0.5F * (crown.top_m - crown.bottom_m);
  b.cap_z[lane] = is_spheroid ? crown.bottom_m + half_height : crown.top_m;
  b.cap_ratio[lane] = is_spheroid ? half_height / crown.half_width_m : 0.0F;
  b.cosine[lane] = static_cast<float>(std::cos(crown.turn_rad()));
  b.sine[lane] = static_cast<float>(std::sin(crown.turn_rad()));
  b.transmissivity[lane] = static_cast<float>(transmissivity);
  // A depth that lets nothing through a float, in place of infinity
  b.optical_depth[lane] = static_cast<float>(settings.rule == CanopyRule::beer
                                                 ? extinction_per_m_of(crown.foliage, settings)
                                                 : std::min(-std::log(transmissivity), static_cast<double>(opaque_depth)));
  b.shape[lane] = crown.shape;
  least_transmissivity_ = std::min(least_transmissivity_, b.transmissivity[lane]);
  most_transmissivity_ = std::max(most_transmissivity_, b.transmissivity[lane]);
  ++size_;
}

CrownBatches::Batch& CrownBatches::next_batch() {
  if (size_ % lanes == 0) batches_.emplace_back();
  return batches_.back();
}

void CrownBatches::assign(const CrownBatches& all, std::span<const std::uint32_t> numbers) {
  rule_ = all.rule_;
  least_transmissivity_ = all.least_transmissivity_;
  most_transmissivity_ = all.most_transmissivity_;
  batches_.clear();
  for (size_ = 0; size_ < numbers.size(); ++size_) {
    const Batch& from = all.batches_[numbers[size_] / lanes];
    const std::size_t from_lane = numbers[size_] % lanes, lane = size_ % lanes;
    Batch& b = next_batch();
    b.used |= 1U << lane;
    b.shape[lane] = from.shape[from_lane];
    for (const auto row :
         {&Batch::x, &Batch::y, &Batch::bottom, &Batch::top, &Batch::half_width, &Batch::plan_radius, &Batch::cap_z,
          &Batch::cap_ratio, &Batch::cosine, &Batch::sine, &Batch::transmissivity, &Batch::optical_depth})
      (b.*row)[lane] = (from.*row)[from_lane];
  }
}

}  // namespace farlod
