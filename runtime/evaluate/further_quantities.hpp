// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "canopy/dimmed_sky.hpp"
#include "evaluate/quantity_table.hpp"
#include "evaluate/sky_directions.hpp"
#include "farlod/point.hpp"
#include "farlod/quantities.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_profile.hpp"
#include "occlusion/occluder.hpp"
#include "package/manifest.hpp"
#include "radiation/light_table.hpp"

namespace farlod {

/// Where a receiver's values have its horizons and their distances: from `elevations` and `distances` on, one for each direction.
struct HorizonColumns {
  std::size_t elevations = 0, distances = 0;
  std::vector<Point2d> directions_grid = {};  ///< of length 1; empty where no distances are asked for
};

/// Fills the distances of a receiver whose horizons are known: level ones, in metres, to what is met nearest just below the
/// horizon. NaN where the horizon is level ground, and where nothing is met within two degrees below it. `origin` is the place of
/// the receiver in a scene of the whole city.
void trace_horizon_distances(const Occluder& city, const Point3f& origin, const HorizonColumns& columns, std::span<float> values);

/// Azimuths at which horizons are sampled, where these quantities are asked for: at least so many, and a multiple of the
/// horizons.
[[nodiscard]] std::size_t azimuths_for(const Quantities& quantities, std::size_t at_least);

/// Where a receiver's values have its views, of each of the quantities that say what fills the view.
struct ViewRanges {
  ColumnRange all, below, cube, sphere, eye, building;
};
[[nodiscard]] ViewRanges view_ranges_of(const Quantities& quantities);

/// Takes the values of the receivers of a packet, column by column.
class QuantityColumns {
 public:
  QuantityColumns(std::size_t size, std::span<float> values) : size_(size), values_(values) {}

  void add(const PacketHorizon::Lanes& column) {
    for (std::size_t l = 0; l * size_ < values_.size(); ++l) values_[l * size_ + next_] = column[l];
    ++next_;
  }
  void skip(std::size_t count) { next_ += count; }
  [[nodiscard]] std::size_t count() const { return next_; }

 private:
  std::size_t size_, next_ = 0;
  std::span<float> values_;
};

/// A packet of receivers, and what further quantities are made of.
struct ProfiledPacket {
  /// Working memory, kept from packet to packet.
  struct Rows {
    std::vector<PacketHorizon::Row> low, high, terms, open_terms;
    std::vector<PacketHorizon::Row> lost;  ///< what crowns take of the light
  };
  /// svf as it is answered, and with needs_near_sky() that of the near geometry alone.
  struct Sky {
    PacketHorizon::Lanes svf, near_svf;
  };
  const SkyProfile& profile;
  const ReceiverPacket& receivers;
  const Sky& sky;
  const DimmedSky& dimmed;                    ///< by crowns
  std::span<const PacketHorizon::Row> light;  ///< of the packet, as find_light gives it
  Rows& rows;
};

/// What is computed beside the sky view factor, from profiles of the sky: the same for all methods that make profiles.
/// Immutable: threads may share it, each with working memory of its own.
class FurtherQuantities {
 public:
  /// `azimuths` is a number that azimuths_for gave. `light` is that of the quantities, where somebody has it already.
  FurtherQuantities(const Quantities& quantities, std::size_t azimuths, const package::Manifest& manifest,
                    std::shared_ptr<const LightOfPeriod> light = nullptr);

  /// Values of a receiver: as many as columns_of names.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// With horizons, the first azimuth is true north; without, they are those of runs that ask for nothing further.
  [[nodiscard]] const AzimuthSampling& azimuths() const { return azimuths_; }
  [[nodiscard]] ProfileRows profile_rows() const { return {.solid_sky = quantities_.svf_solid, .light_sky = needs_light()}; }
  /// Whether anything is made of profiles: canopies, shadow patches and views alone may be traced without them.
  [[nodiscard]] bool needs_profiles() const {
    return size_ > crowns_.count + shadow_patches_.count + views_.all.count + views_.below.count + views_.cube.count +
                       views_.sphere.count + views_.eye.count + views_.building.count;
  }
  [[nodiscard]] bool needs_view_factors() const { return quantities_.view_factors || quantities_.view_factors_below; }
  [[nodiscard]] bool needs_near_sky() const { return quantities_.hidden; }
  /// Whether something is made of light, which crowns dim.
  [[nodiscard]] bool needs_dimmed_sky() const { return needs_light() || quantities_.shade || quantities_.sunlit_total; }
  /// Whether crowns count for anything.
  [[nodiscard]] bool needs_crowns() const { return crowns_.count > 0 || needs_dimmed_sky(); }

  /// Where the horizons are whose distances must be traced: profiles do not tell them, and evaluate() leaves their places out.
  [[nodiscard]] HorizonColumns horizon_columns() const;
  /// Where the values of canopies are, which take crowns beside profiles (CanopyAnswers): evaluate() leaves their places out.
  [[nodiscard]] const ColumnRange& canopy_columns() const { return crowns_; }
  /// Where the shadow patches are, which rays find: evaluate() leaves their places out.
  [[nodiscard]] const ColumnRange& shadow_columns() const { return shadow_patches_; }
  /// Where the views are, which rays find: evaluate() leaves their places out.
  [[nodiscard]] const ViewRanges& view_columns() const { return views_; }
  [[nodiscard]] const Quantities& quantities() const { return quantities_; }
  /// Null where nothing is made of light.
  [[nodiscard]] const std::shared_ptr<const LightOfPeriod>& light_of_period() const { return light_of_period_; }
  /// The halves of the sky, for the azimuths.
  [[nodiscard]] const SkyHalves& halves() const { return halves_; }

  /// The layers of a LightTable; none where nothing is made of light.
  [[nodiscard]] std::size_t light_layers() const { return light_ ? light_->layers() : 0; }
  /// What the receivers of some packets get of each layer of the light, as their profiles say: light[packet][layer][receiver].
  void find_light(std::span<const SkyProfile> profiles, std::span<const ReceiverPacket> packets,
                  std::vector<PacketHorizon::Row>& light) const;
  /// Writes the values of the packet's receivers, one receiver after the other, in the order of columns_of.
  void evaluate(const ProfiledPacket& packet, std::span<float> values) const;

  /// The functions of the table's rows: each adds the columns of its quantity.
  void add_solid(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_directional(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_hidden(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_horizons(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_distances(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_patches(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_sunlit(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_sunlit_total(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_shadow_patches(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_irradiation(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_irradiance(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_illuminance(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_shade(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_sky_component(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_views(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_views_below(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_views_of_cube(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_views_of_sphere(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_views_of_eye(const ProfiledPacket& packet, QuantityColumns& columns) const;
  void add_view_of_building(const ProfiledPacket& packet, QuantityColumns& columns) const;

 private:
  void divide_into_patches();
  void sort_sun_of_light();
  [[nodiscard]] bool needs_light() const {
    return quantities_.irradiation || quantities_.irradiance || quantities_.illuminance || quantities_.sky_component;
  }
  /// What crowns take of each layer of the light.
  void find_lost_light(const ProfiledPacket& packet) const;
  using Lanes = PacketHorizon::Lanes;
  /// What each receiver gets in the period from the sun, from the sky, and once reflected.
  struct LightParts {
    Lanes direct, diffuse, reflected;
    Lanes beside_profile;  ///< of `diffuse`, what the sky view factor knows beside the profile: a share of that on a level plane
    [[nodiscard]] Lanes sum() const;
  };
  [[nodiscard]] LightParts light_parts(const ProfiledPacket& packet) const;
  /// What a receiver gets reflected of all light of a layer.
  [[nodiscard]] float reflected(const ProfiledPacket& packet, std::size_t lane, std::size_t layer) const;
  /// All that each receiver gets of one of the totals of the table. Those of all months add up to the period.
  [[nodiscard]] Lanes total_light(const ProfiledPacket& packet, const LightParts& parts, std::size_t total) const;

  /// A patch that a part of the turn around an azimuth lies in, and the share of it that does.
  struct PatchShare {
    std::uint32_t patch = 0;
    float share = 0.0F;
  };
  /// A band of patches between two slopes, the first of which is `first_patch`.
  struct Band {
    float slope_from = 0.0F, slope_to = 0.0F;
    std::uint32_t first_patch = 0, patches = 0;
    std::vector<std::array<PatchShare, 2>> of_azimuth;  ///< no azimuth reaches into more than two
  };
  /// The positions of the sun that are nearest to an azimuth, by their slopes, and the hours of each and all above it.
  struct SunAtAzimuth {
    std::vector<float> slopes;
    std::vector<double> hours;
    [[nodiscard]] double hours_between(float from, float to) const;
  };
  /// Those of a time, and their hours with a sun above the horizon.
  struct SunOfTime {
    std::vector<SunAtAzimuth> at_azimuths;
    double hours = 0.0;
  };
  [[nodiscard]] SunOfTime sun_of(std::span<const LightInterval> intervals) const;
  [[nodiscard]] Lanes shade_of(const SunOfTime& time, const ProfiledPacket& packet) const;
  [[nodiscard]] std::size_t nearest_azimuth(Angle azimuth) const;
  [[nodiscard]] std::vector<SunAtAzimuth> sorted_by_azimuth(std::span<const SunPosition> sun) const;
  /// Those in which the sun stands between two slopes of an azimuth, in the sky of a receiver and before its front.
  [[nodiscard]] double hours_between(float from, float to, const SunAtAzimuth& sun, std::size_t azimuth,
                                     const ProfiledPacket& packet, std::size_t lane) const;
  [[nodiscard]] std::array<double, ReceiverPacket::lanes> hours_of(const std::vector<SunAtAzimuth>& sun,
                                                                   const ProfiledPacket& packet) const;
  /// The same, less what crowns take of each.
  [[nodiscard]] std::array<double, ReceiverPacket::lanes> hours_past_crowns(const std::vector<SunAtAzimuth>& sun,
                                                                            const ProfiledPacket& packet) const;

  Quantities quantities_;
  std::size_t size_;
  ColumnRange crowns_, shadow_patches_;
  ViewRanges views_;
  AzimuthSampling azimuths_;
  std::vector<double> turns_;  ///< of each azimuth: clockwise from true north, as a share of the turn
  std::vector<std::size_t> azimuth_of_horizon_;
  SkyHalves halves_;
  std::vector<Band> bands_;
  std::vector<SunAtAzimuth> sun_;
  SunOfTime sun_of_light_;
  std::vector<SunOfTime> sun_of_steps_;
  std::shared_ptr<const LightOfPeriod> light_of_period_;
  std::optional<LightTable> light_;
};

}  // namespace farlod
