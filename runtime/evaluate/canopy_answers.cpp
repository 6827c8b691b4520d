// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/canopy_answers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/quantity_table.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/kernels.hpp"
#include "occlusion/placed_mesh.hpp"
#include "scene/canopy_around.hpp"

namespace farlod {
namespace {

/// 1 − svfaveg of the receivers of a packet: the view of solid things below the sky of their profiles that crowns hide, by some
/// hundred rays. `hidden` takes F of each azimuth, the mean of which it is. What the far city hides is below the sky of a
/// profile, and behind all crowns of the scene. The scene has the frame of the packet. Throws Cancelled when `stop` is asked for.
void find_hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths,
                               const CanopyScene& scene, const std::stop_token& stop, std::span<PacketHorizon::Row> hidden);

using Row = PacketHorizon::Row;

/// Parts of the sin² below the sky at an azimuth, a ray in the middle of each; and azimuths from one with a ray of some part to
/// the next. An azimuth has a ray in two of its parts, so that 320 azimuths have 640 rays.
constexpr std::size_t parts = 8, azimuths_between = 4, layers = parts / azimuths_between;
/// Above it is nothing that counts, and it is finite.
constexpr float steepest_row = 1e6F;

/// The slope below which this share of the sin² lies that is below the sky: with sin² = t²/(1 + t²), its square is
/// share · t² / (1 + (1 − share) t²).
Row slopes_at(float share, const Row& sky_from) {
  Row slopes;
  for (std::size_t l = 0; l < packet_lanes; ++l) {
    const float slope = std::min(sky_from[l], steepest_row);
    slopes[l] = slope * std::sqrt(share / (1.0F + (1.0F - share) * slope * slope));
  }
  return slopes;
}

/// A part below the sky at each azimuth: the parts go round with the azimuths.
class Layer {
 public:
  Layer(std::size_t layer, const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths)
      : profile_(profile), middles_(azimuths.size()), view_(azimuths.size()) {
    std::vector<Row> from(azimuths.size()), to(azimuths.size());
    for (std::size_t k = 0; k < azimuths.size(); ++k) {
      const auto part = static_cast<float>(layer * azimuths_between + k % azimuths_between);
      from[k] = slopes_at(part / parts, profile.sky_from[k]);
      middles_[k] = slopes_at((part + 0.5F) / parts, profile.sky_from[k]);
      to[k] = slopes_at((part + 1.0F) / parts, profile.sky_from[k]);
    }
    sky_kernels().find_sky_between(from.front().data(), to.front().data(), receivers, azimuths.view(), false,
                                   view_.front().data());
  }

  [[nodiscard]] const Row& slopes(std::size_t azimuth) const { return middles_[azimuth]; }
  /// The share of the view that the part has at an azimuth.
  [[nodiscard]] const Row& view(std::size_t azimuth) const { return view_[azimuth]; }
  /// Bits of the receivers that see the part.
  [[nodiscard]] std::uint32_t seen(std::size_t azimuth) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < packet_lanes; ++l) bits |= view_[azimuth][l] > 0.0F ? 1U << l : 0U;
    return bits;
  }
  /// Bits of the receivers that may see sky there, below an overhang.
  [[nodiscard]] std::uint32_t in_gap(std::size_t azimuth) const {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < packet_lanes && !profile_.gap_share.empty(); ++l)
      if (profile_.gap_from[azimuth][l] < middles_[azimuth][l] && middles_[azimuth][l] < profile_.gap_to[azimuth][l])
        bits |= 1U << l;
    return bits;
  }

 private:
  const SkyProfile& profile_;
  std::vector<Row> middles_, view_;
};

/// Bits of the rays that meet a crown first, of those that meet something solid. What is solid comes first, since it ends most
/// rays after some metres, and crowns are asked for no farther.
std::uint32_t meet_crown_first(const CanopyScene& scene, const RayOrigins& origins, const Occluder::Directions& directions,
                               std::uint32_t wanted, std::uint32_t in_gap) {
  const Occluder::Distances ends = scene.solid.distances(origins, directions, least_distance_m, wanted);
  std::uint32_t open = 0;
  for (std::size_t l = 0; l < packet_lanes; ++l) open |= ends[l] == std::numeric_limits<float>::infinity() ? 1U << l : 0U;
  return scene.crowns.met_before(ends, origins, directions, least_distance_m, wanted & ~(in_gap & open));
}

void find_hidden_behind_crowns(const SkyProfile& profile, const ReceiverPacket& receivers, const AzimuthSampling& azimuths,
                               const CanopyScene& scene, const std::stop_token& stop, std::span<Row> hidden) {
  const RayOrigins origins{receivers.x, receivers.y, receivers.z};
  const auto all = receivers.lanes_in_use();
  std::ranges::fill(hidden, Row{});
  for (std::size_t n = 0; n < layers; ++n) {
    throw_if_cancelled(stop);
    const Layer layer(n, profile, receivers, azimuths);
    for (std::size_t k = 0; k < azimuths.size(); ++k) {
      const std::uint32_t wanted = all & layer.seen(k);
      if (wanted == 0) continue;
      Occluder::Directions directions;
      directions.x.fill(azimuths.cosine()[k]);
      directions.y.fill(azimuths.sine()[k]);
      directions.z = layer.slopes(k);
      const std::uint32_t first = meet_crown_first(scene, origins, directions, wanted, layer.in_gap(k));
      for (std::size_t l = 0; l < packet_lanes; ++l)
        if ((first >> l & 1U) != 0) hidden[k][l] += static_cast<float>(azimuths_between * azimuths.size()) * layer.view(k)[l];
    }
  }
}

}  // namespace

void write_canopy_columns(const Quantities& quantities, float svf, const CanopyAnswer& answer, std::span<float> values) {
  ValuesOfReceiver of_receiver(values);
  for (const QuantityRow& row : quantity_table())
    if (row.word.is_of_crowns && row.is_asked(quantities)) row.add_of_crowns(quantities, svf, answer, of_receiver);
  FARLOD_EXPECTS(of_receiver.count() == values.size());
}

void store_traced_canopies(const CellReceivers& cell, const CanopyScene& scene, Point2d scene_from_cell_m,
                           const SkyDirections& directions, const FurtherQuantities& quantities, const SkyAnswers& answers,
                           const std::stop_token& stop) {
  const ColumnRange columns = quantities.canopy_columns();
  for_each_normal(cell.receivers, [&](std::span<const Receiver> group) {
    std::vector<Point3f> origins;
    for (const Receiver& r : group) origins.push_back(placed(r.p_cell, scene_from_cell_m));
    const std::vector<Point3d> facing = directions.facing_as(group.front());
    std::vector<SkyHalves::Bits> halves;
    for (const Point3d& d : facing) halves.push_back(quantities.halves().of(d));
    const std::vector<CanopyLoss> losses = trace_canopies(scene, origins, {facing, halves, directions.ray_count()}, stop);
    for (std::size_t n = 0; n < group.size(); ++n) {
      const float svf = answers.svf[group[n].index];
      const SvfInterval exact{svf, svf, svf};
      write_canopy_columns(quantities.quantities(), svf, {losses[n], svf_total_of({exact, exact}, losses[n].light, 0.0F)},
                           answers.further.subspan(group[n].index * quantities.size() + columns.first, columns.count));
    }
  });
}

SkiesOfPacket skies_of(const PacketAnswer& packet, const CellReceivers& cell, std::span<const std::uint32_t> numbers,
                       const SkyAnswers& answers) {
  SkiesOfPacket skies;
  for (std::size_t l = 0; l < numbers.size(); ++l) {
    // That of rays may lie beside the one that was drawn
    const float svf = answers.svf[cell.receivers[numbers[l]].index];
    const SvfInterval& drawn = packet.svf[l];
    skies[l] = {{std::min(drawn.low, svf), svf, std::max(drawn.high, svf)}, packet.drawn[l]};
  }
  return skies;
}

CanopyAnswers::CanopyAnswers(const PackageReader& package, const CellReceivers& cell, const FurtherQuantities& further,
                             CanopyCertainty certainty, const CanopyCity* pixels, std::stop_token stop)
    : package_(package), cell_(cell), further_(further), certainty_(certainty), stop_(std::move(stop)) {
  if (pixels == nullptr) return;
  FARLOD_EXPECTS(!certainty.bounds && !certainty.max_error);
  on_pixels_.emplace(*pixels, cell.cell);
  knows_hidden_ = pixels->field.knows_solids();
}

CrownsOfCell& CanopyAnswers::crowns() {
  if (!crowns_)
    crowns_.emplace(package_, cell_, further_.quantities().canopy, further_.azimuths(),
                    certainty_.bounds ? merging_for_bounds : CrownMerging(),
                    certainty_.bounds || certainty_.max_error ? no_pixel_merging : PixelMerging());
  return *crowns_;
}

void CanopyAnswers::make_room(std::size_t packets) {
  const Quantities& q = further_.quantities();
  const std::size_t azimuths = further_.azimuths().size();
  answers_.assign(packets, Answers{});
  shares_.assign(packets, CanopyShares{});
  marched_.assign(packets, 0);
  behind_sums_.resize(packets);
  hidden_sums_.resize(packets);
  dimmed_.resize(packets);
  for (DimmedSky& dimmed : dimmed_) dimmed.clear();
  behind_.resize(q.directional_vegetation ? packets * azimuths : 0);
  hidden_.resize(q.svfaveg || q.directional_vegetation || q.sky_shares ? packets * azimuths : 0);
}

CanopyAnswers::Rows CanopyAnswers::rows_of(std::size_t packet) {
  const std::size_t azimuths = further_.azimuths().size();
  const auto part = [&](std::vector<PacketHorizon::Row>& rows) {
    return rows.empty() ? std::span<PacketHorizon::Row>() : std::span(rows).subspan(packet * azimuths, azimuths);
  };
  return {part(behind_), part(hidden_)};
}

void CanopyAnswers::see(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets) {
  make_room(packets.size());
  if (on_pixels_) march(profiles, packets);
  find_shares(profiles, packets);
}

std::span<const CanopyAnswers::Answers> CanopyAnswers::evaluate(std::span<const SkyProfile> profiles,
                                                                std::span<const ReceiverPacket> packets,
                                                                std::span<const SkiesOfPacket> skies) {
  FARLOD_EXPECTS(skies.size() == packets.size() && shares_.size() == packets.size());
  for (std::size_t n = 0; n < packets.size(); ++n) answers_[n] = of_packet(n, profiles[n], packets[n], skies[n]);
  return answers_;
}

void CanopyAnswers::march(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets) {
  on_pixels_->evaluate(profiles, packets,
                       {behind_sums_, hidden_sums_, behind_, knows_hidden_ ? std::span(hidden_) : std::span<PacketHorizon::Row>(),
                        wanted_of(dimmed_)},
                       marched_);
  const auto lost = static_cast<float>(1.0 - transmissivity_of(on_pixels_->foliage(), further_.quantities().canopy));
  for (std::size_t n = 0; n < packets.size(); ++n)
    for (std::size_t l = 0; l < packets[n].count; ++l)
      if (has_bit(marched_[n], l)) {
        shares_[n].behind[l] = behind_sums_[n][l];
        shares_[n].lost[l] = lost * behind_sums_[n][l];
      }
  for (DimmedSky& dimmed : dimmed_)
    for (DimmedSlopes& slopes : dimmed) slopes.lost = lost;
}

void CanopyAnswers::find_shares(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets) {
  if (!on_pixels_) {
    if (!crowns().are_none()) crowns().evaluate(profiles, packets, shares_, {behind_, wanted_of(dimmed_)});
    return;
  }
  some_behind_.resize(behind_.empty() ? 0 : further_.azimuths().size());
  some_dimmed_.resize(1);
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const std::uint32_t left = packets[n].lanes_in_use() & ~marched_[n];
    if (left == 0 || crowns().are_none()) continue;
    CanopyShares shares;
    crowns().evaluate(profiles.subspan(n, 1), packets.subspan(n, 1), {&shares, 1}, {some_behind_, wanted_of(some_dimmed_)});
    copy_lanes(shares.lost, left, shares_[n].lost);
    copy_lanes(shares.behind, left, shares_[n].behind);
    for (std::size_t k = 0; k < some_behind_.size(); ++k) copy_lanes(some_behind_[k], left, rows_of(n).behind[k]);
    append_lanes(some_dimmed_.front(), left, dimmed_[n]);
  }
}

CanopyAnswers::Answers CanopyAnswers::of_packet(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers,
                                                const SkiesOfPacket& skies) {
  Answers answers{};
  if (!on_pixels_ && crowns().are_none()) {
    for (std::size_t l = 0; l < receivers.count; ++l) answers[l].svf_total = skies[l].svf;
    return answers;
  }
  const PacketHorizon::Lanes error = certainty_.bounds ? crowns().most_error(profile, receivers) : PacketHorizon::Lanes{};
  const CanopyShares& shares = shares_[packet];
  for (std::size_t l = 0; l < receivers.count; ++l)
    answers[l] = {{shares.lost[l], shares.behind[l]}, svf_total_of(skies[l], shares.lost[l], error[l])};
  add_directions(packet, profile, receivers, answers);
  if (!certainty_.max_error) return answers;
  count_by_name(profile, receivers, skies, too_wide(receivers, answers), answers);
  trace(receivers, skies, too_wide(receivers, answers), answers);
  for (std::size_t l = 0; l < receivers.count; ++l) {
    SvfInterval& total = answers[l].svf_total;
    total = within_error(total, static_cast<float>(*certainty_.max_error));
    total.estimate = std::min(total.estimate, skies[l].svf.estimate);
  }
  return answers;
}

std::uint32_t CanopyAnswers::too_wide(const ReceiverPacket& receivers, const Answers& answers) const {
  std::uint32_t wide = 0;
  for (std::size_t l = 0; l < receivers.count; ++l)
    wide |= static_cast<double>(answers[l].svf_total.width()) > 2.0 * *certainty_.max_error ? 1U << l : 0U;
  return wide;
}

void CanopyAnswers::count_by_name(const SkyProfile& profile, const ReceiverPacket& receivers, const SkiesOfPacket& skies,
                                  std::uint32_t wanted, Answers& answers) {
  if (wanted == 0 || count_crowns_near(package_, cell_.cell, no_merging.farthest_m) > most_crowns_by_name) return;
  if (!by_name_)
    by_name_.emplace(package_, cell_, further_.quantities().canopy, further_.azimuths(), no_merging, no_pixel_merging);
  CanopyShares shares;
  by_name_->evaluate({&profile, 1}, {&receivers, 1}, {&shares, 1}, {});
  const PacketHorizon::Lanes error = by_name_->most_error(profile, receivers);
  for (std::size_t l = 0; l < receivers.count; ++l) {
    if (((wanted >> l) & 1U) == 0) continue;
    answers[l].loss.light = shares.lost[l];
    answers[l].loss.sky = shares.behind[l];
    answers[l].svf_total = svf_total_of(skies[l], shares.lost[l], error[l]);
  }
}

void CanopyAnswers::trace(const ReceiverPacket& receivers, const SkiesOfPacket& skies, std::uint32_t wanted, Answers& answers) {
  if (wanted == 0) return;
  std::vector<Receiver> traced;
  for (std::size_t l = 0; l < receivers.count; ++l)
    if (((wanted >> l) & 1U) != 0)
      traced.push_back({l,
                        {receivers.x[l], receivers.y[l], receivers.z[l]},
                        {receivers.normal_x[l], receivers.normal_y[l], receivers.normal_z[l]}});
  const PlacedScene scene = certainty_.city->seen_from(cell_.cell);
  const CrownOccluder& crowns = certainty_.city->crowns(further_.quantities().canopy);
  retraced_rays_ += traced.size() * certainty_.directions->ray_count();
  const std::vector<float> totals =
      trace_svf_totals({scene.occluder, crowns}, scene.scene_from_cell_m, *certainty_.directions, traced, stop_);
  for (std::size_t n = 0; n < traced.size(); ++n) {
    const float total = std::min(totals[n], skies[traced[n].index].svf.estimate);
    answers[traced[n].index].svf_total = {total, total, total};
  }
}

void CanopyAnswers::add_directions(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers,
                                   Answers& answers) {
  const double share = 1.0 / static_cast<double>(further_.azimuths().size());
  const Rows rows = rows_of(packet);
  if (!rows.behind.empty()) add_halves(rows.behind, &CanopyLoss::sky_of_half, share, answers);
  if (rows.hidden.empty()) return;
  if (!knows_hidden_ || marched_[packet] != receivers.lanes_in_use()) trace_hidden(packet, profile, receivers);
  SkyHalves::Sums sums{};
  for (const PacketHorizon::Row& row : rows.hidden)
    for (std::size_t l = 0; l < receivers.count; ++l) sums[l] += static_cast<double>(row[l]);
  for (std::size_t l = 0; l < receivers.count; ++l) answers[l].loss.building = static_cast<float>(share * sums[l]);
  if (!rows.behind.empty()) add_halves(rows.hidden, &CanopyLoss::building_of_half, share, answers);
}

void CanopyAnswers::trace_hidden(std::size_t packet, const SkyProfile& profile, const ReceiverPacket& receivers) {
  const std::span<PacketHorizon::Row> hidden = rows_of(packet).hidden;
  const std::uint32_t left = knows_hidden_ ? receivers.lanes_in_use() & ~marched_[packet] : receivers.lanes_in_use();
  some_hidden_.assign(hidden.size(), PacketHorizon::Row{});
  if (!crowns().crowns().empty()) {
    if (!occluder_) {
      near_.emplace(near_scene(package_, cell_.cell));
      occluder_.emplace(crowns().crowns(), further_.quantities().canopy, stop_);
    }
    find_hidden_behind_crowns(profile, receivers, further_.azimuths(), {*near_, *occluder_}, stop_, some_hidden_);
  }
  for (std::size_t k = 0; k < hidden.size(); ++k) copy_lanes(some_hidden_[k], left, hidden[k]);
}

void CanopyAnswers::add_halves(std::span<const PacketHorizon::Row> terms,
                               std::array<float, SkyHalves::count> CanopyLoss::*of_half, double share, Answers& answers) const {
  const std::array<SkyHalves::Sums, SkyHalves::count> sums = further_.halves().sums(terms);
  for (std::size_t h = 0; h < SkyHalves::count; ++h)
    for (std::size_t l = 0; l < answers.size(); ++l) (answers[l].loss.*of_half)[h] = static_cast<float>(share * sums[h][l]);
}

}  // namespace farlod
