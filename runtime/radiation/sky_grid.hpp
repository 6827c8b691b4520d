// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "farlod/angle.hpp"
#include "farlod/light.hpp"
#include "radiation/perez_sky.hpp"

namespace farlod {

[[nodiscard]] constexpr double energy_kwh_m2(double mean_w_m2, double hours) { return mean_w_m2 * hours / 1000.0; }

/// The sky's light of many intervals, in bins of azimuth and elevation of 2.5°. The energy of an interval on a level plane is
/// kept, whatever the bins: radiances are scaled to it.
class SkyGrid {
 public:
  static constexpr std::size_t azimuths = 144, bands = 36;

  SkyGrid();

  /// Adds the diffuse light of an interval, in kWh/m² on a level plane. Without a sun, and by the model isotropic, it comes from
  /// everywhere alike.
  void add(const LightInterval& interval, SkyModel model) {
    add(interval, model, energy_kwh_m2(interval.diffuse_w_m2, interval.hours));
  }
  /// The same of another amount on a level plane, spread alike.
  void add(const LightInterval& interval, SkyModel model, double on_level);
  /// Adds all that another grid has.
  void add(const SkyGrid& other);
  /// In kWh/(m² sr): between the middles of bins it is interpolated, and beyond those of the first and the last band constant.
  [[nodiscard]] double radiance(double turn, Angle elevation) const;
  [[nodiscard]] double on_level() const { return on_level_; }

 private:
  struct Band {
    double sine = 0.0, cosine = 0.0;  ///< of the middle's elevation
    double weight = 0.0;              ///< ∫ sin θ dω over a bin
  };
  void add_uniform(double energy) { uniform_ += energy; }
  void add_perez(const SkyState& state, Angle sun_azimuth, double energy);

  std::vector<Band> bands_;
  std::vector<double> cosines_, sines_;  ///< of the azimuths of the bins' middles
  std::vector<double> radiances_;        ///< radiances_[band][azimuth]
  std::vector<double> relative_;         ///< working memory
  double on_level_ = 0.0, uniform_ = 0.0;
};

/// The middle of where the sun is in an interval, while it is up; none at night.
[[nodiscard]] std::optional<SunPosition> mean_sun(const LightInterval& interval);

}  // namespace farlod
