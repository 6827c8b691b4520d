// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "benchmark/whole_city_rival.hpp"
#include "occlusion/queries_embree.hpp"

namespace farlod::benchmark {

std::vector<Point3d> fibonacci_directions(std::size_t count) {
  constexpr double golden_turn = 2.0 - std::numbers::phi;
  std::vector<Point3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double azimuth = 2.0 * std::numbers::pi * golden_turn * static_cast<double>(i), r = std::sqrt(u);
    directions.push_back({r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1.0 - u)});
  }
  return directions;
}

void put_in_order(DirectionOrder order, std::vector<Point3d>& directions) {
  if (order == DirectionOrder::as_given) return;
  const auto place = [](const Point3d& d) { return place_on_curve(0.5 * (d.x + 1.0), 0.5 * (d.y + 1.0)); };
  std::stable_sort(directions.begin(), directions.end(), [&](const Point3d& a, const Point3d& b) { return place(a) < place(b); });
}

std::vector<Point3f> directions_around(std::span<const Point3d> local, const Point3f& normal) {
  const Point3d n = normalized(Point3d{normal.x, normal.y, normal.z});
  // One axis along the contour line of the surface, one up its slope
  Point3d contour = normalized(cross(Point3d{0.0, 0.0, 1.0}, n));
  if (contour == Point3d{}) contour = {n.z, 0.0, 0.0};
  const Point3d upslope = cross(n, contour);
  std::vector<Point3f> result;
  for (const Point3d& d : local) {
    const Point3d direction = d.x * contour + d.y * upslope + d.z * n;
    if (direction.z > 0.0)
      result.push_back({static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z)});
  }
  return result;
}

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

namespace {

constexpr float farthest_m = std::numeric_limits<float>::infinity();
/// Packets that a thread takes at a time.
constexpr std::size_t packets_at_once = 16;

bool count_bytes(void* total, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<ssize_t>*>(total)->fetch_add(bytes);
  return true;
}

/// The rays of one packet of receivers. Origins are loaded once; only directions change.
struct Lanes {
  alignas(64) RTCRay16 rays{};
  alignas(64) std::array<int, packet_lanes> valid{};
  std::array<std::uint32_t, packet_lanes> free{};
  std::size_t used = 0, directions = 0;  ///< so many directions are asked at once: a small packet fills its lanes with several

  explicit Lanes(const SharedPacket& packet) : directions(packet_lanes / packet.count) {
    used = directions * packet.count;
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
      const Point3f& p = packet.p_scene[lane % packet.count];
      rays.org_x[lane] = p.x;
      rays.org_y[lane] = p.y;
      rays.org_z[lane] = p.z;
      rays.tnear[lane] = least_distance_m;
      rays.mask[lane] = 0xFFFFFFFF;
    }
  }

  void point(std::span<const Point3f> some, std::size_t receivers) {
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
      const std::size_t d = lane / receivers;
      const Point3f& direction = some[d < some.size() ? d : 0];
      valid[lane] = lane < used && d < some.size() ? -1 : 0;
      rays.dir_x[lane] = direction.x;
      rays.dir_y[lane] = direction.y;
      rays.dir_z[lane] = direction.z;
    }
  }
  void end_at(float top_m) {
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) rays.tfar[lane] = (top_m - rays.org_z[lane]) / rays.dir_z[lane];
  }
};

}  // namespace

struct WholeCityRival::Impl {
  RivalVariant variant;
  std::atomic<ssize_t> bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  float top_m = 0.0F;

  Impl(const CityTriangles& city, RivalVariant v) : variant(std::move(v)), device(rtcNewDevice(variant.device.c_str())) {
    if (device == nullptr) throw std::runtime_error("Embree could not be started");
    rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, variant.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, variant.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    attach(city);
    rtcCommitScene(scene);
    for (const Point3f& p : city.vertices) top_m = std::max(top_m, p.z);
    top_m += 1.0F;
  }
  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void attach(const CityTriangles& city) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, city.vertices.data(), 0, sizeof(Point3f),
                               city.vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, city.triangles.data(), 0, sizeof(Triangle),
                               city.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  void trace(const SharedPacket& packet, std::span<const Point3f> directions, std::size_t ray_count, std::span<float> svf) const {
    Lanes lanes(packet);
    OcclusionArguments arguments = occlusion_arguments(variant.coherent);
    for (std::size_t d = 0; d < directions.size(); d += lanes.directions) {
      lanes.point(directions.subspan(d, std::min(lanes.directions, directions.size() - d)), packet.count);
      ask(lanes, arguments);
    }
    for (std::size_t lane = 0; lane < lanes.used; ++lane)
      if (lane >= packet.count) lanes.free[lane % packet.count] += lanes.free[lane];
    for (std::size_t n = 0; n < packet.count; ++n)
      svf[packet.index[n]] = static_cast<float>(lanes.free[n]) / static_cast<float>(ray_count);
  }

  void ask(Lanes& lanes, OcclusionArguments& arguments) const {
    if (variant.ends_above_city)
      lanes.end_at(top_m);
    else
      std::fill_n(lanes.rays.tfar, packet_lanes, farthest_m);
    if (variant.packets)
      ask_occluded(lanes.valid.data(), scene, arguments, lanes.rays);
    else
      ask_one_by_one(lanes, arguments);
    // Embree's sign for "blocked" is a negative end
    for (std::size_t lane = 0; lane < packet_lanes; ++lane)
      lanes.free[lane] += lanes.valid[lane] != 0 && lanes.rays.tfar[lane] >= 0.0F ? 1U : 0U;
  }

  void ask_one_by_one(Lanes& lanes, OcclusionArguments& arguments) const {
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
      if (lanes.valid[lane] == 0) continue;
      RTCRay ray = rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&lanes.rays), packet_lanes, static_cast<unsigned>(lane));
      ask_occluded(scene, arguments, ray);
      lanes.rays.tfar[lane] = ray.tfar;
    }
  }
};

WholeCityRival::WholeCityRival(const CityTriangles& city, RivalVariant variant)
    : impl_(std::make_unique<Impl>(city, std::move(variant))) {}
WholeCityRival::~WholeCityRival() = default;

std::size_t WholeCityRival::index_bytes() const { return static_cast<std::size_t>(impl_->bytes.load()); }

void WholeCityRival::evaluate(std::span<const SharedPacket> packets, std::vector<Point3d> directions,
                              std::span<float> svf) const {
  put_in_order(impl_->variant.order, directions);
  const oneapi::tbb::blocked_range<std::size_t> all(0, packets.size(), packets_at_once);
  oneapi::tbb::parallel_for(all, [&](const oneapi::tbb::blocked_range<std::size_t>& some) {
    std::vector<Point3f> turned;
    for (std::size_t n = some.begin(); n < some.end(); ++n) {
      if (turned.empty() || packets[n].normal != packets[n - 1].normal) turned = directions_around(directions, packets[n].normal);
      impl_->trace(packets[n], turned, directions.size(), svf);
    }
  });
}

}  // namespace farlod::benchmark
