// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"

namespace farlod {

/// The names of the columns after those of surfaces: ground_I_J of the cell I, J, then the words of MatrixRest.
[[nodiscard]] std::vector<std::string> names_after_surfaces(const ViewFactorMatrix& matrix);

/// Writes a matrix as scipy.sparse.load_npz reads it (CSR), and further arrays, which only numpy.load shows:
/// docs/stages/results.md tells them. `surfaces` are its rows. The same matrix gives the same bytes, whatever the number of
/// threads. Throws OutputError.
void write_matrix_npz(const ViewFactorMatrix& matrix, std::span<const SurfaceMean> surfaces, const std::filesystem::path& path,
                      std::size_t threads);

}  // namespace farlod
