// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "benchmark/receiver_packets.hpp"
#include "benchmark/rival_directions.hpp"
#include "farlod/point.hpp"
#include "package/package_reader.hpp"

namespace farlod::benchmark {

/// Ways to use Embree. The defaults are the fastest that were found.
struct RivalVariant {
  std::string name = "as measured";
  bool robust = false;
  bool coherent = true;
  bool packets = true;  ///< or single rays
  bool ends_above_city = false;
  bool high_quality = false;
  DirectionOrder order = DirectionOrder::curve;
  std::string device;  ///< settings of Embree's device, such as "isa=avx2"
};

/// The whole city's triangles, in the frame of WholeCity.
struct CityTriangles {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
};
[[nodiscard]] CityTriangles triangles_of(const PackageReader& package);

/// What a far map has to beat: the whole city in one scene of Embree, asked in packets of one direction from 16 neighboring
/// receivers.
class WholeCityRival {
 public:
  /// Indexes the triangles, which must outlive it.
  WholeCityRival(const CityTriangles& city, RivalVariant variant = {});
  ~WholeCityRival();

  /// Memory of the index, without the triangles themselves.
  [[nodiscard]] std::size_t index_bytes() const;

  /// The share of the directions, given around the z axis, that meet nothing. On all cores.
  void evaluate(std::span<const SharedPacket> packets, std::vector<Point3d> directions, std::span<float> svf) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace farlod::benchmark
