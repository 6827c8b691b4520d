// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/surfaces.hpp"
#include "results/spool_file.hpp"

namespace farlod {

/// The polygons of the roofs and walls of some buildings, from a package. It holds some bytes for each surface; its triangles
/// wait in a file. All functions throw OutputError, which names the result, and the first what geometry_of() throws.
class SurfaceShapes {
 public:
  /// `buildings` must outlive it.
  SurfaceShapes(const Package& package, std::span<const BuildingMean> buildings, const std::filesystem::path& result);

  /// Buildings that share an id count as one, with all surfaces of the number.
  [[nodiscard]] std::vector<SurfacePolygon> of(std::string_view building, std::uint32_t surface);

 private:
  using SpaceTriangle = std::array<Point3d, 3>;
  /// Triangles in the file that follow each other, of one surface.
  struct Piece {
    std::uint32_t building, surface;
    std::uint32_t triangles;
    std::uint64_t begin;
  };
  static std::pair<std::uint32_t, std::uint32_t> place_of(const Piece& piece) { return {piece.building, piece.surface}; }

  void add(const MeshPart& part);

  std::unordered_map<std::string_view, std::uint32_t> numbers_;  ///< of the buildings, in the order of their rows
  SpoolFile file_;
  std::vector<Piece> pieces_;  ///< by building and surface
};

}  // namespace farlod
