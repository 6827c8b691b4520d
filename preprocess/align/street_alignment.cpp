// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "align/street_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/paging/paged_array.hpp"
#include "farlod/surface_kind.hpp"

namespace farlod::align {
namespace {

/// A wall as seen from above. Its direction modulo 90° is that of a right-angled grid, so four times the angle is kept.
struct Wall {
  std::complex<double> fourfold;  ///< e^{4it}, t the azimuth of the wall or, the same modulo 90°, of its normal
  double length_m = 0.0;
};

/// Twice the area, along the normal: the sum over triangles around the first vertex (Newell 1972).
Point3d doubled_area_vector(std::span<const Point3d> ring) {
  Point3d sum;
  for (std::size_t k = 2; k < ring.size(); ++k) sum = sum + cross(ring[k - 1] - ring[0], ring[k] - ring[0]);
  return sum;
}

double height_of(std::span<const Point3d> points) {
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const Point3d& a, const Point3d& b) { return a.z < b.z; });
  return high->z - low->z;
}

std::complex<double> fourfold_of(Point2d normal) {
  const std::complex<double> once = std::complex<double>(normal.y, normal.x) / norm(normal);  // cos t + i sin t
  return (once * once) * (once * once);
}

/// The walls of a building. Area over the building's height is a wall's length, however it is cut into triangles, whose own
/// edges would count diagonals as streets.
void append_walls(const CityModel& city, const Building& b, PagedArray<Wall>& walls) {
  const auto points = city.points_of(b);
  if (points.empty()) return;
  const double height_m = height_of(points);
  for (const Facet& f : city.facets_of(b)) {
    if (f.ring_count == 0) continue;
    const Point3d doubled = doubled_area_vector(city.ring(f, 0));
    const double doubled_area_m2 = norm(doubled);
    if (!(doubled_area_m2 > 0.0) || std::abs(doubled.z) >= wall_normal_z * doubled_area_m2) continue;
    walls.push_back({fourfold_of(horizontal(doubled)), 0.5 * doubled_area_m2 / height_m});
  }
}

PagedArray<Wall> walls_of(const CityModel& city) {
  PagedArray<Wall> walls;
  city.for_each_building([&](std::size_t, const Building& b) { append_walls(city, b, walls); });
  return walls;
}

/// Walls along one street differ by a degree or two, as surveyed; separate grids by more than ten.
constexpr Angle half_window = Angle::degrees(5.0);
constexpr int bins = 90;  // of one degree

int bin_of(std::complex<double> fourfold) {
  const double turn = std::arg(fourfold) / (2.0 * std::numbers::pi) + 0.5;  // in [0, 1], half a turn ahead
  return std::min(static_cast<int>(turn * bins), bins - 1);
}

/// The middle of the window of bins with the longest walls; of equals, the first.
std::complex<double> peak_of(const PagedArray<Wall>& walls) {
  std::array<double, bins> length_m{};
  for (const Wall& w : walls) length_m[static_cast<std::size_t>(bin_of(w.fourfold))] += w.length_m;
  constexpr int reach = 4;
  int best = 0;
  double longest_m = -1.0;
  for (int middle = 0; middle < bins; ++middle) {
    double sum_m = 0.0;
    for (int k = middle - reach; k <= middle + reach; ++k) sum_m += length_m[static_cast<std::size_t>((k + bins) % bins)];
    if (sum_m > longest_m) best = middle, longest_m = sum_m;
  }
  return std::polar(1.0, 2.0 * std::numbers::pi * ((best + 0.5) / bins - 0.5));
}

/// Mean direction of the walls within the window around `centre`.
std::complex<double> mean_around(const PagedArray<Wall>& walls, std::complex<double> centre) {
  const double least_cosine = cos(4.0 * half_window);
  std::complex<double> sum;
  for (const Wall& w : walls)
    if ((w.fourfold * std::conj(centre)).real() >= least_cosine) sum += w.length_m * w.fourfold;
  return std::abs(sum) > 0.0 ? sum / std::abs(sum) : centre;
}

/// Moves the window to the mean of what it shows until it stays (mean shift, Cheng 1995), so that where the bins of the
/// histogram began is forgotten.
std::complex<double> refine(const PagedArray<Wall>& walls, std::complex<double> centre) {
  constexpr int most_moves = 100;  // the walls in the window are a finite choice: real cities need about ten
  for (int move = 0; move < most_moves; ++move) {
    const std::complex<double> next = mean_around(walls, centre);
    if (next == centre) break;
    centre = next;
  }
  return centre;
}

/// In (-45°, 45°]: the principal argument is in [-π, π], and -π is the same street as π.
Angle bearing_of(std::complex<double> fourfold) {
  const double turn = std::arg(fourfold);
  return Angle::radians(0.25 * (turn <= -std::numbers::pi ? std::numbers::pi : turn));
}

}  // namespace

Alignment street_alignment(const CityModel& city) {
  const PagedArray<Wall> walls = walls_of(city);
  double length_m = 0.0;
  std::complex<double> sum;
  for (const Wall& w : walls) {
    length_m += w.length_m;
    sum += w.length_m * w.fourfold;
  }
  if (!(length_m > 0.0)) return {};
  return {bearing_of(refine(walls, peak_of(walls))), std::min(std::abs(sum) / length_m, 1.0)};
}

}  // namespace farlod::align
