// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/resolved_settings.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "base/run_settings.hpp"
#include "evaluate/error_budget.hpp"
#include "evaluate/further_quantities.hpp"
#include "farlod/error.hpp"
#include "horizon/packet_envelope.hpp"
#include "receivers/point_receivers.hpp"

namespace farlod {
namespace {

/// The share of an allowed error of svf_total for what is between the samples; the rest is for the far map and merged crowns.
constexpr double sampling_share = 0.75;

constexpr std::size_t least_azimuths_of_bounds = PacketEnvelope::least_azimuths;

void check(const CanopySettings& canopy) {
  require_one_of("further.canopy.rule", canopy.rule, CanopyRule::beer);
  require_one_of("further.canopy.season", canopy.season, Season::leaf_off);
  if (canopy.transmissivity) require_between("further.canopy.transmissivity", *canopy.transmissivity, 0.0, 1.0);
  require_between("further.canopy.extinction_per_m", canopy.extinction_per_m, 0.001, 100.0);
}

void check(const SunPosition& sun) {
  require_between("an azimuth of the sun, in degrees", sun.azimuth.degrees(), -360.0, 360.0);
  require_between("an elevation of the sun, in degrees", sun.elevation.degrees(), -90.0, 90.0);
  require_between("the hours of a position of the sun", sun.hours, 0.0, 8784.0);
}

void check(const Light& light) {
  require_one_of("further.light.sky_model", light.sky_model, SkyModel::isotropic);
  require_between("further.light.ground_albedo", light.ground_albedo, 0.0, 1.0);
  require_between("further.light.facade_albedo", light.facade_albedo, 0.0, 1.0);
  for (const LightInterval& interval : light.intervals) {
    require_between("the hours of an interval of light", interval.hours, 0.0, 8784.0);
    require_between("a direct irradiance, in W/m²", interval.direct_normal_w_m2, 0.0, 2000.0);
    require_between("a diffuse irradiance, in W/m²", interval.diffuse_w_m2, 0.0, 2000.0);
    require_between("an extraterrestrial irradiance, in W/m²", interval.extraterrestrial_w_m2, 100.0, 2000.0);
    require_count_between("a month of an interval of light", interval.month, 1, 12);
    if (interval.direct_normal_lux) require_between("a direct illuminance, in lx", *interval.direct_normal_lux, 0.0, 300000.0);
    if (interval.diffuse_lux) require_between("a diffuse illuminance, in lx", *interval.diffuse_lux, 0.0, 300000.0);
    for (const SunPosition& sun : interval.sun) check(sun);
  }
}

bool knows_illuminance(const LightInterval& interval) { return interval.direct_normal_lux && interval.diffuse_lux; }

void check(const Quantities& q, SkyWeight weight) {
  require_one_of("further.sky_patches", q.sky_patches, SkyPatchSet::reinhart);
  if (q.horizons > 0) require_count_between("further.horizons", q.horizons, 4, 3600);
  require_between("further.eye_field_deg", q.eye_field_deg, 1.0, 90.0);
  if (q.seen_building && q.seen_building->empty())
    throw InvalidArgument("further.seen_building is empty: give the id of the building that receivers look for");
  if (q.wall_sectors != 4 && q.wall_sectors != 8)
    throw InvalidArgument("further.wall_sectors is " + std::to_string(q.wall_sectors) + ": give 4 or 8");
  if (q.sunlit_total && !q.sun)
    throw InvalidArgument("further.sunlit_total is of the hours of further.sun, which has no value: give positions of the sun");
  if (q.horizon_distances && q.horizons == 0)
    throw InvalidArgument("further.horizon_distances are those of horizons, and further.horizons is 0: give their number");
  for (const SunPosition& sun : q.sun ? std::span<const SunPosition>(*q.sun) : std::span<const SunPosition>()) check(sun);
  if (q.light) check(*q.light);
  if (q.any_of_light() && !q.light)
    throw InvalidArgument(
        "further.irradiation, irradiance, illuminance and shade are those of a period: give its light (further.light)");
  if (q.illuminance && std::ranges::none_of(q.light->intervals, knows_illuminance))
    throw InvalidArgument("further.illuminance needs lx: no interval of further.light has them (direct_normal_lux, diffuse_lux)");
  check(q.canopy);
  if (weight == SkyWeight::cosine) return;
  for (const QuantityWord& asked : words_of(q))
    if (asked.is_weighted)
      throw InvalidArgument("with the weight solid_angle " + std::string(asked.word) +
                            " cannot be computed beside it, which is weighted by the cosine: leave one of them out");
}

void check(const EvaluationSettings& s) {
  if (s.within_m) require_between("within_m", *s.within_m, 0.0, largest_within_m);
  require_one_of("engine", s.engine, Engine::near_only);
  require_one_of("weight", s.weight, SkyWeight::solid_angle);
  require_one_of("directions", s.directions, DirectionSet::fibonacci);
  if (s.azimuths) require_count_between("azimuths", *s.azimuths, 4, 1'000'000);
  if (s.rays) require_count_between("rays", *s.rays, 1, 10'000'000);
  if (s.max_error) require_between("max_error", *s.max_error, 0.0001, 1.0);
  check(s.further, s.weight);
  if (s.further.svf_total_bounds && !(s.further.svf_total && s.bounds))
    throw InvalidArgument(
        "further.svf_total_bounds are those of svf_total, beside those of svf: ask for svf_total and for bounds, too");
  if (s.azimuths && *s.azimuths < least_azimuths_of_bounds && (s.bounds || s.max_error))
    throw InvalidArgument("bounds and errors need at least " + std::to_string(least_azimuths_of_bounds) +
                          " azimuths: give more, or leave their number out");
  if (s.engine == Engine::near_only && (s.bounds || s.max_error))
    throw InvalidArgument(
        "the engine near_only leaves the far city out, of which it knows neither bounds nor errors: leave bounds and max_error "
        "out, or choose another engine");
}

/// What is left of the allowed error beside the samples.
double error_beside_samples(const EvaluationSettings& s, SkySettings sky) {
  // That there is one decides whether the error of rays counts; how large it is follows from that
  sky.allowed_error = *s.max_error;
  const double left = *s.max_error - sampling_error_of(sky);
  if (left > 0.0) return left;
  const double share = sampling_share * *s.max_error;
  throw InvalidArgument("a largest error of " + setting_text(*s.max_error) + " of svf_total is less than " +
                        std::to_string(sky.rays) + " rays and " + std::to_string(sky.azimuths) +
                        " azimuths can keep: leave the numbers of rays and azimuths out, or give at least " +
                        std::to_string(rays_for_sampling_error(share)) + " rays and " +
                        std::to_string(azimuths_for_error(share)) + " azimuths");
}

SkySettings sky_of(const EvaluationSettings& s) {
  SkySettings sky;
  sky.engine = s.engine;
  sky.weight = s.weight;
  sky.directions = s.directions;
  // Crowns are seen at the samples; all else lies within bounds, whatever the samples are
  const bool by_samples = s.max_error && s.further.svf_total;
  const double sampling = by_samples ? sampling_share * *s.max_error : 0.0;
  sky.rays = s.rays ? *s.rays : by_samples ? rays_for_sampling_error(sampling) : default_rays;
  sky.azimuths = s.azimuths   ? *s.azimuths
                 : by_samples ? std::max(least_azimuths_of_bounds, azimuths_for_error(sampling))
                              : default_azimuths;
  sky.azimuths = azimuths_for(s.further, sky.azimuths);
  sky.further = s.further;
  if (s.max_error) sky.allowed_error = error_beside_samples(s, sky);
  return sky;
}

void require_usable_shard(const RunSettings& run) {
  if (!run.shard) return;
  if (run.shard->index >= run.shard->count)
    throw InvalidArgument("there is no shard " + std::to_string(run.shard->index) + " of " + std::to_string(run.shard->count) +
                          ": they count from 0");
  if (run.answers == nullptr || run.answers->is_read_only())
    throw InvalidArgument("a shard needs a file that its answers are kept in: give answers");
}

}  // namespace

ResolvedSettings resolved(const EvaluationSettings& evaluation, const RunSettings& run) {
  check(evaluation);
  require_usable(run);
  require_usable_shard(run);
  ResolvedSettings s;
  s.sky = sky_of(evaluation);
  s.accuracy = {s.sky.azimuths, s.sky.rays, sampling_error_of(s.sky), s.sky.allowed_error};
  s.bounds = evaluation.bounds;
  s.verify = evaluation.verify;
  s.dry_run = evaluation.dry_run;
  s.region = evaluation.region;
  s.within_m = evaluation.within_m;
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
