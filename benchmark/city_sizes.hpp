// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "benchmark/contest.hpp"

namespace farlod::benchmark {

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
