// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "farlod/inspection.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

/// Writes geometry as a Wavefront OBJ file: a group for the ground and for each building, z up, coordinates to a tenth of a
/// millimetre, less an offset in whole metres that a comment tells. `remarks` are further comments, a line each. Throws
/// OutputError.
void write_obj(const std::vector<MeshPart>& parts, Point2d offset_m, const std::vector<std::string>& remarks,
               const std::filesystem::path& path);

/// What a file of binary glTF 2.0 has in front of its binary bytes: the heads, and the JSON.
[[nodiscard]] std::string glb_head(std::string json, std::uint64_t binary_bytes);

/// Writes points as coloured points of binary glTF. There is none for a point without a height.
void write_points_glb(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path);

/// The surfaces of the frame's package as triangles of binary glTF, each with the colour of its surface's mean; grey where it has
/// none. Beside it are the tables of surfaces and buildings, as CSV. Holds a pointer for each surface, and the geometry of one
/// block; what it writes waits on disk.
class SurfacesGlb : public SurfaceTablesWriter {
 public:
  SurfacesGlb(const TableFrame& frame, const std::filesystem::path& path) : frame_(frame), path_(path) {}
  void write_part(std::size_t, std::span<const SurfacePoint>) override {}
  [[nodiscard]] std::vector<std::filesystem::path> commit(std::span<const SurfaceMean> surfaces,
                                                          std::span<const BuildingMean> buildings) override;

 private:
  void write_mesh(std::span<const SurfaceMean> surfaces) const;

  TableFrame frame_;
  std::filesystem::path path_;
};

}  // namespace farlod
