// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "farlod/point.hpp"

namespace farlod {

/// Three vertices by number.
struct Triangle {
  std::uint32_t a = 0, b = 0, c = 0;
  /// Its corners in turn, from 0 on: a, b, c, and a again.
  [[nodiscard]] std::uint32_t corner(std::size_t n) const { return n == 1 ? b : n == 2 ? c : a; }
  bool operator==(const Triangle&) const = default;
};

/// Triangles that somebody else owns.
struct MeshView {
  std::span<const Point3f> vertices;
  std::span<const Triangle> triangles;
  std::shared_ptr<const void> held = {};  ///< keeps them, where they were made for this view and its copies
};

}  // namespace farlod
