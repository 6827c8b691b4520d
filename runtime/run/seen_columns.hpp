// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "farlod/point.hpp"
#include "farlod/surfaces.hpp"
#include "farlod/view_factor_matrix.hpp"
#include "package/package_reader.hpp"

namespace farlod {

/// Where things are among the columns of a ViewFactorMatrix.
struct MatrixColumns {
  std::uint32_t surfaces = 0, cells = 0;

  [[nodiscard]] std::uint32_t ground(std::size_t cell) const { return surfaces + static_cast<std::uint32_t>(cell); }
  [[nodiscard]] std::uint32_t rest(MatrixRest what) const { return surfaces + cells + static_cast<std::uint32_t>(what); }
  [[nodiscard]] std::uint32_t count() const { return surfaces + cells + static_cast<std::uint32_t>(matrix_rest_words.size()); }
};

/// The rows of surfaces by what names them.
class SurfaceRows {
 public:
  /// The means must outlive it.
  explicit SurfaceRows(std::span<const SurfaceMean> means);
  [[nodiscard]] std::optional<std::uint32_t> find(std::string_view building, std::uint32_t surface) const;

 private:
  std::map<std::pair<std::string_view, std::uint32_t>, std::uint32_t> rows_;
};

/// The columns of the triangles of a WholeCity, by the side that is met: the back of a surface is `other`. Immutable.
class SeenColumns {
 public:
  /// Throws Cancelled when `stop` is asked for meanwhile.
  SeenColumns(const PackageReader& package, const SurfaceRows& rows, const MatrixColumns& columns, const std::stop_token& stop);

  /// The column of a triangle that is met in this direction, grid frame.
  [[nodiscard]] std::uint32_t met(std::uint32_t triangle, const Point3f& direction) const {
    const Front& front = fronts_[front_of_triangle_[triangle]];
    const Point3f& n = front.normal;
    const bool is_back = n.x * direction.x + n.y * direction.y + n.z * direction.z > 0.0F;
    return is_back ? other_ : front.column;
  }

 private:
  /// Both sides of the ground are the same: its normal is 0.
  struct Front {
    Point3f normal;
    std::uint32_t column = 0;
  };
  void add(std::size_t triangles, const Front& front);

  std::vector<Front> fronts_;
  std::vector<std::uint32_t> front_of_triangle_;
  std::uint32_t other_;
};

}  // namespace farlod
