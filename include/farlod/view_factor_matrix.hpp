// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/evaluation.hpp"
#include "farlod/export.hpp"
#include "farlod/inspection.hpp"
#include "farlod/package.hpp"
#include "farlod/point.hpp"
#include "farlod/run.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/word.hpp"

namespace farlod {

/// What a surface sees besides surfaces and the ground of the grid's cells.
enum class MatrixRest : std::uint8_t {
  ground_beyond,  ///< the ground beyond the grid
  sky,
  crown,   ///< crowns of trees, as if nothing passed them
  other,   ///< undersides, the backs of surfaces, and surfaces that have no row
  dropped  ///< surfaces and ground of which less is seen than MatrixSettings::threshold, together
};
inline constexpr std::array<Word<MatrixRest>, 5> matrix_rest_words{{{"ground_beyond", MatrixRest::ground_beyond},
                                                                    {"sky", MatrixRest::sky},
                                                                    {"crown", MatrixRest::crown},
                                                                    {"other", MatrixRest::other},
                                                                    {"dropped", MatrixRest::dropped}}};

struct MatrixSettings {
  /// A view factor below it has no entry, and goes to MatrixRest::dropped: 0 to 1.
  double threshold = 1e-4;
};

/// What rays found before it was made reciprocal, and what became of it.
struct MatrixFigures {
  std::size_t receivers = 0, rays = 0;  ///< receivers of all surfaces, rays of each
  /// How far the rays of two surfaces differ in what they find of each other, as a view factor of the larger one:
  /// |A_i F_ij − A_j F_ji| / max(A_i, A_j), over all pairs that see each other.
  double reciprocity_mean = 0.0, reciprocity_max = 0.0;
  /// What a surface sees of others changed by so much, which what is no surface took up.
  double closure_mean = 0.0, closure_max = 0.0;
  /// Surfaces that see nothing but surfaces, whose rows were divided by their sums instead: these are less reciprocal.
  std::size_t divided_rows = 0;
  double dropped_mean = 0.0, dropped_max = 0.0;
};

/// The ground of a cell of the grid.
struct GroundColumn {
  CellPlace cell;
  Point2d centre_projected;
};

/// View factors between the surfaces of buildings, row by row (CSR). Rows are those of SurfaceMeans::surfaces. Columns are these,
/// then the ground of each cell of the grid, then MatrixRest:
///
///   (1) entry ij is the share of the view of surface i, weighted by the cosine, that surface j fills
///   (2) each row adds up to 1, but for the rounding of floats; a surface none of whose receivers has an answer sees `other`
///   (3) A_i F_ij = A_j F_ji, with the areas here, where both have entries and neither row was divided
///   (4) the same package and settings give the same matrix, whatever the number of threads
struct ViewFactorMatrix {
  std::size_t surfaces = 0;
  std::vector<GroundColumn> ground;
  std::vector<double> area_m2;         ///< of each surface, as far as its receivers have answers
  std::vector<std::uint64_t> row_end;  ///< entries of this row and all before it
  std::vector<std::uint32_t> columns;  ///< of each entry, ascending within a row
  std::vector<float> values;
  MatrixFigures figures;

  [[nodiscard]] std::size_t column_count() const { return surfaces + ground.size() + matrix_rest_words.size(); }
  [[nodiscard]] std::size_t column_of(MatrixRest rest) const { return surfaces + ground.size() + static_cast<std::size_t>(rest); }
};

/// Traces rays from the receivers of all surfaces that have a row, wherever these receivers are, against the whole city, and
/// makes the matrix reciprocal: two surfaces that see each other have the mean of what the rays of both found, weighted by their
/// rays, and what is no surface takes up what that changes. `means` are those that evaluate_surfaces() gave for the same package
/// and `surfaces`. Of `evaluation`, rays, directions and the crowns' canopy count. Throws InvalidArgument, Cancelled,
/// LimitReached, PackageUnusable, PackageDamaged.
[[nodiscard]] FARLOD_EXPORT ViewFactorMatrix view_factor_matrix(const Package& package, const SurfaceSettings& surfaces,
                                                                std::span<const SurfaceMean> means,
                                                                const MatrixSettings& matrix = {},
                                                                const EvaluationSettings& evaluation = {},
                                                                const RunSettings& run = {});

}  // namespace farlod
