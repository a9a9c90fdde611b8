#include <algorithm>
#include <chrono>
#include <limits>
#include <mutex>

#include "raytrace/area_shadow.h"
#include "raytrace/packet.h"
#include "raytrace/surfel.h"
#include "scenes/emitter.h"
#include "scenes/light_frame.h"

namespace umbrameter {
namespace {

constexpr int tile_size = 32;

bool is_clear(const RayOrigin& origin, const vec3& direction) {
  return glm::dot(origin.normal, dvec3(direction)) > origin.clear_cosine;
}

// A ray to the light and how far it may go. The light itself is no blocker: the ray stops short of it by the rounding
// of its own length.
ShadowRay towards(const Light& light, const RayOrigin& origin) {
  ShadowRay ray;
  ray.origin = vec3(origin.point());
  if (std::holds_alternative<DirectionalLight>(light.shape)) {
    ray.direction = vec3(-light.axis());
    ray.reach = std::numeric_limits<float>::infinity();
    ray.is_clear = is_clear(origin, ray.direction);
    return ray;
  }
  const dvec3 way = light.position() - dvec3(ray.origin);
  const double distance = glm::length(way);
  if (!(distance > 0.0)) return ray;  // the light is at the surfel: nothing lies between
  ray.direction = vec3(way / distance);
  ray.reach = static_cast<float>(distance * (1.0 - 0x1p-22));
  ray.is_clear = is_clear(origin, ray.direction);
  return ray;
}

}  // namespace

TracedVisibility trace_visibility(const Tracer& tracer, const GBuffer& gbuffer, const Light& light,
                                  const TruthSampling& sampling, const Progress& progress) {
  if (is_area(light)) return trace_area_visibility(tracer, gbuffer, light, sampling, progress);
  const auto start = std::chrono::steady_clock::now();
  const Image<float> none(gbuffer.width, gbuffer.height, 0.0f);
  TracedVisibility traced{Image<float>(gbuffer.width, gbuffer.height, 1.0f), {}, none, none, none};
  std::mutex mutex;
  parallel_tiles(
      gbuffer.width, gbuffer.height, tile_size,
      [&](const Tile& tile) {
        TraceStatistics statistics;
        Packet packet(tracer.state());
        SurfelTriangle last;
        std::size_t pixels[Packet::width];
        const auto flush = [&] {
          packet.trace();
          for (int lane = 0; lane < packet.size(); ++lane) {
            traced.visibility[pixels[lane]] = packet.is_blocked(lane) ? 0.0f : 1.0f;
          }
          packet.clear();
        };
        const auto add = [&](std::size_t i) {
          if (!gbuffer.is_surface(i)) return;
          if (!(glm::dot(dvec3(gbuffer.geometric_normal[i]), to_light(light, dvec3(gbuffer.position[i]))) > 0.0)) {
            traced.visibility[i] = 0.0f;
            return;
          }
          const RayOrigin origin = ray_origin(tracer, gbuffer, i, last);
          statistics.largest_offset = std::max(statistics.largest_offset, origin.offset);
          ++statistics.rays;
          pixels[packet.size()] = i;
          packet.add(towards(light, origin), gbuffer.instance[i], gbuffer.triangle[i]);
          if (packet.is_full()) flush();
        };
        // In strips of four rows, so that the rays of a packet are near one another.
        for (int top = tile.y_begin; top < tile.y_end; top += 4) {
          for (int x = tile.x_begin; x < tile.x_end; ++x) {
            for (int y = top; y < std::min(top + 4, tile.y_end); ++y) add(gbuffer.instance.index(x, y));
          }
        }
        flush();
        tracer.state().rays_traced += statistics.rays;
        const std::lock_guard lock(mutex);
        traced.statistics.rays += statistics.rays;
        traced.statistics.largest_offset = std::max(traced.statistics.largest_offset, statistics.largest_offset);
      },
      progress);
  traced.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return traced;
}

}  // namespace umbrameter
