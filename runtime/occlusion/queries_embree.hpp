// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How a ray is asked: Embree 3 takes a context, Embree 4 arguments that may point to one. Nothing else of what we use differs,
/// so that this is the one place that knows which of them was found (cmake/FarlodEmbree.cmake).
///
/// The branch of Embree 4 is not compiled on Debian 12, which has Embree 3 alone. Keep it as thin as it is.
///
/// In Embree 4 a geometry has the mask 1 where it had all bits in Embree 3. Rays have a mask of all bits and meet both, so no
/// mask is set.
#if FARLOD_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace farlod {

#if FARLOD_EMBREE_MAJOR >= 4

/// What a filter is handed. Our own data may stand behind it: Embree hands on the pointer that it was given.
using EmbreeContext = RTCRayQueryContext;
using OcclusionArguments = RTCOccludedArguments;

inline EmbreeContext embree_context() {
  EmbreeContext context;
  rtcInitRayQueryContext(&context);
  return context;
}

inline OcclusionArguments occlusion_arguments(bool coherent) {
  OcclusionArguments arguments;
  rtcInitOccludedArguments(&arguments);
  if (coherent) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  return arguments;
}

inline void ask_occluded(RTCScene scene, OcclusionArguments& arguments, RTCRay& ray) { rtcOccluded1(scene, &ray, &arguments); }

inline void ask_occluded(const int* valid, RTCScene scene, OcclusionArguments& arguments, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &rays, &arguments);
}

/// With a context of our own. Neighbors are not traced as one: Embree 3.13 may show a packet that is the same body twice.
inline void ask_occluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  OcclusionArguments arguments = occlusion_arguments(/*coherent=*/false);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}

inline void ask_occluded(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays) {
  OcclusionArguments arguments = occlusion_arguments(/*coherent=*/false);
  arguments.context = &context;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

/// Neighbors, traced as one, for those who do not mind to be shown a body twice.
inline void ask_occluded_together(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays) {
  OcclusionArguments arguments = occlusion_arguments(/*coherent=*/true);
  arguments.context = &context;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

inline void ask_nearest(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}

/// Neighbors, traced as one.
inline void ask_nearest(const int* valid, RTCScene scene, EmbreeContext& context, RTCRayHit16& rays) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;
using OcclusionArguments = RTCIntersectContext;

inline EmbreeContext embree_context() {
  EmbreeContext context;
  rtcInitIntersectContext(&context);
  return context;
}

inline OcclusionArguments occlusion_arguments(bool coherent) {
  OcclusionArguments arguments = embree_context();
  if (coherent) arguments.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return arguments;
}

inline void ask_occluded(RTCScene scene, OcclusionArguments& arguments, RTCRay& ray) { rtcOccluded1(scene, &arguments, &ray); }

inline void ask_occluded(const int* valid, RTCScene scene, OcclusionArguments& arguments, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &arguments, &rays);
}

inline void ask_nearest(RTCScene scene, EmbreeContext& context, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }

/// Neighbors, traced as one, for those who do not mind to be shown a body twice.
inline void ask_occluded_together(const int* valid, RTCScene scene, EmbreeContext& context, RTCRay16& rays) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

/// Neighbors, traced as one.
inline void ask_nearest(const int* valid, RTCScene scene, EmbreeContext& context, RTCRayHit16& rays) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
}

#endif

}  // namespace farlod
