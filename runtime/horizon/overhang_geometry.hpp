// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farlod/grid.hpp"
#include "farlod/point.hpp"
#include "horizon/receiver_packet.hpp"
#include "occlusion/occluder.hpp"
#include "package/package.hpp"

namespace farlod {

/// The buildings around a cell that can be seen under somewhere (SurfaceRecord::grounded is 0), triangle by triangle. Cell frame.
/// Of one thread.
class OverhangGeometry {
 public:
  using TriangleCorners = std::array<Point3f, 3>;

  /// The package must outlive it.
  OverhangGeometry(const Package& package, Cell cell);

  /// A bit for each receiver that has something overhead.
  [[nodiscard]] std::uint32_t covered(const ReceiverPacket& receivers) const;
  /// All of it in the neighbourhood, for rays. Made when it is first asked for.
  [[nodiscard]] const Occluder& scene();

 private:
  [[nodiscard]] std::vector<TriangleCorners> triangles_in(const CellRange& cells) const;

  const Package& package_;
  Cell cell_;
  std::vector<TriangleCorners> overhead_;  ///< what may lie above receivers of the cell
  std::optional<Occluder> scene_;
};

}  // namespace farlod
