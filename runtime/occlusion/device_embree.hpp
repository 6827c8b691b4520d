// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <new>
#include <stop_token>
#include <string>
#include <type_traits>

#include "base/cancellation.hpp"
#include "occlusion/occluder.hpp"
#include "occlusion/queries_embree.hpp"

namespace farlod {

/// One device for the process: Embree's threads and caches are shared by all scenes.
inline RTCDevice shared_device() {
  struct Device {
    RTCDevice handle = rtcNewDevice(nullptr);
    Device() {
      if (handle == nullptr)
        throw OcclusionError("Embree could not be started (error " + std::to_string(rtcGetDeviceError(nullptr)) + ")");
    }
    ~Device() { rtcReleaseDevice(handle); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
  };
  static const Device device;
  return device.handle;
}

/// Embree asks from several threads, and not at all in its first steps: a build of millions of triangles ends some tenths of a
/// second after the stop.
inline void commit_unless_stopped(RTCScene scene, const std::stop_token& stop) {
  if (stop.stop_possible())
    rtcSetSceneProgressMonitorFunction(
        scene, [](void* asked, double) { return !static_cast<const std::stop_token*>(asked)->stop_requested(); },
        const_cast<std::stop_token*>(&stop));
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
}

/// What the device says of a build on this thread. `counted` names what was indexed, as in "3 triangles".
inline void throw_of_build(RTCDevice device, const std::string& counted, const std::stop_token& stop) {
  const RTCError error = rtcGetDeviceError(device);
  throw_if_cancelled(stop);  // which is an error of Embree, too
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw OcclusionError("Embree could not index " + counted + " (error " + std::to_string(error) + ")");
}

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using OwnedScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// A scene of one geometry, whose bodies `describe(geometry)` says. `counted` names them, as in "3 triangles". Throws
/// OcclusionError, std::bad_alloc, or Cancelled after a stop.
template <class Describe>
[[nodiscard]] OwnedScene scene_of(RTCGeometryType type, const std::string& counted, const std::stop_token& stop,
                                  const Describe& describe) {
  const RTCDevice device = shared_device();
  (void)rtcGetDeviceError(device);  // what a build on this thread left, whatever it was: Embree keeps the first error
  OwnedScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device, type);
  describe(geometry);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  commit_unless_stopped(scene.get(), stop);
  throw_of_build(device, counted, stop);
  return scene;
}

/// Sixteen rays as Embree takes them. Each has its lane as number: where the processor has no vectors of sixteen numbers, Embree
/// shows them one by one, and does not look at `valid`. So those that are not wanted end before they begin, too.
struct RayPacket {
  static_assert(RayOrigins::lanes == 16);

  RayPacket(const RayOrigins& origins, const Occluder::Directions& directions, float begin, std::uint32_t wanted) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) {
      const bool is_wanted = ((wanted >> lane) & 1U) != 0;
      valid[lane] = is_wanted ? -1 : 0;
      rays.org_x[lane] = origins.x[lane];
      rays.org_y[lane] = origins.y[lane];
      rays.org_z[lane] = origins.z[lane];
      rays.dir_x[lane] = directions.x[lane];
      rays.dir_y[lane] = directions.y[lane];
      rays.dir_z[lane] = directions.z[lane];
      rays.tnear[lane] = begin;
      rays.tfar[lane] = is_wanted ? infinity : -infinity;
      rays.time[lane] = 0.0F;
      rays.mask[lane] = ~0U;
      rays.id[lane] = static_cast<unsigned>(lane);
      rays.flags[lane] = 0;
    }
  }

  alignas(64) std::array<int, RayOrigins::lanes> valid;
  RTCRay16 rays;
};

/// The same direction in each lane.
inline Occluder::Directions sixteen_times(const Point3f& direction) {
  Occluder::Directions alike;
  alike.x.fill(direction.x);
  alike.y.fill(direction.y);
  alike.z.fill(direction.z);
  return alike;
}

}  // namespace farlod
