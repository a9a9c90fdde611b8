#include "scenes/origin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace umbrameter {
namespace {

double largest(const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// At most four digits, and all of a whole number.
std::string text_of(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string text_of(const dvec3& v) {
  return std::string("(") + text_of(v.x, "%.12g") + ", " + text_of(v.y, "%.12g") + ", " + text_of(v.z, "%.12g") + ")";
}

// The components that are farther than `limit`, as multiples of the power of ten that is at least `step`, so that they
// are easy to read; 0 for the others.
dvec3 far_part(const dvec3& center, double limit, double step) {
  const double unit = std::pow(10.0, std::ceil(std::log10(step)));
  dvec3 part(0.0);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(center[i]) > limit) part[i] = std::round(center[i] / unit) * unit;
  }
  return part;
}

void move(dmat4& place, const dvec3& way) {
  for (int row = 0; row < 3; ++row) place[3][row] += way[row];
}

// The steps in which the coordinates of those meshes were stored, in the world; 0 where none was moved.
double move_meshes(Scene& scene, double radius) {
  const std::vector<double> stretches = stretches_of_meshes(scene);
  std::vector<dvec3> ways(scene.meshes.size(), dvec3(0.0));
  double coarsest = 0.0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const double stretch = stretches[m];
    if (stretch == 0.0 || scene.meshes[m].triangles.empty()) continue;
    const Bounds box = bounds_of(scene.meshes[m]);
    if (box.empty() || stretch * largest(box.center()) <= max_radii_from_origin * radius) continue;
    // Along an axis where the centre is that far away, all vertices are within a factor of two of it: subtracting a
    // single-precision number from another is exact there (Sterbenz, Floating-Point Computation, 1974).
    for (int i = 0; i < 3; ++i) {
      const double center = box.center()[i];
      const bool is_far = std::abs(center) > 4.0 * (box.max[i] - box.min[i]) &&
                          stretch * std::abs(center) > max_radii_from_origin * radius;
      if (is_far) ways[m][i] = static_cast<double>(static_cast<float>(center));
    }
    if (ways[m] == dvec3(0.0)) continue;
    const auto reach = static_cast<float>(std::max(largest(box.min), largest(box.max)));
    const double step =
        static_cast<double>(std::nextafter(reach, std::numeric_limits<float>::infinity())) - static_cast<double>(reach);
    coarsest = std::max(coarsest, step * stretch / std::sqrt(3.0));
    for (vec3& position : scene.meshes[m].positions) position = vec3(dvec3(position) - ways[m]);
  }
  for (Instance& instance : scene.instances) {
    const dvec3& way = ways[instance.mesh];
    if (way != dvec3(0.0)) move(instance.world_from_mesh, dmat3(instance.world_from_mesh) * way);
  }
  return coarsest;
}

}  // namespace

void move_to_centre(Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const double radius = bounds.radius();
  if (bounds.empty() || !(radius > 0.0)) return;
  const dvec3 way = far_part(bounds.center(), max_radii_from_origin * radius, radius);
  if (way != dvec3(0.0)) {
    for (Instance& instance : scene.instances) move(instance.world_from_mesh, -way);
    for (Camera& camera : scene.cameras) move(camera.world_from_camera, -way);
    for (Light& light : scene.lights) move(light.world_from_light, -way);
    scene.origin += way;
    scene.notes.push_back("the scene is " + text_of(glm::length(bounds.center()) / radius, "%.3g") +
                          " times its radius away from its origin, where single precision is too coarse; it was moved: "
                          "positions are relative to " +
                          text_of(way) + " m of the file");
  }
  const double of_vertices = move_meshes(scene, radius);
  const double far = largest(bounds.center());
  const double of_doubles = std::nextafter(far, std::numeric_limits<double>::infinity()) - far;
  const double coarsest = std::max(of_vertices, of_doubles > radius * 0x1p-17 ? of_doubles : 0.0);
  if (coarsest == 0.0) return;
  scene.notes.push_back("the file stores positions in steps of " + text_of(coarsest, "%.1g") +
                        " m, since they are far from the origin: finer detail is lost; move the model to its origin "
                        "before export");
}

}  // namespace umbrameter
