// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmark/city_receivers.hpp"
#include "benchmark/error_ladder.hpp"
#include "benchmark/whole_city_rival.hpp"
#include "evaluate/sky_evaluator.hpp"
#include "package/package_reader.hpp"

namespace farlod::benchmark {

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

}  // namespace farlod::benchmark
