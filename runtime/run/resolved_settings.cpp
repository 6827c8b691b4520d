// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/resolved_settings.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include "contract/run_settings.hpp"
#include "evaluate/error_budget.hpp"
#include "farlod/error.hpp"
#include "receivers/surface_receivers.hpp"

namespace farlod {
namespace {

/// Without trailing zeros.
std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// An enumeration may hold any number, when a caller casts to it.
template <class Enum>
void require_one_of(const char* setting, Enum value, Enum last) {
  if (value < Enum{} || value > last)
    throw InvalidArgument(std::string(setting) + " is " + std::to_string(static_cast<int>(value)) +
                          ", which is none of its values: choose one that its declaration lists");
}

void require_count_between(const char* setting, std::size_t value, std::size_t low, std::size_t high) {
  if (value < low || value > high)
    throw InvalidArgument(std::string(setting) + " is " + std::to_string(value) + ": give a number from " + std::to_string(low) +
                          " to " + std::to_string(high));
}

void check(const EvaluationSettings& s) {
  require_one_of("engine", s.engine, Engine::near_only);
  require_one_of("weight", s.weight, SkyWeight::solid_angle);
  require_one_of("directions", s.directions, DirectionSet::fibonacci);
  if (s.azimuths) require_count_between("azimuths", *s.azimuths, 4, 1'000'000);
  if (s.rays) require_count_between("rays", *s.rays, 1, 10'000'000);
  if (s.max_error) require_between("max_error", *s.max_error, 0.0001, 1.0);
}

/// What is left of the allowed error for the far map.
double far_error_of(const EvaluationSettings& s, SkySettings sky) {
  // That there is one decides whether the error of rays counts; how large it is follows from that
  sky.max_far_error = *s.max_error;
  const double left = *s.max_error - sampling_error_of(sky);
  if (left > 0.0) return left;
  const double share = 0.75 * *s.max_error;
  throw InvalidArgument(
      "a largest error of " + text_of(*s.max_error) + " is less than " + std::to_string(sky.rays) + " rays and " +
      std::to_string(sky.azimuths) + " azimuths can keep: leave the numbers of rays and azimuths out, or give at least " +
      std::to_string(rays_for_sampling_error(share)) + " rays and " + std::to_string(azimuths_for_error(share)) + " azimuths");
}

SkySettings sky_of(const EvaluationSettings& s) {
  SkySettings sky;
  sky.engine = s.engine;
  sky.weight = s.weight;
  sky.directions = s.directions;
  sky.rays = s.rays ? *s.rays : s.max_error ? rays_for_sampling_error(0.5 * *s.max_error) : default_rays;
  sky.azimuths = s.azimuths ? *s.azimuths : s.max_error ? azimuths_for_error(0.5 * *s.max_error) : default_azimuths;
  if (s.max_error) sky.max_far_error = far_error_of(s, sky);
  return sky;
}

}  // namespace

void require_between(const char* setting, double value, double low, double high) {
  if (low <= value && value <= high) return;
  throw InvalidArgument(std::string(setting) + " is " + text_of(value) + ": give a number from " + text_of(low) + " to " +
                        text_of(high));
}

ResolvedSettings resolved(const EvaluationSettings& evaluation, const RunSettings& run) {
  check(evaluation);
  require_usable(run);
  ResolvedSettings s;
  s.sky = sky_of(evaluation);
  s.accuracy = {s.sky.azimuths, s.sky.rays, sampling_error_of(s.sky), s.sky.max_far_error};
  s.bounds = evaluation.bounds;
  s.verify = evaluation.verify;
  s.threads = thread_count(run);
  s.run = run;
  return s;
}

Accuracy accuracy_of(const EvaluationSettings& settings) { return resolved(settings, {}).accuracy; }

Placing resolved(const Placing& placing) {
  require_one_of("above", placing.above, HeightAbove::sea_level);
  const double lowest_m = placing.above == HeightAbove::sea_level ? -100'000.0 : 0.0;
  require_between("height_m", placing.height_m, lowest_m, placing.above == HeightAbove::sea_level ? 100'000.0 : 10'000.0);
  if (placing.above == HeightAbove::sea_level) return placing;
  return {placing.above, std::max(placing.height_m, static_cast<double>(surface_offset_m))};
}

float package_height_m(const Placing& placing, const package::Manifest& manifest) {
  const double origin_m = placing.above == HeightAbove::sea_level ? manifest.height_origin_m : 0.0;
  return static_cast<float>(placing.height_m - origin_m);
}

}  // namespace farlod
