// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "results/spool_file.hpp"
#include "results/table/table_writer.hpp"

namespace farlod {

// Receivers as a point cloud with colours: PLY, binary, little endian. A vertex has x, y, z (double, in the CRS of the package),
// its normal nx, ny, nz (float; straight up where it has none), the answers under the names of their columns (float, NaN where
// there is none), and red, green, blue: those of a picture. Comments of the header are the frame's provenance. Normals are
// those of the grid of the CRS (TableFrame::convergence). All functions throw OutputError.

/// Points without a height are left out: a viewer has no place for them.
void write_points_ply(const PointRows& rows, const TableFrame& frame, const std::filesystem::path& path);
void write_receivers_ply(SurfaceSpool& receivers, const TableFrame& frame, const std::filesystem::path& path);

}  // namespace farlod
