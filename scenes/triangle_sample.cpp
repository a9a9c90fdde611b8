#include "scenes/triangle_sample.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

// Edges longer than this are large, radii.
constexpr double large_edge = 0.1;
// Planes nearer to each other than this count as one, radii.
constexpr double plane_step = 1.0 / 32.0;

// SplitMix64 (Steele et al., Fast Splittable Pseudorandom Number Generators, 2014).
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  std::uint64_t z = hash + 0x9e3779b97f4a7c15u * (value + 1);
  z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31u);
}

std::uint64_t surface_of(const std::array<dvec3, 3>& corners, std::uint32_t object, std::uint32_t material) {
  std::uint64_t hash = mixed(mixed(0, object), material);
  const dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(area);
  if (!(length > 0.0)) return hash;
  // One of the 26 directions to the neighbours in a grid.
  const dvec3 direction = glm::round(1.4 * area / length);
  for (int i = 0; i < 3; ++i)
    hash = mixed(hash, static_cast<std::uint64_t>(static_cast<std::int64_t>(direction[i]) + 2));
  const double offset = glm::dot(area / length, (corners[0] + corners[1] + corners[2]) / 3.0);
  return mixed(hash, static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(offset / plane_step)) + 1024));
}

class Sampler {
 public:
  Sampler(const Scene& scene, TriangleSample& sample) : scene_(scene), sample_(sample), lights_(scene.lights) {
    if (lights_.empty()) lights_.push_back(default_sun());
  }

  void choose_instance(std::uint32_t instance) {
    const Instance& placed = scene_.instances[instance];
    mesh_ = &scene_.meshes[placed.mesh];
    material_ = &scene_.materials[mesh_->material];
    object_ = placed.object;
    is_mirrored_ = is_mirrored(placed.world_from_mesh);
    place_ = placed.world_from_mesh;
  }

  std::array<dvec3, 3> corners(std::size_t triangle) const {
    std::array<dvec3, 3> result = world_corners(*mesh_, mesh_->triangles[triangle], place_);
    for (dvec3& corner : result) corner = (corner - sample_.center()) / sample_.radius();
    return result;
  }

  void add(std::array<dvec3, 3> corners, double weight) {
    const dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    // No triangle becomes so large that its back shows where others hide it.
    const double growth = std::min(std::sqrt(weight), std::max(1.0, large_edge / longest_edge(corners)));
    if (is_mirrored_) std::swap(corners[1], corners[2]);
    SampledTriangle& added = sample_.triangles.emplace_back();
    added.surface = surface_of(corners, object_, mesh_->material);
    for (std::size_t i = 0; i < 3; ++i) added.corners[i] = vec3(middle + growth * (corners[i] - middle));
    added.object = object_;
    added.weight = static_cast<float>(weight);
    added.is_double_sided = material_->double_sided;
    const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    added.front_faces_light = faces_light(middle, normal);
    added.back_faces_light = faces_light(middle, -normal);
  }

 private:
  bool faces_light(const dvec3& middle, const dvec3& normal) const {
    const double length = glm::length(normal);
    const dvec3 place = sample_.center() + sample_.radius() * middle;
    return length > 0.0 &&
           std::ranges::any_of(lights_, [&](const Light& light) { return faces(light, place, normal / length); });
  }

  const Scene& scene_;
  TriangleSample& sample_;
  std::vector<Light> lights_;
  const Mesh* mesh_ = nullptr;
  const Material* material_ = nullptr;
  dmat4 place_{1.0};
  std::uint32_t object_ = 0;
  bool is_mirrored_ = false;
};

// For each mesh the triangles that may be large in one of its instances.
std::vector<std::vector<std::uint32_t>> large_triangles(const Scene& scene, double radius) {
  const std::vector<double> stretch = stretches_of_meshes(scene);
  std::vector<std::vector<std::uint32_t>> large(scene.meshes.size());
  parallel_for(scene.meshes.size(), [&](std::size_t m) {
    const Mesh& mesh = scene.meshes[m];
    if (stretch[m] == 0.0) return;
    // By the diagonal of the triangle's box, which is no shorter than its edges and quick to find.
    const auto limit = static_cast<float>(large_edge * radius / stretch[m]);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const uvec3& v = mesh.triangles[t];
      const vec3& a = mesh.positions[v.x];
      const vec3& b = mesh.positions[v.y];
      const vec3& c = mesh.positions[v.z];
      const vec3 diagonal = glm::max(glm::max(a, b), c) - glm::min(glm::min(a, b), c);
      if (glm::dot(diagonal, diagonal) > limit * limit) large[m].push_back(static_cast<std::uint32_t>(t));
    }
  });
  return large;
}

}  // namespace

TriangleSample sample_triangles(const Scene& scene, std::size_t max_count) {
  TriangleSample sample;
  sample.bounds = bounds_of(scene);
  // Without the ground, the last instance.
  const auto instances = scene.ground.value_or(static_cast<std::uint32_t>(scene.instances.size()));
  std::uint64_t all = 0;
  for (std::uint32_t i = 0; i < instances; ++i) all += scene.meshes[scene.instances[i].mesh].triangles.size();
  Sampler sampler(scene, sample);
  if (all <= max_count) {
    sample.triangles.reserve(all);
    for (std::uint32_t i = 0; i < instances; ++i) {
      sampler.choose_instance(i);
      const std::size_t triangles = scene.meshes[scene.instances[i].mesh].triangles.size();
      for (std::size_t t = 0; t < triangles; ++t) sampler.add(sampler.corners(t), 1.0);
    }
    return sample;
  }
  const std::vector<std::vector<std::uint32_t>> large = large_triangles(scene, sample.radius());
  std::uint64_t all_large = 0;
  for (std::uint32_t i = 0; i < instances; ++i) all_large += large[scene.instances[i].mesh].size();
  const std::uint64_t half = std::max<std::size_t>(1, max_count / 2);
  const std::uint64_t large_step = (all_large + half - 1) / half;
  const std::uint64_t small_step = (all + half - 1) / half;
  std::uint64_t next_large = 0;
  std::uint64_t next_small = 0;
  for (std::uint32_t i = 0; i < instances; ++i) {
    const std::uint32_t mesh = scene.instances[i].mesh;
    const std::uint64_t triangles = scene.meshes[mesh].triangles.size();
    if (next_large >= large[mesh].size() && next_small >= triangles) {
      next_large -= large[mesh].size();
      next_small -= triangles;
      continue;
    }
    sampler.choose_instance(i);
    for (; next_large < large[mesh].size(); next_large += large_step) {
      sampler.add(sampler.corners(large[mesh][next_large]), static_cast<double>(large_step));
    }
    for (; next_small < triangles; next_small += small_step) {
      if (std::binary_search(large[mesh].begin(), large[mesh].end(), static_cast<std::uint32_t>(next_small))) continue;
      sampler.add(sampler.corners(next_small), static_cast<double>(small_step));
    }
    next_large -= large[mesh].size();
    next_small -= triangles;
  }
  return sample;
}

}  // namespace umbrameter
