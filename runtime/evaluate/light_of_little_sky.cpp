// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/light_of_little_sky.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace farlod {
namespace {

/// What is made of the light of the sky; hours of sun and shade are not.
constexpr bool is_of_light(const QuantityRow& row) {
  using enum Quantity;
  return row.quantity == irradiation || row.quantity == irradiance || row.quantity == illuminance ||
         row.quantity == sky_component;
}

/// What is asked of the light alone.
Quantities only_light(const Quantities& asked) {
  Quantities light;
  light.light = asked.light;
  light.canopy = asked.canopy;
  for (const QuantityRow& row : quantity_table())
    if (is_of_light(row) && row.is_asked(asked)) row.ask(light);
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
  const auto is_asked = [&](const QuantityRow& row) { return is_of_light(row) && row.is_asked(evaluation.settings.further); };
  if (evaluation.settings.azimuths >= azimuths || std::ranges::none_of(quantity_table(), is_asked)) return nullptr;
  return std::make_unique<const LightOfLittleSky>(evaluation);
}

LightOfLittleSky::LightOfLittleSky(const Evaluation& evaluation)
    : evaluation_(evaluation), light_(only_light(evaluation.settings.further)) {
  for (const QuantityRow& row : quantity_table())
    if (is_of_light(row) && row.is_asked(light_))
      columns_.push_back({range_of(row.quantity, evaluation.settings.further), range_of(row.quantity, light_)});
}

void LightOfLittleSky::improve(const CellReceivers& cell, const SkyAnswers& answers, const Answer& answer) const {
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
  std::call_once(once_, [this] {
    finer_ = std::make_unique<const Evaluation>(evaluation_.package, finer(evaluation_.settings, light_), evaluation_.stop,
                                                evaluation_.city, evaluation_.further.light_of_period());
  });
  const std::size_t all = evaluation_.further.size(), of_light = finer_->further.size();
  std::vector<float> svf(indices.size()), light(indices.size() * of_light);
  answer(*finer_, some, SkyAnswers(svf, {}, {}, light));
  for (std::size_t n = 0; n < indices.size(); ++n)
    for (const auto& [asked, finer] : columns_)
      std::ranges::copy(std::span(light).subspan(n * of_light + finer.first, finer.count),
                        answers.further.subspan(indices[n] * all + asked.first).begin());
}

}  // namespace farlod
