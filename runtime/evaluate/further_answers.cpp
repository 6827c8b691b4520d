// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/further_answers.hpp"

#include <algorithm>
#include <utility>

#include "base/expects.hpp"
#include "evaluate/traced_profile.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhangs.hpp"

namespace farlod {
namespace {

/// A far map without anything in it.
FarHorizon emptied(FarHorizon far) {
  for (std::vector<float>* slopes : {&far.low, &far.estimate, &far.high, &far.overhang}) std::ranges::fill(*slopes, 0.0F);
  far.occluders.explicit_edges = {};
  return far;
}

}  // namespace

/// The sky above the near geometry alone. Rays in gaps meet the neighborhood alone, too.
class FurtherAnswers::NearSky {
 public:
  NearSky(const PackageReader& package, const CellReceivers& cell, const FarHorizon& far, const AzimuthSampling& azimuths,
          const GapSettings& gaps)
      : far_(emptied(far)),
        silhouettes_(cell_silhouettes(package, cell.cell, far_, bounding_box(cell.receivers))),
        overhangs_(package, cell.cell),
        engine_(azimuths, SkyWeight::cosine, far_, silhouettes_, overhangs_, gaps) {}

  void evaluate(std::span<const ReceiverPacket> packets) {
    answers_.resize(packets.size());
    engine_.evaluate(packets, answers_);
  }
  [[nodiscard]] float svf(std::size_t packet, std::size_t lane) const { return answers_[packet].svf[lane].estimate; }

 private:
  FarHorizon far_;
  CellSilhouettes silhouettes_;
  OverhangGeometry overhangs_;
  HorizonEngine engine_;
  std::vector<PacketAnswer> answers_;
};

FurtherAnswers::FurtherAnswers(const FurtherQuantities& quantities, const CellReceivers& cell, const SkyAnswers& answers)
    : quantities_(quantities), cell_(cell), answers_(answers) {}
FurtherAnswers::~FurtherAnswers() = default;

void FurtherAnswers::listen_to(HorizonEngine& engine) {
  engine.tell_profiles(quantities_.profile_rows(), [this](std::size_t n, SkyProfile& profile) {
    if (profiles_.size() <= n) profiles_.resize(n + 1, profile);
    std::swap(profiles_[n], profile);
  });
}

void FurtherAnswers::trace(std::span<const ReceiverPacket> packets, const RayScene& scene, const std::stop_token& stop) {
  while (profiles_.size() < packets.size()) profiles_.emplace_back(quantities_.azimuths());
  for (std::size_t n = 0; n < packets.size(); ++n) trace_profile(quantities_.azimuths(), scene, packets[n], profiles_[n], stop);
}

void FurtherAnswers::draw_near_sky(const PackageReader& package, const FarHorizon& far, const GapSettings& gaps) {
  near_sky_ = std::make_unique<NearSky>(package, cell_, far, quantities_.azimuths(), gaps);
}

void FurtherAnswers::draw_canopies(const PackageReader& package, CanopyCertainty certainty, std::stop_token stop) {
  canopies_ = std::make_unique<CanopyAnswers>(package, cell_, quantities_, std::move(certainty), std::move(stop));
}

void FurtherAnswers::find_canopies(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
                                   const DrawnAnswers& drawn) {
  skies_.clear();
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const std::span<const std::uint32_t> of_packet = numbers.first(packets[n].count);
    skies_.push_back(skies_of(drawn.packets[n], cell_, of_packet, answers_, drawn.are_answers, drawn.max_error));
    numbers = numbers.subspan(packets[n].count);
  }
  of_canopies_ = canopies_->evaluate(std::span(profiles_).first(packets.size()), packets, skies_);
}

void FurtherAnswers::store(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
                           const DrawnAnswers& drawn) {
  FARLOD_EXPECTS(!canopies_ || drawn.packets.size() == packets.size());
  if (near_sky_) near_sky_->evaluate(packets);
  if (canopies_) find_canopies(packets, numbers, drawn);
  for (std::size_t n = 0; n < packets.size(); ++n) {
    store(n, packets[n], numbers.first(packets[n].count));
    numbers = numbers.subspan(packets[n].count);
  }
}

void FurtherAnswers::store(std::size_t packet, const ReceiverPacket& receivers, std::span<const std::uint32_t> numbers) {
  FurtherQuantities::Sky sky{};
  for (std::size_t l = 0; l < numbers.size(); ++l) {
    sky.svf[l] = answers_.svf[cell_.receivers[numbers[l]].index];
    if (near_sky_) sky.near_svf[l] = near_sky_->svf(packet, l);
    if (!near_svf_.empty()) sky.near_svf[l] = near_svf_[numbers[l]];
  }
  const std::size_t columns = quantities_.size();
  values_.resize(numbers.size() * columns);
  quantities_.evaluate(profiles_[packet], receivers, sky, rows_, values_);
  if (canopies_) {
    const auto [first, count] = quantities_.canopy_columns();
    for (std::size_t l = 0; l < numbers.size(); ++l)
      write_canopy_columns(quantities_.quantities(), sky.svf[l], of_canopies_[packet][l],
                           std::span(values_).subspan(l * columns + first, count));
  }
  for (std::size_t l = 0; l < numbers.size(); ++l)
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(l * columns), columns,
                answers_.further.begin() + static_cast<std::ptrdiff_t>(cell_.receivers[numbers[l]].index * columns));
}

}  // namespace farlod
