// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "evaluate/traced_patches.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/cancellation.hpp"
#include "base/expects.hpp"
#include "evaluate/visibility.hpp"
#include "horizon/receiver_packet.hpp"

namespace farlod {
namespace {

/// The bits of a matrix: a number for each receiver of a packet in each column.
using MatrixColumns = std::array<std::array<std::uint32_t, RayOrigins::lanes>, columns_of_shadow_matrix>;

/// The matrices of a packet, patch by patch.
class PacketPatches {
 public:
  /// Each bit of `seen` is the value of a receiver.
  void add(ShadowMatrix matrix, std::size_t patch, std::uint32_t seen) {
    auto& column = matrices_[static_cast<std::size_t>(matrix)][patch / patches_of_shadow_column];
    for (std::size_t l = 0; l < RayOrigins::lanes; ++l) column[l] |= (seen >> l & 1U) << patch % patches_of_shadow_column;
  }
  void write(std::size_t lane, std::span<float> values) const {
    std::size_t next = 0;
    for (const MatrixColumns& matrix : matrices_)
      for (const auto& column : matrix) values[next++] = static_cast<float>(column[lane]);
  }

 private:
  std::array<MatrixColumns, shadow_matrix_count> matrices_{};
};

/// Without crowns, whether something is met will do, and not where.
void trace_patch(const PatchScene& scene, const RayOrigins& origins, const Point3f& direction, std::size_t patch,
                 std::uint32_t wanted, PacketPatches& patches) {
  if (scene.crowns == nullptr) {
    const std::uint32_t solid = scene.solid.occluder.blocked(origins, direction, least_distance_m, wanted);
    patches.add(ShadowMatrix::building, patch, ~solid);
    patches.add(ShadowMatrix::vegetation, patch, ~0U);
    patches.add(ShadowMatrix::vegetation_before_building, patch, ~0U);
    return;
  }
  const Occluder::Distances ends = scene.solid.occluder.distances(origins, direction, least_distance_m, wanted);
  std::uint32_t solid = 0;
  for (std::size_t l = 0; l < RayOrigins::lanes; ++l) solid |= ends[l] < std::numeric_limits<float>::infinity() ? 1U << l : 0U;
  // A crown that is met before the end of a ray hides what is solid there, or the sky where the ray has no end
  const std::uint32_t crowns =
      scene.crowns->met_before(ends, origins, Occluder::Directions::all_of(direction), least_distance_m, wanted);
  patches.add(ShadowMatrix::building, patch, ~solid);
  patches.add(ShadowMatrix::vegetation, patch, ~(crowns & ~solid));
  patches.add(ShadowMatrix::vegetation_before_building, patch, ~(crowns & solid));
}

}  // namespace

PatchDirections patch_directions(const package::Manifest& manifest) {
  PatchDirections directions;
  std::transform(shadow_patches().begin(), shadow_patches().end(), directions.begin(), [&](const ShadowPatch& patch) {
    // true azimuth = grid azimuth + convergence
    const Angle azimuth = patch.azimuth - manifest.convergence;
    const double level = cos(patch.elevation);
    return rounded(
        manifest.grid.rotation.grid_from_city(Point3d{level * sin(azimuth), level * cos(azimuth), sin(patch.elevation)}));
  });
  return directions;
}

void store_shadow_patches(const CellReceivers& cell, const PatchScene& scene, const PatchDirections& directions,
                          const ColumnRange& columns, std::size_t columns_in_all, const SkyAnswers& answers,
                          const std::stop_token& stop) {
  FARLOD_EXPECTS(columns.count == shadow_column_count);
  const PacketOrder order = packet_order(cell.receivers, stop);
  std::size_t first = 0;
  std::vector<Point3f> places;
  for (const std::uint32_t end : order.ends) {
    throw_if_cancelled(stop);
    const std::span<const std::uint32_t> numbers = std::span(order.numbers).subspan(first, end - first);
    first = end;
    places.clear();
    for (const std::uint32_t n : numbers) places.push_back(placed(cell.receivers[n].p_cell, scene.solid.scene_from_cell_m));
    const RayOrigins origins = gathered(places);
    const auto wanted = static_cast<std::uint32_t>((std::uint64_t{1} << numbers.size()) - 1);
    PacketPatches patches;
    for (std::size_t patch = 0; patch < directions.size(); ++patch)
      trace_patch(scene, origins, directions[patch], patch, wanted, patches);
    for (std::size_t l = 0; l < numbers.size(); ++l)
      patches.write(l, answers.further.subspan(cell.receivers[numbers[l]].index * columns_in_all + columns.first, columns.count));
  }
}

}  // namespace farlod
