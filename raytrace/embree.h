// The only file that depends on Embree's version: 3.13 takes a context, 4 an arguments struct.
// For raytrace/*.cpp alone.
#pragma once

#ifndef UMBRAMETER_EMBREE_MAJOR
#error "only targets that link Embree may include this"
#endif
#if UMBRAMETER_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace umbrameter::embree {

#if UMBRAMETER_EMBREE_MAJOR >= 4
using Context = RTCRayQueryContext;
inline constexpr RTCSceneFlags query_filter_flag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using Context = RTCIntersectContext;
inline constexpr RTCSceneFlags query_filter_flag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// A query whose filter, if any, sees every hit. Embree hands the filter a pointer to `context`, the first member, so
/// that a standard-layout struct that begins with a Query can be recovered from it.
struct Query {
  Context context;
  RTCFilterFunctionN filter = nullptr;
#if UMBRAMETER_EMBREE_MAJOR >= 4
  RTCRayQueryFlags coherence = RTC_RAY_QUERY_FLAG_INCOHERENT;
#endif
};

inline void set_filter(Query& query, RTCFilterFunctionN filter) {
#if UMBRAMETER_EMBREE_MAJOR < 4
  query.context.filter = filter;
#endif
  query.filter = filter;
}

inline void prepare(Query& query, RTCFilterFunctionN filter) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&query.context);
#else
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
  set_filter(query, filter);
}

/// Tells Embree that the packets of this query hold rays of similar direction. The query may never return where Embree
/// traces packets of sixteen natively (docs/decisions/coherence-hint.md).
inline void hint_coherence(Query& query) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  query.coherence = RTC_RAY_QUERY_FLAG_COHERENT;
#else
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
}

#if UMBRAMETER_EMBREE_MAJOR >= 4
template <class Arguments>
void fill(Arguments& arguments, Query& query) {
  arguments.flags = static_cast<RTCRayQueryFlags>(
      query.coherence | (query.filter != nullptr ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : 0));
  arguments.context = &query.context;
  arguments.filter = query.filter;
}
#endif

inline void intersect1(RTCScene scene, RTCRayHit& ray, Query& query) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill(arguments, query);
  rtcIntersect1(scene, &ray, &arguments);
#else
  rtcIntersect1(scene, &query.context, &ray);
#endif
}

/// A blocked ray's tfar becomes −∞.
inline void occluded1(RTCScene scene, RTCRay& ray, Query& query) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  fill(arguments, query);
  rtcOccluded1(scene, &ray, &arguments);
#else
  rtcOccluded1(scene, &query.context, &ray);
#endif
}

/// valid[i] is −1 for lanes in use and 0 otherwise; a blocked lane's tfar becomes −∞.
inline void occluded16(const int* valid, RTCScene scene, RTCRay16& rays, Query& query) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  fill(arguments, query);
  rtcOccluded16(valid, scene, &rays, &arguments);
#else
  rtcOccluded16(valid, scene, &query.context, &rays);
#endif
}

/// valid[i] is −1 for lanes in use and 0 otherwise; a lane that hits has its hit and the distance in tfar.
inline void intersect16(const int* valid, RTCScene scene, RTCRayHit16& rays, Query& query) {
#if UMBRAMETER_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  fill(arguments, query);
  rtcIntersect16(valid, scene, &rays, &arguments);
#else
  rtcIntersect16(valid, scene, &query.context, &rays);
#endif
}

}  // namespace umbrameter::embree
