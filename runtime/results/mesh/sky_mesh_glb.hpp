// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "results/table/table_writer.hpp"

namespace farlod {

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
