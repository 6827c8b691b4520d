// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "package/manifest.hpp"
#include "package/package_reader.hpp"
#include "run/resolved_settings.hpp"

namespace farlod {

/// What a run holds besides the package. The numbers are doubles, whose sums and products do not wrap.
struct MemoryNeeds {
  double results = 0.0;            ///< bytes, however many threads there are
  double receivers_of_cell = 0.0;  ///< the most receivers of a cell, as far as they are known beforehand
  bool whole_city = false;         ///< everything in one scene, whatever the settings
};

/// Cells that are worked on at the same time.
[[nodiscard]] std::size_t cells_in_flight(std::size_t threads);

/// Whether some of these cells are answered by tracing everything: they lie outside of the grid, or their far maps are missing.
[[nodiscard]] bool any_traces_whole_city(const PackageReader& package, Engine engine, std::span<const Cell> cells);

/// Bytes of the blocks that the cells in flight of a run need.
[[nodiscard]] std::uint64_t bytes_of_blocks_at_work(const package::Manifest& manifest);

/// Bytes of the crowns that a run reads between two times that it lets a block go: those around the cells in flight, as far as
/// they are seen. 0 without crowns.
[[nodiscard]] double bytes_of_crowns_at_work(const package::Manifest& manifest);

/// The same run, whose caller holds so many bytes more.
[[nodiscard]] RunSettings with_bytes_of_caller(RunSettings run, std::uint64_t bytes);

/// Throws LimitReached when the run needs more memory than the caller gives it; where the caller says nothing, when it needs
/// clearly more than the machine has (is_beyond_machine), unless it is a dry run, which tells it. Returns the bytes that it
/// needs.
double require_memory(const package::Manifest& manifest, const ResolvedSettings& settings, const MemoryNeeds& needs);

/// The estimate of a dry run, with the bytes that it needs.
[[nodiscard]] EvaluationSummary with_memory(EvaluationSummary summary, double bytes);

/// The same for runs that evaluate nothing, and hold so many bytes: "checking the package" needs more than there is, "use fewer
/// threads" helps.
void require_memory(const RunSettings& run, double bytes, const std::string& what, const std::string& instead);

}  // namespace farlod
