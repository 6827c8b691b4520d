// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "occlusion/occluder.hpp"

namespace farlod {

/// Sixteen rays, as the engines trace them.
struct RayPacket {
  RayOrigins origins;
  Occluder::Directions directions;

  void set(std::size_t lane, const Ray& ray) {
    origins.x[lane] = ray.origin.x, origins.y[lane] = ray.origin.y, origins.z[lane] = ray.origin.z;
    directions.x[lane] = ray.direction.x, directions.y[lane] = ray.direction.y, directions.z[lane] = ray.direction.z;
  }
};

class RandomRays : public testing::Test {
 protected:
  /// In [−1, 1), the same on every machine.
  float random() { return static_cast<float>(static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0); }
  Point3f point(float size) {
    const float x = size * random(), y = size * random();
    return {x, y, size * random()};
  }
  std::mt19937_64 random_{20120901};
};

}  // namespace farlod
