#include <limits>

#include "raytrace/ao_tile.h"

namespace umbrameter {
namespace {

bool needs_hits(const TruthParams& params) {
  return params.ao_falloff != AoFalloff::none || params.ao_layers != AoLayers::none;
}

// Accessibility, and the further layers that the result has.
template <class Packet>
struct Accessibility {
  using Rays = Packet;
  struct Sums {
    dvec3 open_direction{0.0};
    double blocked = 0.0;
    double blocked_distance = 0.0;
  };
  const TruthParams& params;
  TracedAo& result;

  Sums start(std::size_t, const RayOrigin&) const { return {}; }

  double add(Sums& sums, const TracedRay& ray) const {
    const double open =
        ray.is_blocked ? 1.0 - falloff_weight(params.ao_falloff, ray.distance, params.ao_distance.number) : 1.0;
    if (params.ao_layers == AoLayers::none) return open;
    if (ray.is_blocked) {
      sums.blocked += 1.0;
      sums.blocked_distance += ray.distance;
    }
    sums.open_direction += open * dvec3(ray.direction);
    return open;
  }

  void store(std::size_t pixel, const Sums& sums, const PixelEstimate& estimate) const {
    result.ao[pixel] = static_cast<float>(estimate.value);
    result.standard_error[pixel] = static_cast<float>(estimate.standard_error);
    result.variance[pixel] = static_cast<float>(estimate.variance);
    result.samples[pixel] = static_cast<float>(estimate.rays);
    if (result.bent_normal.size() > 0) {
      const double length = glm::length(sums.open_direction);
      result.bent_normal[pixel] = length > 0.0 ? vec3(sums.open_direction / length) : vec3(0);
    }
    if (result.hit_distance.size() > 0) {
      result.hit_distance[pixel] = sums.blocked > 0.0 ? static_cast<float>(sums.blocked_distance / sums.blocked)
                                                      : std::numeric_limits<float>::infinity();
    }
  }
};

}  // namespace

TracedAo trace_ao(const Tracer& tracer, const GBuffer& gbuffer, const TruthParams& params, std::uint32_t seed,
                  const Progress& progress) {
  check(params);
  TracedAo traced;
  traced.ao = Image<float>(gbuffer.width, gbuffer.height, 1.0f);
  traced.standard_error = traced.variance = traced.samples = Image<float>(gbuffer.width, gbuffer.height, 0.0f);
  const AoLayers layers = params.ao_layers;
  if (layers == AoLayers::bent_normal || layers == AoLayers::all) {
    traced.bent_normal = Image<vec3>(gbuffer.width, gbuffer.height, vec3(0));
  }
  if (layers == AoLayers::hit_distance || layers == AoLayers::all) {
    traced.hit_distance = Image<float>(gbuffer.width, gbuffer.height, std::numeric_limits<float>::infinity());
  }
  traced.degrees_of_freedom = degrees_of_freedom(params);
  const AoTask task{tracer, gbuffer, params, reach_of(params), seed};
  traced.statistics = needs_hits(params)
                          ? trace_ao_tiles(task, Accessibility<HitPacket>{params, traced}, progress)
                          : trace_ao_tiles(task, Accessibility<OcclusionPacket>{params, traced}, progress);
  traced.precision = precision_of(traced.standard_error, traced.samples, params);
  return traced;
}

}  // namespace umbrameter
