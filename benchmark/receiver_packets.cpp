// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/receiver_packets.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "benchmark/plane_curve.hpp"

namespace farlod::benchmark {
namespace {

constexpr Point3f up{0.0F, 0.0F, 1.0F};

/// Receivers in one plane may share directions; those of another wall that looks the same way are elsewhere.
using Plane = std::tuple<float, float, float, long>;

Plane plane_of(const Receiver& r) {
  const float distance_m = dot(r.normal, r.p_cell);
  return {r.normal.x, r.normal.y, r.normal.z, r.normal == up ? 0 : std::lround(distance_m)};
}

/// Where a receiver of a cell is on a curve over its surface: along the contour line and up the slope.
std::uint64_t place_on_surface(const Receiver& r, double cell_edge_m) {
  if (r.normal == up) return place_on_curve(r.p_cell.x / cell_edge_m, r.p_cell.y / cell_edge_m);
  constexpr double tallest_m = 512.0;  // and more than a cell is wide: both fit into the square
  const Point3f contour = normalized(cross(up, r.normal));
  const double along_m = dot(contour, r.p_cell) + 1.5 * cell_edge_m;
  return place_on_curve(along_m / tallest_m, 0.5 + r.p_cell.z / (2.0 * tallest_m));
}

void sort_along_surfaces(std::vector<Receiver>& receivers, double cell_edge_m) {
  const auto key = [cell_edge_m](const Receiver& r) { return std::tuple(plane_of(r), place_on_surface(r, cell_edge_m)); };
  std::stable_sort(receivers.begin(), receivers.end(), [&](const Receiver& a, const Receiver& b) { return key(a) < key(b); });
}

void append_packets(const std::vector<Receiver>& receivers, Point2d scene_from_cell_m, std::vector<SharedPacket>& packets) {
  const std::size_t first_of_cell = packets.size();
  for (const Receiver& r : receivers) {
    if (packets.size() == first_of_cell || packets.back().count == packet_lanes || packets.back().normal != r.normal)
      packets.push_back({r.normal, 0, {}, {}});
    SharedPacket& packet = packets.back();
    packet.p_scene[packet.count] = {static_cast<float>(r.p_cell.x + scene_from_cell_m.x),
                                    static_cast<float>(r.p_cell.y + scene_from_cell_m.y), r.p_cell.z};
    packet.index[packet.count++] = r.index;
  }
}

}  // namespace

std::vector<SharedPacket> packets_of(const Grid& grid, const CityReceivers& receivers) {
  std::vector<SharedPacket> packets;
  for (const CellReceivers& cell : receivers.cells) {
    std::vector<Receiver> ordered = cell.receivers;
    const bool all_horizontal = std::all_of(ordered.begin(), ordered.end(), [](const Receiver& r) { return r.normal == up; });
    if (!all_horizontal) sort_along_surfaces(ordered, grid.cell_edge_m);
    append_packets(ordered, grid.corner_of(cell.cell) - grid.middle_corner(), packets);
  }
  return packets;
}

}  // namespace farlod::benchmark
