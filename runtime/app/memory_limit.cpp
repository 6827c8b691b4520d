// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "app/memory_limit.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace farlod {
namespace {

constexpr std::uint64_t mib = 1024 * 1024;

// Measured on Debian 12, and rounded up
constexpr std::uint64_t program_bytes = 80 * mib;  // the program and its libraries, before there is a cell
constexpr std::uint64_t thread_bytes = 12 * mib;   // scenes of cells, and what the allocator keeps for the next
constexpr std::uint64_t receiver_bytes = 128;      // a receiver on its way, with its answers
constexpr std::uint64_t triangle_bytes = 224;      // of the whole city's scene: the triangle, its corners, Embree's tree

/// The cells in flight lie side by side along the curve, and their neighborhoods touch four blocks at the most: with fewer, each
/// cell would read them anew; more would only lie there, since the curve leaves a block when all of its cells are done.
std::uint64_t bytes_of_blocks_at_work(const package::Manifest& manifest) {
  constexpr std::uint64_t blocks_at_work = 4;
  std::uint64_t largest = 0;
  for (const package::BlockFiles& block : manifest.blocks) largest = std::max(largest, block.tiles.bytes);
  return std::min<std::uint64_t>(blocks_at_work, manifest.blocks.size()) * largest;
}

bool traces_whole_city(const SvfOptions& options) {
  return options.sky.engine == Engine::exact || options.verify_count > 0 || options.sky.max_far_error.has_value();
}

std::uint64_t in_mib(std::uint64_t bytes) { return (bytes + mib - 1) / mib; }

const char* with_less_memory(const SvfOptions& options) {
  return options.source == ReceiverSource::grid ? "use fewer --threads, a coarser --grid, or a part at a time (--bbox)"
                                                : "use fewer --threads";
}

[[noreturn]] void refuse(const SvfOptions& options, const std::string& why, std::uint64_t bytes, const std::string& instead) {
  throw LimitReached(fmt::format("{} needs about {} MiB, more than --memory-limit {}: raise the limit, or {}.", why,
                                 in_mib(bytes), *options.memory_limit_mib, instead));
}

}  // namespace

std::size_t cells_in_flight(const RunOptions& options) { return 4 * thread_count(options); }

void share_memory(Package& package, const SvfOptions& options, const MemoryNeeds& needs) {
  const package::Manifest& manifest = package.manifest();
  const std::uint64_t blocks = bytes_of_blocks_at_work(manifest);
  const std::uint64_t in_flight = cells_in_flight(options.run) * needs.receivers_of_cell * receiver_bytes;
  const std::uint64_t run = program_bytes + thread_count(options.run) * thread_bytes + needs.results + in_flight + blocks;
  package.hold_at_most(blocks);
  if (!options.memory_limit_mib) return;
  const std::uint64_t limit = *options.memory_limit_mib * mib;
  if (run > limit) refuse(options, "this run", run, with_less_memory(options));
  if (!needs.whole_city && !traces_whole_city(options)) return;
  const std::uint64_t with_city = run + manifest.triangles * triangle_bytes;
  if (with_city > limit)
    refuse(options, "tracing the whole city", with_city,
           "leave out what needs it (--engine exact, --verify, --max-error, points beyond the grid)");
}

}  // namespace farlod
