// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmark/whole_city_rival.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "package/package_reader.hpp"

namespace farlod::benchmark {

/// Wall clock of a call.
template <class Work>
[[nodiscard]] double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The middle value; of an even number, the mean of the two in the middle. At least one.
[[nodiscard]] double median(std::vector<double> values);

/// Two ways to do the same, measured in turn (A B A B …), so that what else the machine does meets both.
struct Duel {
  double first_s = 0.0, second_s = 0.0;  ///< medians
  double ratio = 0.0;                    ///< median of second/first, each within one turn
};
[[nodiscard]] Duel duel(std::size_t turns, const std::function<void()>& first, const std::function<void()>& second);

/// Median wall clock of so many calls.
[[nodiscard]] double median_seconds(std::size_t turns, const std::function<void()>& work);

struct Errors {
  double mean_abs = 0.0, rms = 0.0, max_abs = 0.0;
};
/// Of the same length, at least one.
[[nodiscard]] Errors errors_of(std::span<const float> answers, std::span<const float> truth);

/// One accuracy that a method can be set to: so many rays, or azimuths.
struct Rung {
  std::size_t samples = 0;
  Errors errors;
};

/// The errors at each number of samples. `answer` gives the answers of the receivers whose truth is known.
using Answer = std::function<std::vector<float>(std::size_t samples)>;
[[nodiscard]] std::vector<Rung> climb(std::span<const std::size_t> ladder, const Answer& answer, std::span<const float> truth);

/// The lowest rung whose largest error is at most this; none when no rung is.
[[nodiscard]] std::optional<Rung> rung_within(std::span<const Rung> rungs, double max_error);

/// One of our engines, and the accuracies that it is tried at.
struct OurEngine {
  std::string name;
  Engine engine = Engine::rays;
  std::string sample_name;  ///< what the accuracy counts
  std::vector<std::size_t> ladder;
  /// Answers of neighbors may share work: errors are then those of the whole set, not of a few receivers asked alone.
  bool shares_work = false;

  [[nodiscard]] SkySettings settings(std::size_t samples) const;
};
/// By the name that farlod-svf knows it by; throws std::runtime_error for another.
[[nodiscard]] OurEngine engine_named(const std::string& name);

/// Evaluates the receivers as farlod-svf does, on all cores: reads far maps, builds near scenes.
void evaluate(const PackageReader& package, const SkySettings& settings, const CityReceivers& receivers, std::span<float> svf);

/// The truth: so many rays against all tiles.
[[nodiscard]] std::vector<float> exact_answers(const PackageReader& package, const CityReceivers& receivers, std::size_t rays);

/// What is asked of a map: how dense its receivers are, and by how much none of them may err.
struct Target {
  double spacing_m;
  double max_error;
};

/// How much is measured.
struct Extent {
  std::size_t cells = 24;     ///< of the city, spread evenly; of coarser maps as many more as make up for it
  std::size_t sample = 2000;  ///< receivers whose truth is traced
  std::size_t truth_rays = 100000;
  std::size_t turns = 5;  ///< medians are of so many
  /// Errors are measured at the spacing of the first.
  std::vector<Target> ground{{1.0, 0.010}, {1.0, 0.005}, {1.0, 0.002}, {2.0, 0.010}, {4.0, 0.010}, {10.0, 0.010}};
  std::vector<Target> surfaces{{2.0, 0.010}, {2.0, 0.005}};
  std::vector<std::size_t> rival_ladder{256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192, 12288};

  [[nodiscard]] const std::vector<Target>& targets(Place place) const { return place == Place::ground ? ground : surfaces; }
  [[nodiscard]] double spacing_m(Place place) const { return targets(place).front().spacing_m; }
};
[[nodiscard]] Extent quick_extent();

/// A city, its package and its triangles, ready to be measured.
struct City {
  explicit City(const std::filesystem::path& folder) : package(folder), triangles(triangles_of(package)), rival(triangles) {}
  PackageReader package;
  CityTriangles triangles;
  WholeCityRival rival;
};

/// Receivers of one place, for us and for the rival.
struct Field {
  CityReceivers receivers;
  std::vector<SharedPacket> packets;
};

/// Such receivers, and some among them whose truth is known.
struct SampledField {
  Field all, sample;
  std::vector<std::size_t> sample_in_all;  ///< the index that each of the sample has among all receivers
  std::vector<float> truth;
};
[[nodiscard]] SampledField prepare_field(const City& city, Place place, const Extent& extent);

/// Ours against the rival, both at the accuracy that the row names.
struct ContestRow {
  std::string what;
  Target target{};
  std::size_t receivers = 0;
  std::optional<Rung> rival, ours;  ///< the settings and their errors; none when no rung was good enough
  double rival_s = 0.0, ours_s = 0.0, ratio = 0.0;
};

/// Both at the fewest samples whose largest error is within each target of the place.
struct Contest {
  Place place;
  std::size_t sample = 0;
  double placing_s = 0.0;
  std::vector<Rung> rival_ladder, our_ladder;
  std::vector<ContestRow> rows;
};
[[nodiscard]] Contest contest(const City& city, Place place, const OurEngine& ours, const Extent& extent);

/// Our rays against the rival with the very same directions.
[[nodiscard]] std::vector<ContestRow> same_directions_contest(const City& city, const Extent& extent);

/// Says what is being done; contests take minutes.
void tell(const std::string& what);

/// The accuracy at which both are compared in cities of all sizes.
struct Accuracy {
  std::size_t rival_rays = 0, our_samples = 0;
};

/// One city among those of several sizes, ground receivers.
struct SizeRow {
  std::uint64_t polygons = 0;
  std::size_t triangles = 0, index_bytes = 0, receivers = 0;
  double all_receivers = 0.0;          ///< about so many stand on the whole ground
  double open_s = 0.0, build_s = 0.0;  ///< reading all tiles once; indexing the city for the rival
  double pack_s = 0.0;                 ///< of farlod-pack
  double rival_s = 0.0, ours_s = 0.0, ratio = 0.0;

  [[nodiscard]] double rival_s_each() const { return rival_s / static_cast<double>(receivers); }
  [[nodiscard]] double ours_s_each() const { return ours_s / static_cast<double>(receivers); }
  /// So many receivers cost as much with a package as without: packing, opening and asking us, or indexing and asking the rival.
  /// None when we are not faster.
  [[nodiscard]] std::optional<double> break_even() const;
};
struct SizedCity {
  std::filesystem::path package;
  double pack_s = 0.0;
};
[[nodiscard]] std::vector<SizeRow> study_sizes(std::span<const SizedCity> cities, const OurEngine& ours, Accuracy accuracy,
                                               const Extent& extent);

}  // namespace farlod::benchmark
