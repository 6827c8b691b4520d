// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "run/memory_limit.hpp"

#include <algorithm>
#include <string>

#include "farlod/error.hpp"

namespace farlod {
namespace {

constexpr std::uint64_t mib = 1024 * 1024;

// Measured on Debian 12, and rounded up
constexpr std::uint64_t program_bytes = 80 * mib;  // the program and its libraries, before there is a cell
constexpr std::uint64_t thread_bytes = 12 * mib;   // scenes of cells, and what the allocator keeps for the next
constexpr std::uint64_t receiver_bytes = 128;      // a receiver on its way, with its answers
constexpr std::uint64_t triangle_bytes = 224;      // of the whole city's scene: the triangle, its corners, Embree's tree

bool traces_whole_city(const ResolvedSettings& settings) {
  return settings.sky.engine == Engine::exact || settings.verify > 0 || settings.sky.max_far_error.has_value();
}

std::string in_mib(std::uint64_t bytes) { return std::to_string((bytes + mib - 1) / mib); }

void require_below_limit(std::uint64_t bytes, const RunSettings& run, const std::string& what, const std::string& instead) {
  if (bytes <= *run.memory_limit_mib * mib) return;
  throw LimitReached(what + " needs about " + in_mib(bytes) + " MiB, more than the limit of " +
                     std::to_string(*run.memory_limit_mib) + " MiB: raise the memory limit, or " + instead + ".");
}

}  // namespace

std::size_t cells_in_flight(std::size_t threads) { return 4 * threads; }

/// The cells in flight lie side by side along the curve, and their neighborhoods touch four blocks at the most: with fewer, each
/// cell would read them anew; more would only lie there, since the curve leaves a block when all of its cells are done.
std::uint64_t bytes_of_blocks_at_work(const package::Manifest& manifest) {
  constexpr std::uint64_t blocks_at_work = 4;
  std::uint64_t largest = 0;
  for (const package::BlockFiles& block : manifest.blocks) largest = std::max(largest, block.tiles.bytes);
  return std::min<std::uint64_t>(blocks_at_work, manifest.blocks.size()) * largest;
}

void require_memory(const package::Manifest& manifest, const ResolvedSettings& settings, const MemoryNeeds& needs) {
  if (!settings.run.memory_limit_mib) return;
  const std::uint64_t in_flight = cells_in_flight(settings.threads) * needs.receivers_of_cell * receiver_bytes;
  const std::uint64_t bytes = program_bytes + settings.threads * thread_bytes + needs.results + settings.run.caller_bytes +
                              in_flight + bytes_of_blocks_at_work(manifest);
  require_below_limit(bytes, settings.run, "this run", "use fewer threads, a coarser raster, or a part at a time");
  if (needs.whole_city || traces_whole_city(settings))
    require_below_limit(bytes + manifest.triangles * triangle_bytes, settings.run, "tracing the whole city",
                        "leave out what needs it (the engine exact, a verification, a largest error, points beyond the grid)");
}

}  // namespace farlod
