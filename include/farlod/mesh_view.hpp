// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "farlod/point.hpp"

namespace farlod {

/// Three vertices by number.
struct Triangle {
  std::uint32_t a = 0, b = 0, c = 0;
  bool operator==(const Triangle&) const = default;
};

/// Triangles that somebody else owns.
struct MeshView {
  std::span<const Point3f> vertices;
  std::span<const Triangle> triangles;
};

}  // namespace farlod
