// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "farlod/export.hpp"
#include "farlod/point.hpp"
#include "farlod/quantities.hpp"
#include "farlod/region.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// What answers a receiver (docs/stages/evaluate.md). Far maps of the kind `box` have no horizons: with them automatic, horizon
/// and rays are all the same, rays that are traced nearby and looked up in the map. Receivers outside of the grid have no far
/// map: automatic and horizon draw all edges of a city of up to a million triangles there, unless it is a raster or has far
/// terrain; else rays are traced against the whole city, whatever the engine. Those in cells whose far map was not made
/// (PackSettings::area) are traced so, too, by the engines automatic and rays.
enum class Engine {
  automatic,  ///< horizons
  horizon,    ///< the same; where a far map is missing, the run ends with PackageUnusable
  rays,       ///< rays, as in the paper (Listing 1), compared with horizons; only those in gaps are traced
  exact,      ///< rays against all tiles: the reference
  /// The far city left out, as by tools that cut a city into tiles: to measure what the far map is worth. Knows neither bounds
  /// nor errors: not with EvaluationSettings::bounds or max_error.
  near_only
};
inline constexpr std::array<Word<Engine>, 5> engine_words{{{"auto", Engine::automatic},
                                                           {"horizon", Engine::horizon},
                                                           {"rays", Engine::rays},
                                                           {"exact", Engine::exact},
                                                           {"near", Engine::near_only}}};

/// How directions of the sky are weighted.
enum class SkyWeight {
  cosine,      ///< by the cosine to the receiver's normal: the view factor of the sky (`svf`)
  solid_angle  ///< all alike: the share of the sky's solid angle (`svf_solid`)
};
inline constexpr std::array<Word<SkyWeight>, 2> sky_weight_words{
    {{"cosine", SkyWeight::cosine}, {"solid", SkyWeight::solid_angle}}};

/// The set of directions in which rays are sent.
enum class DirectionSet {
  partition,  ///< one ray in each cell of the Beckers & Beckers partition of the sky, as in the paper
  fibonacci   ///< a spherical Fibonacci lattice with the sky's weight: fixed, of low discrepancy
};
inline constexpr std::array<Word<DirectionSet>, 2> direction_set_words{
    {{"partition", DirectionSet::partition}, {"fibonacci", DirectionSet::fibonacci}}};

inline constexpr std::size_t default_azimuths = 320, default_rays = 1000;

/// What is computed at a receiver, and how exactly.
struct EvaluationSettings {
  Engine engine = Engine::automatic;
  SkyWeight weight = SkyWeight::cosine;
  DirectionSet directions = DirectionSet::partition;
  /// Azimuths of a horizon, 4 to 1,000,000, with bounds and errors at least 8; if empty, default_azimuths, or as many as
  /// `max_error` of svf_total needs.
  std::optional<std::size_t> azimuths;
  /// Directions of a receiver's rays, 1 to 10,000,000; if empty, default_rays, or as many as `max_error` of svf_total needs.
  std::optional<std::size_t> rays;
  /// Largest error allowed, 0.0001 to 1: certain for the sky view factor, of which the whole city decides what is left open; for
  /// Quantities::svf_total by as many azimuths and rays as that was found to need. Needs far maps of the kind `horizon`, or
  /// Engine::exact.
  std::optional<double> max_error;
  /// Also compute a lower and an upper bound of each value, between which the true value of the packed city lies. Needs the same.
  bool bounds = false;
  /// After the run, compute so many random receivers exactly and compare: EvaluationSummary::errors. All if there are fewer.
  std::size_t verify = 0;
  /// Evaluates a few cells only, spread over the run, delivers no answers, and tells what the run would take:
  /// EvaluationSummary::estimate. Nothing is verified.
  bool dry_run = false;
  /// If not null, receivers outside of it have no value and cost next to nothing: EvaluationSummary::outside_of_region.
  std::shared_ptr<const Region> region = nullptr;
  /// Pixels of a raster that are farther in the plan from all roofs and walls, at most `largest_within_m`, have no value either,
  /// and are counted there.
  std::optional<double> within_m = std::nullopt;
  /// What is computed beside the sky view factor. All but horizons and sunshine need SkyWeight::cosine.
  Quantities further = {};
};

/// What a receiver's height counts from.
enum class HeightAbove {
  ground,
  highest_surface,  ///< the ground or the roof, whichever is on top
  sea_level         ///< the zero of the package's heights
};
inline constexpr std::array<Word<HeightAbove>, 3> height_above_words{
    {{"ground", HeightAbove::ground}, {"surface", HeightAbove::highest_surface}, {"sea", HeightAbove::sea_level}}};

/// How high receivers stand that have no height of their own.
struct Placing {
  HeightAbove above = HeightAbove::ground;
  /// 0 to 10,000, and for sea_level −100,000 to 100,000. On the surface itself, a receiver stands a centimetre above it.
  double height_m = 1.5;
};

/// Errors of answers against exact ones: of the absolute error its mean, 99th percentile and maximum; bias is the mean of
/// answer − exact.
struct ErrorSummary {
  std::size_t count = 0;
  double mean_abs_error = 0.0, p99_abs_error = 0.0, max_abs_error = 0.0, bias = 0.0;
  std::size_t rays = 0;  ///< of each exact answer
};

/// A receiver that was computed again exactly.
struct VerifiedReceiver {
  Point3d p_projected;  ///< its height is above sea level
  float svf = 0.0F, exact = 0.0F;
};

/// Seconds of wall clock by part of the work.
struct EvaluationSeconds {
  double scenes = 0.0, evaluate = 0.0;
  double deliver = 0.0;  ///< in the callback that takes the results
};

/// Width of the intervals [low, high].
struct BoundsWidth {
  double mean = 0.0, max = 0.0;
};

/// Least, mean and largest of all values of a run.
struct ValueRange {
  double min = 0.0, mean = 0.0, max = 0.0;
};

/// What the settings came to, and the error that follows from it.
struct Accuracy {
  std::size_t azimuths = default_azimuths, rays = default_rays;
  /// Upper estimate for the sky between the samples; not a certain bound. Of a run: between those that answered. 0 where bounds
  /// keep EvaluationSettings::max_error, which is certain.
  double sampling_error = 0.0;
  std::optional<double> far_error_allowed;  ///< what EvaluationSettings::max_error leaves beside that, and bounds keep
};

/// What some settings come to, before any run: within the grid, with far maps of the kind `horizon`. Throws InvalidArgument, as
/// the runs do, where a setting is not what its declaration promises, or the numbers of rays and azimuths cannot keep the error
/// that is allowed.
[[nodiscard]] FARLOD_EXPORT Accuracy accuracy_of(const EvaluationSettings& settings);

/// What a run would take, from a few of its cells (EvaluationSettings::dry_run).
struct RunEstimate {
  std::size_t cells = 0, evaluated_cells = 0;
  std::size_t evaluated_receivers = 0;  ///< those of the evaluated cells, or of a small run a share of them
  double receivers = 0.0;               ///< with a value
  double seconds = 0.0;                 ///< of wall clock, without files
  double memory_bytes = 0.0;            ///< what RunSettings::memory_limit_mib is compared with
};

/// More is no question of streets and yards, and would take long.
inline constexpr double largest_within_m = 1000.0;

/// Within this distance, receivers are near buildings: how much open ground there is around a city, their mean does not tell.
inline constexpr double near_buildings_m = 20.0;

/// The figures of a run.
struct EvaluationSummary {
  std::size_t receivers = 0;          ///< with a value
  std::size_t no_data = 0;            ///< inside buildings, below the ground, or without ground below them
  std::size_t beyond_grid = 0;        ///< pixels of a raster that lie in no cell: without a value too
  std::size_t outside_of_region = 0;  ///< receivers that EvaluationSettings::region leaves out: no data, but not counted as such
  std::size_t outside_of_grid = 0;    ///< receivers outside of the grid, where all of the city is near
  /// Receivers in cells of the grid that have no far map (PackSettings::area). All engines but near_only, which needs none,
  /// traced them against the whole city.
  std::size_t without_far_map = 0;
  std::optional<double> svf_min, svf_mean, svf_max;  ///< mean and median of receivers on surfaces: weighted by area
  std::optional<double> svf_median;                  ///< within .00005
  /// The receivers of a raster above the ground whose distance to a building in the plan is near_buildings_m at the most, and
  /// their mean.
  std::size_t near_buildings = 0;
  std::optional<double> svf_mean_near_buildings;
  std::optional<BoundsWidth> bounds;
  std::uint64_t by_rays = 0;        ///< receivers that rays answered, or for which bounds needed the whole city
  std::uint64_t retraced_rays = 0;  ///< rays and parts of the sky (wedges) that the whole city decided (max_error)
  std::optional<ErrorSummary> errors;
  /// Ranges of the further columns, in the order of columns_of(), where a receiver has a value.
  std::vector<std::optional<ValueRange>> further;
  /// Where these are computed: Quantities::svf_total, its bounds, and the errors of EvaluationSettings::verify.
  std::optional<ValueRange> svf_total;
  std::optional<BoundsWidth> svf_total_bounds;
  std::optional<ErrorSummary> svf_total_errors;
  std::optional<RunEstimate> estimate;     ///< of a dry run, whose counts are 0
  std::vector<VerifiedReceiver> verified;  ///< those that `errors` is about, in an order that depends on no number of threads
  Accuracy accuracy;
  EvaluationSeconds seconds;
};

}  // namespace farlod
