// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <utility>

#include "occlusion/device_embree.hpp"
#include "occlusion/occluder.hpp"
#include "occlusion/queries_embree.hpp"

namespace farlod {
namespace {

/// Embree hands the context of a query back to the filter; ours carries the question that the filter shall ask.
struct QueryContext {
  EmbreeContext embree;
  const std::function<bool(std::uint32_t triangle)>* counts = nullptr;
};

void ask_query(const RTCFilterFunctionNArguments* arguments) {
  const auto* context = reinterpret_cast<const QueryContext*>(arguments->context);
  if (context->counts == nullptr) return;
  for (unsigned n = 0; n < arguments->N; ++n)
    if (arguments->valid[n] == -1 && !(*context->counts)(RTCHitN_primID(arguments->hit, arguments->N, n)))
      arguments->valid[n] = 0;
}

RTCRayHit embree_ray(const Ray& ray) {
  RTCRayHit query{};
  query.ray = {ray.origin.x,
               ray.origin.y,
               ray.origin.z,
               ray.begin,
               ray.direction.x,
               ray.direction.y,
               ray.direction.z,
               0.0F,
               ray.end,
               0xFFFFFFFF,
               0,
               0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct Occluder::Impl {
  std::vector<Point3f> vertices;
  std::vector<Triangle> triangles;
  OwnedScene scene;  ///< none without triangles

  Impl(std::vector<Point3f> v, std::vector<Triangle> t, const std::stop_token& stop)
      : vertices(std::move(v)), triangles(std::move(t)) {
    if (triangles.empty()) return;
    const std::size_t vertex_count = vertices.size();
    vertices.push_back({});  // Embree reads the last vertex as 16 bytes
    scene =
        scene_of(RTC_GEOMETRY_TYPE_TRIANGLE, std::to_string(triangles.size()) + " triangles", stop, [&](RTCGeometry geometry) {
          rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0, sizeof(Point3f),
                                     vertex_count);
          rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(Triangle),
                                     triangles.size());
          rtcSetGeometryIntersectFilterFunction(geometry, ask_query);
        });
  }

  /// The nearest of all triangles where `counts` is null.
  std::optional<Hit> nearest(const Ray& ray, const std::function<bool(std::uint32_t)>* counts) const {
    if (scene == nullptr) return std::nullopt;
    QueryContext context{embree_context(), counts};
    RTCRayHit query = embree_ray(ray);
    ask_nearest(scene.get(), context.embree, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.ray.tfar, query.hit.primID};
  }

  Hits nearest(const RayOrigins& origins, const Directions& directions, float begin, std::uint32_t wanted) const {
    Hits hits;
    hits.distances.fill(std::numeric_limits<float>::infinity());
    if (scene == nullptr || wanted == 0) return hits;
    QueryContext context{embree_context(), nullptr};
    const RayPacket packet(origins, directions, begin, wanted);
    RTCRayHit16 query;
    query.ray = packet.rays;
    std::fill_n(query.hit.geomID, RayOrigins::lanes, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], RayOrigins::lanes, RTC_INVALID_GEOMETRY_ID);
    ask_nearest(packet.valid.data(), scene.get(), context.embree, query);
    for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) {
      if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      hits.distances[lane] = query.ray.tfar[lane];
      hits.triangles[lane] = query.hit.primID[lane];
    }
    return hits;
  }
};

Occluder::Occluder(std::vector<Point3f> vertices, std::vector<Triangle> triangles, const std::stop_token& stop)
    : impl_(std::make_unique<Impl>(std::move(vertices), std::move(triangles), stop)) {}
Occluder::Occluder(Occluder&&) noexcept = default;
Occluder& Occluder::operator=(Occluder&&) noexcept = default;
Occluder::~Occluder() = default;

std::size_t Occluder::triangle_count() const { return impl_->triangles.size(); }

bool Occluder::blocks(const Ray& ray) const {
  if (impl_->scene == nullptr) return false;
  OcclusionArguments arguments = occlusion_arguments(/*coherent=*/false);
  RTCRay query = embree_ray(ray).ray;
  ask_occluded(impl_->scene.get(), arguments, query);
  return query.tfar < 0.0F;  // Embree's sign for "blocked"
}

std::uint32_t Occluder::blocked(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted) const {
  return blocked(origins, sixteen_times(direction), begin, wanted);
}

std::uint32_t Occluder::blocked(const RayOrigins& origins, const Directions& directions, float begin,
                                std::uint32_t wanted) const {
  if (impl_->scene == nullptr || wanted == 0) return 0;
  OcclusionArguments arguments = occlusion_arguments(/*coherent=*/true);
  RayPacket packet(origins, directions, begin, wanted);
  ask_occluded(packet.valid.data(), impl_->scene.get(), arguments, packet.rays);
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < RayOrigins::lanes; ++lane) bits |= packet.rays.tfar[lane] < 0.0F ? 1U << lane : 0U;
  return bits & wanted;
}

Occluder::Distances Occluder::distances(const RayOrigins& origins, const Point3f& direction, float begin,
                                        std::uint32_t wanted) const {
  return distances(origins, sixteen_times(direction), begin, wanted);
}

Occluder::Distances Occluder::distances(const RayOrigins& origins, const Directions& directions, float begin,
                                        std::uint32_t wanted) const {
  return impl_->nearest(origins, directions, begin, wanted).distances;
}

Occluder::Hits Occluder::nearest(const RayOrigins& origins, const Point3f& direction, float begin, std::uint32_t wanted) const {
  return impl_->nearest(origins, sixteen_times(direction), begin, wanted);
}

Occluder::Hits Occluder::nearest(const RayOrigins& origins, const Directions& directions, float begin,
                                 std::uint32_t wanted) const {
  return impl_->nearest(origins, directions, begin, wanted);
}

std::optional<Hit> Occluder::nearest(const Ray& ray) const { return impl_->nearest(ray, nullptr); }

std::optional<Hit> Occluder::nearest(const Ray& ray, const std::function<bool(std::uint32_t)>& counts) const {
  return impl_->nearest(ray, &counts);
}

}  // namespace farlod
