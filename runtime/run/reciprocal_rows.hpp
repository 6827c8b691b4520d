// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "farlod/view_factor_matrix.hpp"
#include "run/surface_views.hpp"

namespace farlod {

/// A row as the rays of its surface found it.
struct FoundRow {
  double area_m2 = 0.0;
  std::size_t receivers = 0;
  std::vector<ViewShare> shares;  ///< in the order of their columns; the first columns are those of the surfaces
};

/// Rows of view factors with A_i F_ij = A_j F_ji, of what the rays of both surfaces found of each other: together they are one
/// sample, in which each surface has its rays to its area. What is no surface takes up what that changes of a row.
class ReciprocalRows {
 public:
  /// The rows must outlive it.
  explicit ReciprocalRows(std::span<const FoundRow> rows);

  /// The n-th row; empty where there are no receivers. Each is asked for once.
  [[nodiscard]] std::vector<ViewShare> row(std::size_t n);
  /// Those of what was found and of closure, once all rows were asked for.
  [[nodiscard]] MatrixFigures figures() const;

 private:
  /// What another surface found of the n-th, as an entry in the column of the other.
  [[nodiscard]] std::span<const ViewShare> found_by_others(std::size_t n) const;
  void add_pair(std::size_t n, ViewShare found, ViewShare by_other, std::vector<ViewShare>& row);
  void close(const FoundRow& found, double surfaces_before, std::vector<ViewShare>& row);

  std::span<const FoundRow> rows_;
  std::vector<std::uint64_t> ends_;  ///< in `by_others_`, of each surface
  std::vector<ViewShare> by_others_;
  std::size_t pairs_ = 0;
  double reciprocity_sum_ = 0.0, closure_sum_ = 0.0;
  MatrixFigures figures_;
};

}  // namespace farlod
