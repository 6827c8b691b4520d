// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/grid.hpp"
#include "farlod/point.hpp"
#include "horizon/azimuth_sampling.hpp"
#include "horizon/cell_silhouettes.hpp"
#include "horizon/overhang_facets.hpp"
#include "horizon/packet_horizon.hpp"
#include "horizon/receiver_packet.hpp"
#include "horizon/sky_partition.hpp"
#include "occlusion/occluder.hpp"
#include "occlusion/placed_mesh.hpp"
#include "package/package_reader.hpp"
#include "scene/ray_scenes.hpp"

/// Overhangs: occluders that sky may be seen below. docs/concepts.md, "What is grounded, and what overhangs".
namespace farlod {

/// The receivers of a cell in the frame of a scene.
[[nodiscard]] inline RayOrigins origins_of(const ReceiverPacket& receivers, Point2d scene_from_cell_m) {
  RayOrigins origins{receivers.x, receivers.y, receivers.z};
  for (std::size_t l = 0; l < RayOrigins::lanes; ++l) {
    origins.x[l] = static_cast<float>(origins.x[l] + scene_from_cell_m.x);
    origins.y[l] = static_cast<float>(origins.y[l] + scene_from_cell_m.y);
  }
  return origins;
}

/// What overhangs around a cell (not SurfaceRecord::is_grounded), triangle by triangle. Cell frame. Of one thread.
class OverhangGeometry {
 public:
  using TriangleCorners = OverhangFacets::Corners;

  /// The package and the city must outlive it. With a city, rays are traced against that instead of a scene of the cell's own.
  OverhangGeometry(const PackageReader& package, Cell cell, const WholeCityOnDemand* city = nullptr);

  /// A bit for each receiver that is below an overhang.
  [[nodiscard]] std::uint32_t receivers_below(const ReceiverPacket& receivers) const;
  /// All overhangs of the neighborhood. Sorted out at the first call.
  [[nodiscard]] const OverhangFacets& facets();
  /// These and all of the cell's own buildings, for receivers in recesses: they know nothing of what the borders around them
  /// hide.
  [[nodiscard]] const OverhangFacets& facets_around_recesses();
  /// The same for rays, or the whole city. Built at the first call.
  [[nodiscard]] PlacedScene scene();

 private:
  enum class Surfaces : std::uint8_t { overhanging, grounded };
  /// Calls visit(triangles) for each of such surfaces of buildings in each cell.
  template <class Visit>
  void visit_surfaces(const CellRange& cells, Surfaces which, const Visit& visit) const;
  [[nodiscard]] std::vector<TriangleCorners> overhanging_in(const CellRange& cells) const;

  const PackageReader& package_;
  Cell cell_;
  const WholeCityOnDemand* city_;
  std::vector<TriangleCorners> overhead_;  ///< what may lie above receivers of the cell
  std::optional<OverhangFacets> facets_, around_recesses_;
  std::optional<Occluder> scene_;
};

/// A bit for each receiver.
struct Overhead {
  std::uint32_t below = 0;      ///< below an overhang: it sees no sky above it
  std::uint32_t in_recess = 0;  ///< of these, in a recess of a building (Recesses): only rays tell what it sees
};

/// Which of several lower borders of the far city, one above the other, a gap ends at.
enum class FarGapEnd : std::uint8_t {
  highest,  ///< an upper bound of the sky: all below the highest border may be open
  lowest    ///< the estimate: the borders above the lowest one belong to the same building
};

/// Horizons of edges alone, without the residual one: the grounded ones, and these with the borders of near overhangs.
class NearHorizons {
 public:
  explicit NearHorizons(const AzimuthSampling& azimuths)
      : grounded_(azimuths, PacketHorizon::Edges::tracked), upper_(azimuths, PacketHorizon::Edges::tracked), lower_(azimuths) {}

  /// Draws the borders above a grounded horizon, which is copied.
  void draw(const PacketHorizon& grounded, const OverhangEdges& near, const ReceiverPacket& receivers);

  [[nodiscard]] const PacketHorizon& grounded() const { return grounded_; }
  [[nodiscard]] bool has_upper_borders() const { return has_upper_; }
  /// Without any, the grounded horizon. Its drawn() are the borders alone.
  [[nodiscard]] const PacketHorizon& upper_borders() const { return has_upper_ ? upper_ : grounded_; }
  [[nodiscard]] const PacketHorizon& lower_borders() const { return has_lower_ ? lower_ : grounded_; }

 private:
  PacketHorizon grounded_, upper_, lower_;
  bool has_upper_ = false, has_lower_ = false;
};

/// The slopes between which a packet's receivers may see sky, where something overhangs. Each azimuth is divided, from below:
///
///     0 … grounded                      hidden
///     grounded … lower_borders          a gap: sky may be seen, but for the slopes between the two far borders
///     lower_borders … upper_borders     hidden
///     upper_borders … ∞                 sky
struct OverhangHorizons {
  /// `upper_edges`: of the grounded horizon and of the upper borders.
  explicit OverhangHorizons(const AzimuthSampling& azimuths, PacketHorizon::Edges upper_edges = PacketHorizon::Edges::unknown)
      : grounded(azimuths, upper_edges),
        lower_borders(azimuths),
        upper_borders(azimuths, upper_edges),
        far_lower_borders(azimuths),
        far_upper_borders(azimuths) {}

  PacketHorizon grounded;
  PacketHorizon lower_borders, upper_borders;
  PacketHorizon far_lower_borders, far_upper_borders;  ///< of the far city alone

  /// Draws overhangs above `grounded`. `upper_borders` may hold the residual horizon's already, and with FarGapEnd::highest
  /// `lower_borders` too; they must not be lower than `grounded`. The near ones may be drawn already.
  void draw_overhangs(const CellOverhangs& overhangs, const ReceiverPacket& receivers, const Overhead& overhead,
                      FarGapEnd far_end, const NearHorizons* near = nullptr);
  /// The sky in the gaps, a row for each azimuth; no rows where there is no gap. Afterwards `lower_borders` and the far horizons
  /// are the ends of these gaps.
  [[nodiscard]] std::span<const PacketHorizon::Row> find_sky_in_gaps(SkyWeight weight, const ReceiverPacket& receivers,
                                                                     std::vector<PacketHorizon::Row>& rows);

 private:
  std::vector<PacketHorizon::Row> far_sky_;
};

}  // namespace farlod
