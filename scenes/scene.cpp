#include "scenes/scene.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace umbrameter {
namespace {

// Whether no point of the transformed box can widen the bounds. With c and h the box's centre and half extent, its
// image lies within |M|·h about M·c + t (Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990). These
// sums of at most eight terms, and a vertex's own of four, round by less than 16 units of 2^-53 of the magnitudes.
bool is_inside(const Bounds& bounds, const Bounds& box, const dmat4& world_from_mesh) {
  const dvec3 c = box.center();
  const dvec3 h = 0.5 * box.extent();
  for (int row = 0; row < 3; ++row) {
    double middle = world_from_mesh[3][row];
    double reach = 0.0;
    double magnitude = std::abs(middle);
    for (int column = 0; column < 3; ++column) {
      const double m = world_from_mesh[column][row];
      middle += m * c[column];
      reach += std::abs(m) * h[column];
      magnitude += std::abs(m) * (std::abs(c[column]) + h[column]);
    }
    reach += 16.0 * 0x1p-53 * magnitude;
    if (!(middle - reach >= bounds.min[row] && middle + reach <= bounds.max[row])) return false;
  }
  return true;
}

// Of each mesh, in its own space; empty without triangles.
std::vector<Bounds> mesh_boxes(const Scene& scene) {
  std::vector<Bounds> boxes(scene.meshes.size());
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    if (scene.meshes[m].triangles.empty()) return;
    for (const vec3& position : scene.meshes[m].positions) boxes[m].include(dvec3(position));
  });
  return boxes;
}

}  // namespace

SceneCounts count(const Scene& scene) {
  SceneCounts counts;
  for (const Mesh& mesh : scene.meshes) {
    counts.stored_triangles += mesh.triangles.size();
    counts.vertices += mesh.positions.size();
  }
  for (const Instance& instance : scene.instances) counts.triangles += scene.meshes[instance.mesh].triangles.size();
  return counts;
}

Bounds bounds_of(const Scene& scene) {
  const std::vector<Bounds> boxes = mesh_boxes(scene);
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    const Bounds& box = boxes[instance.mesh];
    if (scene.ground && &instance == &scene.instances[*scene.ground]) continue;
    if (box.empty() || is_inside(bounds, box, instance.world_from_mesh)) continue;
    for (const vec3& position : scene.meshes[instance.mesh].positions) {
      bounds.include(dvec3(instance.world_from_mesh * dvec4(dvec3(position), 1.0)));
    }
  }
  return bounds;
}

std::vector<Bounds> boxes_of(const Scene& scene) {
  const std::vector<Bounds> meshes = mesh_boxes(scene);
  std::vector<Bounds> boxes(scene.instances.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Bounds& mesh = meshes[instance.mesh];
    if (mesh.empty()) continue;
    for (int c = 0; c < 8; ++c) boxes[i].include(dvec3(instance.world_from_mesh * dvec4(mesh.corner(c), 1.0)));
  }
  return boxes;
}

Triangle world_triangle(const Scene& scene, std::uint32_t instance, std::uint32_t triangle) {
  const Instance& placed = scene.instances[instance];
  const Mesh& mesh = scene.meshes[placed.mesh];
  const uvec3 corners = mesh.triangles[triangle];
  const auto world = [&](std::uint32_t corner) {
    return dvec3(placed.world_from_mesh * dvec4(dvec3(mesh.positions[corner]), 1.0));
  };
  return {world(corners.x), world(corners.y), world(corners.z)};
}

void scale(Scene& scene, double factor) {
  const auto scale_place = [&](dmat4& place) {
    for (int row = 0; row < 3; ++row) place[3][row] *= factor;
  };
  for (Instance& instance : scene.instances) {
    for (int column = 0; column < 3; ++column) instance.world_from_mesh[column] *= factor;
    scale_place(instance.world_from_mesh);
  }
  for (Camera& camera : scene.cameras) {
    scale_place(camera.world_from_camera);
    if (auto* lens = std::get_if<PerspectiveProjection>(&camera.projection)) {
      lens->near_plane *= factor;
      lens->far_plane *= factor;
    } else {
      auto& parallel = std::get<OrthographicProjection>(camera.projection);
      for (double* length : {&parallel.half_width, &parallel.half_height, &parallel.near_plane, &parallel.far_plane}) {
        *length *= factor;
      }
    }
  }
  for (Light& light : scene.lights) {
    scale_place(light.world_from_light);
    if (auto* spot = std::get_if<SpotLight>(&light.shape)) spot->range *= factor;
    if (auto* point = std::get_if<PointLight>(&light.shape)) point->range *= factor;
    if (auto* sphere = std::get_if<SphereEmitter>(&light.emitter)) sphere->radius *= factor;
    if (auto* disk = std::get_if<DiskEmitter>(&light.emitter)) disk->radius *= factor;
    if (auto* rectangle = std::get_if<RectangleEmitter>(&light.emitter)) {
      rectangle->width *= factor;
      rectangle->height *= factor;
    }
  }
  scene.origin *= factor;
}

bool is_mirrored(const dmat4& transform) { return glm::determinant(dmat3(transform)) < 0.0; }

// With A = MᵀM, whose largest eigenvalue λ is the square sought: λ^n ≤ tr A^n ≤ 3 λ^n, since the trace of a power is
// the sum of the eigenvalues' powers and none is negative. So (tr A^n)^(1/2n) is an upper bound, too large by 3^(1/2n)
// at most: 1.3e-7 for n = 2^22. A^n comes from 22 squarings, each divided by its trace, so that nothing overflows:
// tr A^n = t_0^n · t_1^(n/2) · t_2^(n/4) · …  Rounding in squaring i enters the result by its 2^-i-th power: all of it
// together stays below 1e-14.
double largest_stretch(const dmat4& transform) {
  const dmat3 linear(transform);
  double scale = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) scale = std::max(scale, std::abs(linear[column][row]));
  }
  if (!(scale > 0.0) || !std::isfinite(scale)) return scale;
  dmat3 power = glm::transpose(linear / scale) * (linear / scale);
  double bound = 1.0;
  double share = 0.5;
  for (int i = 0; i <= 22; ++i, share *= 0.5) {
    const double trace = power[0][0] + power[1][1] + power[2][2];
    bound *= std::pow(trace, share);
    power /= trace;
    power = power * power;
  }
  return scale * bound * (1.0 + 1e-14);
}

}  // namespace umbrameter
