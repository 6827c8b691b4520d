// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "evaluate/canopy_answers.hpp"
#include "evaluate/further_quantities.hpp"
#include "evaluate/sky_answers.hpp"
#include "evaluate/view_factors.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/horizon_engine.hpp"
#include "package/far_map.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod {

/// Stores further quantities of the receivers of a cell, group by group of packets: first their profiles are drawn or traced, and
/// their svf is stored among the answers, then store() is called.
class FurtherAnswers {
 public:
  /// All must outlive it.
  FurtherAnswers(const FurtherQuantities& quantities, const CellReceivers& cell, const SkyAnswers& answers);
  ~FurtherAnswers();

  /// Profiles are those that the engine draws for a group.
  void listen_to(HorizonEngine& engine);
  /// Profiles are traced for a group.
  void trace(std::span<const ReceiverPacket> packets, const RayScene& scene, const std::stop_token& stop);

  /// The sky above the near geometry alone is drawn for each group, where the far map is this one; or it is known for each
  /// receiver of the cell.
  void draw_near_sky(const PackageReader& package, const FarHorizon& far);
  /// What crowns do to the sky is found for each group. The values of canopies are stored for what is drawn, and otherwise their
  /// places are left out.
  void draw_canopies(const PackageReader& package, CanopyCertainty certainty, const CanopyCity* pixels, std::stop_token stop);
  /// View factors are found of each group: no ray is traced above the horizons of profiles.
  void find_view_factors(const SeenScene& scene, const SkyDirections& directions, SkyWeight weight, std::stop_token stop);
  void set_near_sky(std::vector<float> svf) { near_svf_ = std::move(svf); }
  /// How many rays were traced against the whole city so far.
  [[nodiscard]] std::uint64_t retraced_rays() const { return canopies_ ? canopies_->retraced_rays() : 0; }

  /// `numbers` are those of the receivers in the cell, packet by packet; `drawn` is what was drawn for the group, if anything
  /// was.
  void store(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
             std::span<const PacketAnswer> drawn = {});

 private:
  class NearSky;
  void find_canopies(std::span<const ReceiverPacket> packets, std::span<const std::uint32_t> numbers,
                     std::span<const PacketAnswer> drawn);
  void store(std::size_t packet, const ReceiverPacket& receivers, std::span<const std::uint32_t> numbers);
  void store_views(std::size_t packet, std::span<const std::uint32_t> numbers);

  const FurtherQuantities& quantities_;
  const CellReceivers& cell_;
  const SkyAnswers& answers_;
  std::vector<SkyProfile> profiles_;  ///< of the packets of a group
  std::vector<float> near_svf_;
  std::unique_ptr<NearSky> near_sky_;
  std::unique_ptr<CanopyAnswers> canopies_;
  std::vector<SkiesOfPacket> skies_;  ///< of each packet, as the next one
  std::span<const CanopyAnswers::Answers> of_canopies_;
  std::optional<ViewFactors> views_;
  std::vector<PacketHorizon::Row> light_;  ///< of the packets of a group, as find_light gives it
  ProfiledPacket::Rows rows_;
  std::vector<float> values_;
};

}  // namespace farlod
