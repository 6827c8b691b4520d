// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/light_of_little_sky.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace farlod {
namespace {

constexpr Quantity quantities_of_light[] = {Quantity::irradiation, Quantity::irradiance, Quantity::illuminance,
                                            Quantity::sky_component};

/// What is asked of the light alone.
Quantities only_light(const Quantities& asked) {
  Quantities light;
  light.light = asked.light;
  light.canopy = asked.canopy;
  light.irradiation = asked.irradiation;
  light.irradiance = asked.irradiance;
  light.illuminance = asked.illuminance;
  light.sky_component = asked.sky_component;
  return light;
}

SkySettings finer(const SkySettings& settings, Quantities light) {
  SkySettings finer = settings;
  finer.azimuths = LightOfLittleSky::azimuths;
  finer.allowed_error.reset();
  finer.further = std::move(light);
  return finer;
}

}  // namespace

std::unique_ptr<const LightOfLittleSky> LightOfLittleSky::of(const Evaluation& evaluation) {
  auto light = std::make_unique<const LightOfLittleSky>(evaluation);
  return light->columns_.empty() || evaluation.settings.azimuths >= azimuths ? nullptr : std::move(light);
}

LightOfLittleSky::LightOfLittleSky(const Evaluation& evaluation)
    : evaluation_(evaluation), light_(only_light(evaluation.settings.further)) {
  for (const Quantity quantity : quantities_of_light)
    if (const ColumnRange asked = range_of(quantity, evaluation.settings.further); asked.count > 0)
      columns_.push_back({asked, range_of(quantity, light_)});
}

void LightOfLittleSky::make_finer() const {
  finer_ = std::make_unique<const Evaluation>(evaluation_.package, finer(evaluation_.settings, light_), evaluation_.stop,
                                              evaluation_.city);
  horizons_ = horizon_method(*finer_);
}

void LightOfLittleSky::improve(const CellReceivers& cell, const SkyAnswers& answers) const {
  CellReceivers some{cell.cell, {}};
  std::vector<std::size_t> indices;
  for (const Receiver& r : cell.receivers) {
    // No light comes of no sky
    if (const float svf = answers.svf[r.index]; !(svf > 0.0F && svf < little_svf)) continue;
    indices.push_back(r.index);
    some.receivers.push_back(r);
    some.receivers.back().index = some.receivers.size() - 1;
  }
  if (indices.empty()) return;
  std::call_once(once_, [this] { make_finer(); });
  const std::size_t all = evaluation_.further.size(), of_light = finer_->further.size();
  std::vector<float> svf(indices.size()), light(indices.size() * of_light);
  horizons_->evaluate(some, SkyAnswers(svf, {}, {}, light));
  for (std::size_t n = 0; n < indices.size(); ++n)
    for (const auto& [asked, finer] : columns_)
      std::ranges::copy(std::span(light).subspan(n * of_light + finer.first, finer.count),
                        answers.further.subspan(indices[n] * all + asked.first).begin());
}

}  // namespace farlod
