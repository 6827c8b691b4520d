// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "farlod/point.hpp"
#include "package/package_reader.hpp"
#include "receivers/receiver.hpp"

namespace farlod::benchmark {

/// Where the measured receivers stand.
enum class Place { ground, roofs, walls };
[[nodiscard]] const char* name_of(Place place);

/// Cells spread evenly over the grid; all of them when there are fewer.
[[nodiscard]] std::vector<Cell> spread_cells(const Grid& grid, std::size_t count);

/// Receivers by cell. Answers go to 0, 1, … count − 1.
struct CityReceivers {
  std::vector<CellReceivers> cells;
  std::size_t count = 0;
  double placing_s = 0.0;  ///< wall clock
};

/// On the ground: pixels of `spacing_m`, 1.5 m above it. On surfaces: a receiver for each square of that edge.
[[nodiscard]] CityReceivers place_receivers(const PackageReader& package, std::span<const Cell> cells, Place place,
                                            double spacing_m);

/// Random ones among them, those of choose_some(all.count, count), renumbered in the same order.
[[nodiscard]] CityReceivers choose_receivers(const CityReceivers& all, std::size_t count);

/// Directions around the z axis whose mean is a cosine-weighted view factor: a spherical Fibonacci lattice (u = (i + ½)/n,
/// azimuths one golden angle apart) mapped to the hemisphere by r = √u. At the same number of rays its error is below that of
/// random or stratified directions.
[[nodiscard]] std::vector<Point3d> fibonacci_directions(std::size_t count);

/// The order in which directions are traced.
enum class DirectionOrder {
  as_given,  ///< successive ones of the lattice are far apart
  curve      ///< along a space-filling curve over the disk under the hemisphere: successive ones meet the same part of the city
};
void put_in_order(DirectionOrder order, std::vector<Point3d>& directions);

/// Turned from the z axis to a normal of length 1; those that point below the horizon are left out.
[[nodiscard]] std::vector<Point3f> directions_around(std::span<const Point3d> local, const Point3f& normal);

/// One packet of Embree.
inline constexpr std::size_t packet_lanes = 16;

/// Neighboring receivers that look the same way, so that they can share each direction. In the frame of WholeCity.
struct SharedPacket {
  Point3f normal;
  std::size_t count = 0;
  std::array<Point3f, packet_lanes> p_scene;
  std::array<std::size_t, packet_lanes> index{};
};

/// Puts the receivers of each cell into packets: those of one surface along a curve over it. Ground receivers come as patches of
/// 4 × 4 pixels already.
[[nodiscard]] std::vector<SharedPacket> packets_of(const Grid& grid, const CityReceivers& receivers);

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

/// Place of a point of the unit square on the Hilbert curve: what is near on the curve is near in the square.
[[nodiscard]] std::uint64_t place_on_curve(double x, double y);

}  // namespace farlod::benchmark
