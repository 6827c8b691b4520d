// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmark/error_ladder.hpp"
#include "benchmark/our_sky.hpp"
#include "benchmark/whole_city_rival.hpp"

namespace farlod::benchmark {

/// How much is measured.
struct Extent {
  std::size_t cells = 200;    ///< of the city, spread evenly
  std::size_t sample = 2000;  ///< receivers whose truth is traced
  std::size_t truth_rays = 100000;
  std::size_t turns = 5;  ///< medians are of so many
  double ground_spacing_m = 1.0, surface_spacing_m = 2.0;
  std::vector<std::size_t> rival_ladder{256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192};
  std::array<double, 2> targets{0.010, 0.005};
};
[[nodiscard]] Extent quick_extent();

/// A city, its package and its triangles, ready to be measured.
struct City {
  explicit City(const std::filesystem::path& folder) : package(folder), triangles(triangles_of(package)), rival(triangles) {}
  PackageReader package;
  CityTriangles triangles;
  WholeCityRival rival;
};

/// Receivers of one place, and some among them whose truth is known.
struct Field {
  Place place = Place::ground;
  CityReceivers receivers, sample;
  std::vector<std::size_t> sample_in_all;             ///< the index that each of the sample has among all receivers
  std::vector<SharedPacket> packets, sample_packets;  ///< the same, as the rival wants them
  std::vector<float> truth;
};
[[nodiscard]] Field prepare_field(const City& city, Place place, const Extent& extent);

/// Ours against the rival, both at the accuracy that the row names.
struct ContestRow {
  std::string what;
  std::size_t receivers = 0;
  std::optional<Rung> rival, ours;  ///< the settings and their errors; none when no rung was good enough
  double rival_s = 0.0, ours_s = 0.0, ratio = 0.0;
};

/// Both at the fewest samples whose largest error is within each target.
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
