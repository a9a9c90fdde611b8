#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/primary_ray.h"
#include "raytrace/tracer_state.h"
#include "scenes/material.h"

namespace umbrameter {
namespace {

constexpr int primary_tile_size = 32;

// Metres from the near plane to the far plane along a ray.
double reach(const View& view, const dvec3& direction) {
  const auto [near_plane, far_plane] =
      std::visit([](const auto& projection) { return std::pair(projection.near_plane, projection.far_plane); },
                 view.camera.projection);
  if (std::isinf(far_plane)) return far_plane;
  const dvec3 axis = -glm::normalize(dvec3(view.camera.world_from_camera[2]));
  return (far_plane - near_plane) / glm::dot(axis, direction);
}

NearestHit first_hit(const Tracer::State& state, const Ray& ray, double reach) {
  RayQuery query;
  prepare(query, state, true);
  query.primary_direction = ray.direction;
  const double finite = std::min(reach, static_cast<double>(std::numeric_limits<float>::max()));
  return nearest_hit(query, vec3(ray.origin), vec3(ray.direction), static_cast<float>(finite));
}

// The barycentric coordinates of the hit for the second and third corner, in double precision, and clamped to the
// triangle because Embree's own test rounds. (Moeller and Trumbore, JGT 2(1), 1997.)
dvec2 weights_at(const Triangle& t, const Ray& ray) {
  const dvec3 ab = t.b - t.a;
  const dvec3 ac = t.c - t.a;
  const dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return dvec2(1.0 / 3.0);
  const dvec3 offset = ray.origin - t.a;
  const dvec3 q = glm::cross(offset, ab);
  const dvec2 weight = glm::max(dvec2(glm::dot(offset, p), glm::dot(ray.direction, q)) / determinant, dvec2(0.0));
  return weight / std::max(1.0, weight.x + weight.y);
}

template <class Attribute>
auto interpolate(const std::vector<Attribute>& values, const uvec3& vertices, const dvec2& weight) {
  using Exact = glm::vec<Attribute::length(), double>;
  return (1.0 - weight.x - weight.y) * Exact(values[vertices.x]) + weight.x * Exact(values[vertices.y]) +
         weight.y * Exact(values[vertices.z]);
}

void write_surfel(GBuffer& gbuffer, std::size_t i, const Scene& scene, const View& view, const PrimaryHit& hit) {
  const Instance& placed = scene.instances[hit.instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const uvec3 vertices = mesh.triangles[hit.triangle];
  const dvec2& weight = hit.weight;
  const dvec3& position = hit.position;
  const dvec3& normal = hit.normal;
  dvec3 smooth = normal;
  if (!mesh.normals.empty()) {
    // Normals transform by the inverse transpose.
    const dvec3 turned =
        glm::transpose(glm::inverse(dmat3(placed.world_from_mesh))) * interpolate(mesh.normals, vertices, weight);
    const double length = glm::length(turned);
    if (length > 0.0) smooth = turned / length;
    if (glm::dot(smooth, normal) < 0.0) smooth = -smooth;
  }
  gbuffer.instance[i] = hit.instance;
  gbuffer.triangle[i] = hit.triangle;
  gbuffer.position[i] = vec3(position);
  gbuffer.geometric_normal[i] = vec3(normal);
  gbuffer.shading_normal[i] = vec3(smooth);
  const vec2 texcoord = mesh.texcoords.empty() ? vec2(0) : vec2(interpolate(mesh.texcoords, vertices, weight));
  const SurfaceMaterial material = surface_material_at(scene, scene.materials[mesh.material], texcoord);
  gbuffer.albedo[i] = material.base_color;
  gbuffer.metallic[i] = material.metallic;
  gbuffer.specular[i] = vec4(material.specular, material.roughness);
  gbuffer.depth[i] = static_cast<float>(-(view_from_world(view) * dvec4(position, 1.0)).z);
}

}  // namespace

PrimaryHit trace_primary(const Tracer& tracer, const View& view, const Ray& ray) {
  const NearestHit nearest = first_hit(tracer.state(), ray, reach(view, ray.direction));
  PrimaryHit hit;
  if (nearest.instance == no_id) return hit;
  hit.instance = nearest.instance;
  hit.triangle = nearest.triangle;
  const Triangle triangle = world_triangle(tracer.scene(), hit.instance, hit.triangle);
  hit.weight = weights_at(triangle, ray);
  hit.position = triangle.a + hit.weight.x * (triangle.b - triangle.a) + hit.weight.y * (triangle.c - triangle.a);
  const dvec3 viewer = to_viewer(view, hit.position);
  const dvec3 across = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
  hit.normal = glm::length(across) > 0.0 ? glm::normalize(across) : viewer;
  if (glm::dot(hit.normal, viewer) < 0.0) hit.normal = -hit.normal;
  return hit;
}

GBuffer trace_gbuffer(const Tracer& tracer, const View& view, const Progress& progress) {
  GBuffer gbuffer(view.width, view.height);
  parallel_tiles(
      view.width, view.height, primary_tile_size,
      [&](const Tile& tile) {
        for (int y = tile.y_begin; y < tile.y_end; ++y) {
          for (int x = tile.x_begin; x < tile.x_end; ++x) {
            const PrimaryHit hit = trace_primary(tracer, view, pixel_ray(view, x, y));
            if (hit.instance == no_id) continue;
            write_surfel(gbuffer, gbuffer.instance.index(x, y), tracer.scene(), view, hit);
          }
        }
      },
      progress);
  return gbuffer;
}

}  // namespace umbrameter
