// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/further_answers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/error_budget.hpp"
#include "farlod/angle.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhangs.hpp"

namespace farlod {
namespace {

constexpr std::size_t whole_degrees = 90;
constexpr int halvings = 8;

float slope_at(double elevation_deg) { return static_cast<float>(tan(Angle::degrees(elevation_deg))); }

double middle_of(std::size_t degree) { return static_cast<double>(degree) + 0.5; }

/// The view factor of a degree, for a receiver that looks straight up: sin²(e + 1°) − sin²(e).
double sky_of(std::size_t degree) {
  const double from = sin(Angle::degrees(static_cast<double>(degree))), to = sin(Angle::degrees(static_cast<double>(degree + 1)));
  return to * to - from * from;
}

/// Asks rays at one azimuth, each receiver at an elevation of its own.
class RaysAtAzimuth {
 public:
  RaysAtAzimuth(float cosine, float sine, const RayScene& scene, const RayOrigins& origins) : scene_(scene), origins_(origins) {
    directions_.x.fill(cosine);
    directions_.y.fill(sine);
  }
  [[nodiscard]] std::uint32_t are_blocked(double elevation_deg, std::uint32_t wanted) {
    directions_.z.fill(slope_at(elevation_deg));
    return scene_.blocked(origins_, directions_, wanted) & wanted;
  }
  [[nodiscard]] std::uint32_t are_blocked(const std::array<double, packet_lanes>& elevations_deg, std::uint32_t wanted) {
    for (std::size_t l = 0; l < packet_lanes; ++l) directions_.z[l] = slope_at(elevations_deg[l]);
    return scene_.blocked(origins_, directions_, wanted) & wanted;
  }
  /// The elevation between one that is blocked and one that is free, at which that changes. Where nothing above the horizontal is
  /// blocked, the horizontal.
  [[nodiscard]] std::array<double, packet_lanes> border_between(std::array<double, packet_lanes> blocked_deg,
                                                                std::array<double, packet_lanes> free_deg, std::uint32_t wanted) {
    std::array<double, packet_lanes> middle_deg{};
    for (int n = 0; n <= halvings; ++n) {
      for (std::size_t l = 0; l < packet_lanes; ++l) middle_deg[l] = 0.5 * (blocked_deg[l] + free_deg[l]);
      if (n == halvings || wanted == 0) break;
      const std::uint32_t is_blocked = are_blocked(middle_deg, wanted);
      for (std::size_t l = 0; l < packet_lanes; ++l) (has_bit(is_blocked, l) ? blocked_deg : free_deg)[l] = middle_deg[l];
    }
    for (std::size_t l = 0; l < packet_lanes; ++l)
      if (blocked_deg[l] == 0.0) middle_deg[l] = 0.0;
    return middle_deg;
  }

 private:
  const RayScene& scene_;
  const RayOrigins& origins_;
  Occluder::Directions directions_;
};

/// Which degrees are blocked for each receiver: a bit for each receiver.
std::array<std::uint32_t, whole_degrees> look_at_degrees(RaysAtAzimuth& rays, std::uint32_t wanted) {
  std::array<std::uint32_t, whole_degrees> blocked{};
  for (std::size_t e = 0; e < whole_degrees; ++e) blocked[e] = rays.are_blocked(middle_of(e), wanted);
  return blocked;
}

/// The highest blocked degree of a receiver, counted from 1; 0 where there is none.
std::size_t end_of_blocked(const std::array<std::uint32_t, whole_degrees>& blocked, std::size_t lane) {
  std::size_t end = whole_degrees;
  while (end > 0 && !has_bit(blocked[end - 1], lane)) --end;
  return end;
}

/// A gap of a receiver: its lowest and the end of its highest free degree below the sky, and the free share of its sky.
struct Gap {
  std::size_t begin = 0, end = 0;
  double share = 0.0;
};
Gap gap_of(const std::array<std::uint32_t, whole_degrees>& blocked, std::size_t lane, std::size_t end_of_hidden) {
  Gap gap{end_of_hidden, 0, 0.0};
  for (std::size_t e = 0; e < end_of_hidden; ++e) {
    if (has_bit(blocked[e], lane)) continue;
    gap.begin = std::min(gap.begin, e);
    gap.end = e + 1;
  }
  double free = 0.0, all = 0.0;
  for (std::size_t e = gap.begin; e < gap.end; ++e) {
    all += sky_of(e);
    free += has_bit(blocked[e], lane) ? 0.0 : sky_of(e);
  }
  gap.share = all > 0.0 ? free / all : 0.0;
  return gap;
}

void add_gap_rows(SkyProfile& profile) {
  if (!profile.gap_share.empty()) return;
  for (SkyProfile::Rows* rows : {&profile.gap_from, &profile.gap_to, &profile.gap_share})
    rows->assign(profile.sky_from.size(), PacketHorizon::Row{});
}

/// The profiles of a packet at one azimuth.
class ProfileAtAzimuth {
 public:
  ProfileAtAzimuth(RaysAtAzimuth& rays, std::uint32_t wanted)
      : rays_(rays), wanted_(wanted), blocked_(look_at_degrees(rays, wanted)) {
    for (std::size_t l = 0; l < packet_lanes; ++l) ends_[l] = end_of_blocked(blocked_, l);
  }

  /// The sky begins between the highest blocked degree and the next.
  void find_sky(PacketHorizon::Row& sky_from) {
    std::array<double, packet_lanes> blocked_deg{}, free_deg{};
    std::uint32_t is_closed = 0;
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      blocked_deg[l] = ends_[l] == 0 ? 0.0 : middle_of(ends_[l] - 1);
      free_deg[l] = ends_[l] == whole_degrees ? 90.0 : middle_of(ends_[l]);
      is_closed |= ends_[l] == whole_degrees ? 1U << l : 0U;
    }
    const std::array<double, packet_lanes> from_deg = rays_.border_between(blocked_deg, free_deg, wanted_ & ~is_closed);
    for (std::size_t l = 0; l < packet_lanes; ++l)
      sky_from[l] = has_bit(is_closed, l) ? std::numeric_limits<float>::infinity() : slope_at(from_deg[l]);
  }

  /// Gaps: from below the lowest free degree to above the highest one that is not the sky's.
  void find_gaps(std::size_t azimuth, SkyProfile& profile) {
    std::array<Gap, packet_lanes> gaps{};
    std::array<double, packet_lanes> hidden_below{}, open_lowest{}, open_highest{}, hidden_above{};
    std::uint32_t with_gap = 0;
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      gaps[l] = gap_of(blocked_, l, ends_[l]);
      if (gaps[l].end == 0 || !has_bit(wanted_, l)) continue;
      with_gap |= 1U << l;
      hidden_below[l] = gaps[l].begin == 0 ? 0.0 : middle_of(gaps[l].begin - 1);
      open_lowest[l] = middle_of(gaps[l].begin);
      open_highest[l] = middle_of(gaps[l].end - 1);
      hidden_above[l] = middle_of(gaps[l].end);
    }
    if (with_gap == 0) return;
    add_gap_rows(profile);
    const std::array<double, packet_lanes> from_deg = rays_.border_between(hidden_below, open_lowest, with_gap),
                                           to_deg = rays_.border_between(hidden_above, open_highest, with_gap);
    for (std::size_t l = 0; l < packet_lanes; ++l) {
      if (!has_bit(with_gap, l)) continue;
      profile.gap_from[azimuth][l] = slope_at(from_deg[l]);
      profile.gap_to[azimuth][l] = slope_at(to_deg[l]);
      profile.gap_share[azimuth][l] = static_cast<float>(gaps[l].share);
    }
  }

 private:
  RaysAtAzimuth& rays_;
  std::uint32_t wanted_;
  std::array<std::uint32_t, whole_degrees> blocked_;
  std::array<std::size_t, packet_lanes> ends_{};
};

/// Makes the profile of a packet by rays: at each azimuth one in the middle of each degree of elevation; then the ends of the sky
/// and of what is hidden are halved until they are known to a 256th of a degree. What is smaller than a degree may be missed. All
/// between the lowest free ray and the sky is one gap. The profile has no rows of sky. Throws Cancelled when `stop` is asked for.
void trace_profile(const AzimuthSampling& azimuths, const RayScene& scene, const ReceiverPacket& receivers, SkyProfile& profile,
                   const std::stop_token& stop) {
  const RayOrigins origins = origins_of(receivers, scene.solid.scene_from_cell_m);
  const auto wanted = receivers.lanes_in_use();
  for (SkyProfile::Rows* rows :
       {&profile.gap_from, &profile.gap_to, &profile.gap_share, &profile.sky, &profile.solid_sky, &profile.light_sky})
    rows->clear();
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    throw_if_cancelled(stop);
    RaysAtAzimuth rays(azimuths.cosine()[k], azimuths.sine()[k], scene, origins);
    ProfileAtAzimuth at_azimuth(rays, wanted);
    at_azimuth.find_sky(profile.sky_from[k]);
    at_azimuth.find_gaps(k, profile);
  }
}

/// A far map without anything in it.
FarHorizon emptied(FarHorizon far) {
  for (std::vector<float>* slopes : {&far.low, &far.estimate, &far.high, &far.overhang}) std::ranges::fill(*slopes, 0.0F);
  far.occluders.explicit_edges = {};
  return far;
}

}  // namespace

/// The sky above the near geometry alone.
class FurtherAnswers::NearSky {
 public:
  NearSky(const PackageReader& package, const CellReceivers& cell, const FarHorizon& far, const AzimuthSampling& azimuths)
      : far_(emptied(far)),
        silhouettes_(cell_silhouettes(package, cell.cell, far_, bounding_box(cell.receivers))),
        overhangs_(package, cell.cell),
        engine_(azimuths, SkyWeight::cosine, far_, silhouettes_, overhangs_, gap_tolerance(azimuths.size())) {}

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

void FurtherAnswers::draw_near_sky(const PackageReader& package, const FarHorizon& far) {
  near_sky_ = std::make_unique<NearSky>(package, cell_, far, quantities_.azimuths());
}

void FurtherAnswers::draw_canopies(const PackageReader& package, CanopyCertainty certainty, const CanopyCity* pixels,
                                   std::stop_token stop) {
  canopies_ = std::make_unique<CanopyAnswers>(package, cell_, quantities_, certainty, pixels, std::move(stop));
}

void FurtherAnswers::find_view_factors(const SeenScene& scene, const SkyDirections& directions, SkyWeight weight,
                                       std::stop_token stop) {
  views_.emplace(scene, directions, weight, quantities_, answers_, std::move(stop));
}

void FurtherAnswers::find_canopies(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
                                   std::span<const PacketAnswer> drawn) {
  const std::span<const SkyProfile> profiles = std::span(profiles_).first(packets.size());
  canopies_->see(profiles, packets);
  of_canopies_ = {};
  if (drawn.empty() || quantities_.canopy_columns().count == 0) return;
  skies_.clear();
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const std::span<const std::uint32_t> of_packet = numbers.first(packets[n].count);
    skies_.push_back(skies_of(drawn[n], cell_, of_packet, answers_));
    numbers = numbers.subspan(packets[n].count);
  }
  of_canopies_ = canopies_->evaluate(profiles, packets, skies_);
}

void FurtherAnswers::store(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
                           std::span<const PacketAnswer> drawn) {
  FARLOD_EXPECTS(drawn.empty() || drawn.size() == packets.size());
  if (near_sky_) near_sky_->evaluate(packets);
  if (canopies_) find_canopies(packets, numbers, drawn);
  quantities_.find_light(std::span(profiles_).first(packets.size()), packets, light_);
  for (std::size_t n = 0; n < packets.size(); ++n) {
    store(n, packets[n], numbers.first(packets[n].count));
    numbers = numbers.subspan(packets[n].count);
  }
}

void FurtherAnswers::store(std::size_t packet, const ReceiverPacket& receivers, std::span<const std::uint32_t> numbers) {
  ProfiledPacket::Sky sky{};
  for (std::size_t l = 0; l < numbers.size(); ++l) {
    sky.svf[l] = answers_.svf[cell_.receivers[numbers[l]].index];
    if (near_sky_) sky.near_svf[l] = near_sky_->svf(packet, l);
    if (!near_svf_.empty()) sky.near_svf[l] = near_svf_[numbers[l]];
  }
  const std::size_t columns = quantities_.size();
  values_.resize(numbers.size() * columns);
  static const DimmedSky undimmed;
  const std::size_t layers = quantities_.light_layers();
  quantities_.evaluate({profiles_[packet], receivers, sky, canopies_ ? canopies_->dimmed(packet) : undimmed,
                        std::span(light_).subspan(packet * layers, layers), rows_},
                       values_);
  if (!of_canopies_.empty()) {
    const auto [first, count] = quantities_.canopy_columns();
    for (std::size_t l = 0; l < numbers.size(); ++l)
      write_canopy_columns(quantities_.quantities(), sky.svf[l], of_canopies_[packet][l],
                           std::span(values_).subspan(l * columns + first, count));
  }
  for (std::size_t l = 0; l < numbers.size(); ++l)
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(l * columns), columns,
                answers_.further.begin() + static_cast<std::ptrdiff_t>(cell_.receivers[numbers[l]].index * columns));
  if (views_) store_views(packet, numbers);
}

void FurtherAnswers::store_views(std::size_t packet, std::span<const std::uint32_t> numbers) {
  std::vector<Receiver> receivers;
  for (const std::uint32_t number : numbers) receivers.push_back(cell_.receivers[number]);
  views_->store(receivers, &profiles_[packet]);
}

}  // namespace farlod
