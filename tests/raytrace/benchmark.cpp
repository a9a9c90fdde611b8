// How fast the tracer is beside plain use of Embree on the same scene: umbrameter_raytrace_benchmark [SCENE] [--quick].
// All ways are run in turn, part by part, and a ratio is taken within each turn, so that a busy machine slows all of
// them alike. It does not quite: who waits for memory anyway loses less. "At best" is the ratio of the least times of
// all turns, each part's summed, which others on the machine disturb least.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "raytrace/packet.h"
#include "raytrace/sampler.h"
#include "raytrace/surfel.h"
#include "scenes/builtin.h"
#include "scenes/view.h"
#include "tests/support/benchmark_main.h"

namespace umbrameter {
namespace {

struct Setup {
  int width = 960;
  int height = 540;
  int spp = 1024;
  int turns = 5;
  int shadow_turns = 49;        // they are short
  std::size_t every_tile = 16;  // AO is traced in one tile of this many, at the full image's density
  std::size_t ao_parts = 8;     // over the number of threads, each of which needs many tiles at a time
};

/// A ray in memory, ready to go.
struct Ready {
  vec3 origin{0};
  vec3 direction{0, 0, 1};
  float reach = 0;
  std::uint32_t instance = no_id;
  std::uint32_t triangle = no_id;
};

using Rays = std::vector<Ready>;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Embree's own entry points, without a filter but that of masked geometry.
std::uint64_t count_open(const Tracer::State& state, RTCScene scene, const Ready* rays, std::size_t size) {
  RayQuery query;
  prepare(query, state, false);
  filter_every_hit(query, false);
  std::uint64_t open = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Ready& from = rays[i];
    RTCRay ray;
    ray.org_x = from.origin.x;
    ray.org_y = from.origin.y;
    ray.org_z = from.origin.z;
    ray.dir_x = from.direction.x;
    ray.dir_y = from.direction.y;
    ray.dir_z = from.direction.z;
    ray.tnear = 0.0f;
    ray.tfar = from.reach;
    ray.time = 0.0f;
    ray.mask = 0xffffffffu;
    ray.id = 0;
    ray.flags = 0;
    query.own_instance[0] = from.instance;
    query.own_triangle[0] = from.triangle;
    embree::occluded1(scene, ray, query.query);
    open += ray.tfar < 0.0f ? 0u : 1u;
  }
  return open;
}

std::uint64_t count_open_in_packets(const Tracer::State& state, RTCScene scene, const Ready* rays, std::size_t size) {
  RayQuery query;
  prepare(query, state, false);
  filter_every_hit(query, false);
  RTCRay16 packet;
  alignas(64) int valid[packet_width];
  std::uint64_t open = 0;
  for (std::size_t first = 0; first < size; first += packet_width) {
    for (std::size_t l = 0; l < packet_width; ++l) {
      const bool is_used = first + l < size;
      const Ready& from = rays[is_used ? first + l : first];
      packet.org_x[l] = from.origin.x;
      packet.org_y[l] = from.origin.y;
      packet.org_z[l] = from.origin.z;
      packet.dir_x[l] = from.direction.x;
      packet.dir_y[l] = from.direction.y;
      packet.dir_z[l] = from.direction.z;
      packet.tnear[l] = 0.0f;
      packet.tfar[l] = from.reach;
      packet.time[l] = 0.0f;
      packet.mask[l] = 0xffffffffu;
      packet.id[l] = static_cast<unsigned>(l);
      packet.flags[l] = 0;
      query.own_instance[l] = from.instance;
      query.own_triangle[l] = from.triangle;
      valid[l] = is_used ? -1 : 0;
    }
    embree::occluded16(valid, scene, packet, query.query);
    for (std::size_t l = 0; l < packet_width; ++l) open += valid[l] != 0 && !(packet.tfar[l] < 0.0f) ? 1u : 0u;
  }
  return open;
}

/// One way to trace the rays of a task.
struct Way {
  std::string name;
  std::function<void(std::size_t part)> trace;                ///< is timed
  std::function<std::uint64_t(std::size_t part)> count_open;  ///< the rays just traced that met nothing; is not
  std::vector<double> seconds{};                              ///< of each turn
  std::vector<double> least_seconds{};                        ///< of each part
  std::uint64_t open = 0;
};

using Count = std::uint64_t (*)(const Tracer::State&, RTCScene, const Ready*, std::size_t);

Way plain(std::string name, Count count, const Tracer::State& state, RTCScene scene, const std::vector<Rays>& parts) {
  const auto open = std::make_shared<std::atomic<std::uint64_t>>(0);
  const auto run = [open, count, &state, scene, &parts](std::size_t part) {
    constexpr std::size_t chunk = 1u << 14u;
    const Rays& rays = parts[part];
    *open = 0;
    parallel_for((rays.size() + chunk - 1) / chunk, [&](std::size_t i) {
      *open += count(state, scene, rays.data() + i * chunk, std::min(chunk, rays.size() - i * chunk));
    });
  };
  return {std::move(name), run, [open](std::size_t) { return open->load(); }};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

std::vector<double> ratios(const Way& slow, const Way& fast) {
  std::vector<double> ratio;
  for (std::size_t i = 0; i < fast.seconds.size(); ++i) ratio.push_back(slow.seconds[i] / fast.seconds[i]);
  return ratio;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// The first way is the measure, the last one ours.
void report(const std::string& task, std::vector<Way>& ways, const std::vector<Rays>& parts, int turns,
            bool on_all_threads) {
  for (Way& way : ways) way.least_seconds.assign(parts.size(), std::numeric_limits<double>::infinity());
  for (int turn = 0; turn < turns; ++turn) {
    for (Way& way : ways) {
      way.seconds.push_back(0.0);
      way.open = 0;
    }
    for (std::size_t part = 0; part < parts.size(); ++part) {
      for (Way& way : ways) {
        const auto start = std::chrono::steady_clock::now();
        const double cpu = cpu_seconds();
        way.trace(part);
        const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
        // One thread is timed by what it ran, whatever else the machine does.
        const double seconds = on_all_threads ? wall.count() : cpu_seconds() - cpu;
        way.seconds.back() += seconds;
        way.least_seconds[part] = std::min(way.least_seconds[part], seconds);
        way.open += way.count_open(part);
      }
    }
  }
  double rays = 0.0;
  for (const Rays& part : parts) rays += static_cast<double>(part.size());
  fmt::print("{}, {:.1f} M rays, {}\n", task, rays * 1e-6, on_all_threads ? "all threads" : "one thread");
  for (const Way& way : ways) {
    const auto against_first = ratios(ways.front(), way);
    const auto [least, most] = std::minmax_element(against_first.begin(), against_first.end());
    fmt::print("  {:<44} {:8.2f} Mray/s   {:.2f} times the first ({:.2f} to {:.2f}; at best {:.2f})   {:.4f} open\n",
               way.name, rays * 1e-6 / median(way.seconds), median(against_first), *least, *most,
               sum(ways.front().least_seconds) / sum(way.least_seconds), static_cast<double>(way.open) / rays);
  }
  const double first = static_cast<double>(ways.front().open);
  for (const Way& way : ways) {
    if (std::abs(static_cast<double>(way.open) - first) <= 0.01 * rays) continue;
    throw Error(ExitCode::check_failed, task + ", " + way.name,
                "it differs from the first way by more than one ray in a hundred", "run the tests");
  }
}

// The same geometry with the flags that Embree starts with.
ScenePtr default_scene(const Tracer::State& state) {
  ScenePtr scene(rtcNewScene(state.device.get()));
  const auto attach = [&](std::size_t id) {
    const RTCGeometry geometry = rtcGetGeometry(state.top.get(), static_cast<unsigned>(id));
    if (geometry != nullptr) rtcAttachGeometryByID(scene.get(), geometry, static_cast<unsigned>(id));
  };
  for (std::size_t i = 0; i < state.instances.size(); ++i) {
    attach(i);
    if (state.instances[i].huge != nullptr) attach(state.instances.size() + i);  // its huge triangles
  }
  rtcCommitScene(scene.get());
  check(state.device.get(), "benchmark");
  return scene;
}

constexpr int tile_side = 16;

using Corner = std::pair<int, int>;

// One tile of each so many in reading order, dealt out to so many parts.
std::vector<std::vector<Corner>> some_tiles(const GBuffer& gbuffer, std::size_t every, std::size_t parts) {
  std::vector<std::vector<Corner>> corners(parts);
  std::size_t tile = 0;
  std::size_t taken = 0;
  for (int y = 0; y + tile_side <= gbuffer.height; y += tile_side) {
    for (int x = 0; x + tile_side <= gbuffer.width; x += tile_side, ++tile) {
      if (tile % every != hash(static_cast<std::uint32_t>(tile / every)) % every) continue;
      corners[taken++ % parts].emplace_back(x, y);
    }
  }
  return corners;
}

// One below the other: as dense as in the whole image.
GBuffer cut_out(const GBuffer& gbuffer, const std::vector<Corner>& corners) {
  GBuffer tiles(tile_side, tile_side * static_cast<int>(corners.size()));
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int y = 0; y < tile_side; ++y) {
      for (int x = 0; x < tile_side; ++x) {
        const std::size_t to = tiles.instance.index(x, y + tile_side * static_cast<int>(t));
        const std::size_t from = gbuffer.instance.index(corners[t].first + x, corners[t].second + y);
        tiles.instance[to] = gbuffer.instance[from];
        tiles.triangle[to] = gbuffer.triangle[from];
        tiles.position[to] = gbuffer.position[from];
        tiles.geometric_normal[to] = gbuffer.geometric_normal[from];
        tiles.shading_normal[to] = gbuffer.shading_normal[from];
      }
    }
  }
  return tiles;
}

Ready leaving(const GBuffer& gbuffer, std::size_t pixel, TriangleCache& triangles, RayOrigin& origin) {
  origin = ray_origin(gbuffer, pixel, triangles);
  Ready ray;
  ray.origin = vec3(origin.point);
  ray.reach = std::numeric_limits<float>::infinity();
  ray.instance = gbuffer.instance[pixel];
  ray.triangle = gbuffer.triangle[pixel];
  return ray;
}

Rays random_directions(const Tracer& tracer, const GBuffer& gbuffer, int spp) {
  Rays rays;
  TriangleCache triangles(tracer);
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    RayOrigin origin;
    Ready ray = leaving(gbuffer, i, triangles, origin);
    const mat3 frame = frame_about(vec3(origin.normal));
    for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(spp); ++s) {
      ray.direction = frame * lift_cosine(concentric_disk(random_point(s, hash(static_cast<std::uint32_t>(i)))));
      rays.push_back(ray);
    }
  }
  return rays;
}

Rays towards_light(const Tracer& tracer, const GBuffer& gbuffer, const Light& light) {
  Rays rays;
  TriangleCache triangles(tracer);
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    RayOrigin origin;
    Ready ray = leaving(gbuffer, i, triangles, origin);
    dvec3 way = -light.axis();
    if (!std::holds_alternative<DirectionalLight>(light.shape)) {
      way = light.position() - origin.point;
      ray.reach = reach_to_light(glm::length(way));
    }
    if (!(glm::dot(dvec3(gbuffer.geometric_normal[i]), way) > 0.0)) continue;
    ray.direction = vec3(glm::normalize(way));
    rays.push_back(ray);
  }
  return rays;
}

void run(const std::string& name, const Setup& setup) {
  Scene scene = load_scene(name);
  std::vector<std::string> notes;
  add_missing_light(scene, notes);
  const double aspect = static_cast<double>(setup.width) / setup.height;
  const Tracer tracer(scene);
  const Tracer::State& state = tracer.state();
  const ScenePtr defaults = default_scene(state);
  const GBuffer gbuffer = trace_gbuffer(tracer, {setup.width, setup.height, select_camera(scene, "", aspect, notes)});
  fmt::print("{}: {} triangles, Embree {}\n", name, tracer.build_statistics().triangles, embree_version());
  const std::vector<Rays> shadow{towards_light(tracer, gbuffer, scene.lights.front())};
  TracedVisibility lit;
  const auto count_lit = [&](std::size_t) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < lit.visibility.size(); ++i) {
      if (gbuffer.is_surface(i) && lit.visibility[i] > 0.5f) ++count;
    }
    return count;
  };
  for (const bool on_all_threads : {false, true}) {
    const ThreadLimit limit(on_all_threads ? 0 : 1);
    std::vector<Way> ways{
        plain("one ray at a time, ready-made", &count_open, state, state.top.get(), shadow),
        plain("  the same, Embree's default flags", &count_open, state, defaults.get(), shadow),
        {"shadow rays, everything", [&](std::size_t) { lit = trace_visibility(tracer, gbuffer, scene.lights.front()); },
         count_lit}};
    report("shadow rays", ways, shadow, setup.shadow_turns, on_all_threads);
  }

  TruthParams params;
  params.spp = setup.spp;
  params.tolerance = 0.0;
  for (const bool on_all_threads : {false, true}) {
    const ThreadLimit limit(on_all_threads ? 0 : 1);
    const std::size_t threads = on_all_threads ? std::max(1u, std::thread::hardware_concurrency()) : 1u;
    std::vector<GBuffer> tiles;
    std::vector<Rays> hemisphere;
    for (const auto& corners :
         some_tiles(gbuffer, setup.every_tile, std::max<std::size_t>(setup.ao_parts / threads, 1))) {
      tiles.push_back(cut_out(gbuffer, corners));
      hemisphere.push_back(random_directions(tracer, tiles.back(), setup.spp));
    }
    TracedAo traced;
    const auto count_rays = [&](std::size_t part) {
      double open = 0.0;
      for (std::size_t i = 0; i < traced.ao.size(); ++i) {
        if (tiles[part].is_surface(i)) open += static_cast<double>(traced.ao[i]) * setup.spp;
      }
      return static_cast<std::uint64_t>(open + 0.5);
    };
    const RTCScene top = state.top.get();
    std::vector<Way> ways{plain("one ray at a time, ready-made", &count_open, state, top, hemisphere),
                          plain("  the same, Embree's default flags", &count_open, state, defaults.get(), hemisphere),
                          plain("packets of 16, ready-made", &count_open_in_packets, state, top, hemisphere),
                          {"ambient occlusion, everything",
                           [&](std::size_t part) { traced = trace_ao(tracer, tiles[part], params, 1); }, count_rays}};
    report("ambient occlusion", ways, hemisphere, setup.turns, on_all_threads);
  }
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  return umbrameter::benchmark_main<umbrameter::Setup>(argc, argv, {96, 54, 16, 1, 1, 4, 2}, &umbrameter::run);
}
