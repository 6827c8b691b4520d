// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

}  // namespace farlod
