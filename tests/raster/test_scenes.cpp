#include "test_scenes.h"

#include <cmath>

namespace umbrameter::testing_scenes {

std::uint32_t add_mesh(Scene& scene, Mesh mesh, const dmat4& world_from_mesh) {
  mesh.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({});
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()),
                             static_cast<std::uint32_t>(scene.objects.size()), world_from_mesh});
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({"object " + std::to_string(scene.objects.size())});
  return static_cast<std::uint32_t>(scene.instances.size() - 1);
}

Mesh quad(vec3 a, vec3 b, vec3 c, vec3 d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh box(vec3 min, vec3 max) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) != 0 ? max.x : min.x, (i & 2) != 0 ? max.y : min.y,
                                (i & 4) != 0 ? max.z : min.z);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

Mesh ground(float radius, float height) {
  // The inscribed circle of an equilateral triangle has half the radius of its corners.
  const float r = 2.0f * radius;
  const float half_side = r * 0.8660254f;
  Mesh mesh;
  mesh.positions = {{0, height, r}, {half_side, height, -0.5f * r}, {-half_side, height, -0.5f * r}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

dmat4 look_at(const dvec3& eye, const dvec3& target, const dvec3& up) {
  const dvec3 z = glm::normalize(eye - target);
  const dvec3 x = glm::normalize(glm::cross(up, z));
  return {dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(eye, 1)};
}

View perspective_view(int width, int height, const dvec3& eye, const dvec3& target, double vertical_fov) {
  View view{width, height, {}};
  view.camera.world_from_camera = look_at(eye, target);
  view.camera.projection = PerspectiveProjection{vertical_fov};
  return view;
}

View orthographic_view(int width, int height, const dvec3& eye, const dvec3& target, double half_height,
                       const dvec3& up) {
  View view{width, height, {}};
  view.camera.world_from_camera = look_at(eye, target, up);
  view.camera.projection = OrthographicProjection{half_height * width / height, half_height, 0.0, 100.0};
  return view;
}

Light directional_light(const dvec3& towards_light) {
  Light light;
  const dvec3 up = std::abs(glm::normalize(towards_light).y) > 0.99 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  light.world_from_light = look_at(towards_light, dvec3(0), up);
  return light;
}

Light spot_light(const dvec3& position, const dvec3& target, double outer_cone_angle) {
  Light light;
  light.world_from_light = look_at(position, target, dvec3(0.1, 1, 0.2));
  light.shape = SpotLight{0.0, 0.0, outer_cone_angle};
  return light;
}

Light point_light(const dvec3& position) {
  Light light;
  light.world_from_light = look_at(position, position + dvec3(0.3, -0.4, 0.5));
  light.shape = PointLight{};
  return light;
}

MapLayout exact_layout(const dvec3& towards_light, int resolution, double texel, double azimuth) {
  const dvec3 z = glm::normalize(towards_light);
  const dvec3 slope = glm::normalize(dvec3(0, 1, 0) - z * z.y);
  const dvec3 across = glm::cross(z, slope);
  const dvec3 x = std::cos(azimuth) * slope + std::sin(azimuth) * across;
  MapLayout layout;
  layout.resolution = resolution;
  layout.views.front().half_extent = 0.5 * texel * resolution;
  layout.far_depth = 100.0;
  layout.light_from_world =
      glm::inverse(dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(50.0 * z, 1)));
  return layout;
}

Light light_of(const MapLayout& layout) {
  Light light;
  light.world_from_light = glm::inverse(layout.light_from_world);
  return light;
}

GBuffer surfels_on_ground(int width, int height, double min_x, double max_x, double min_z, double max_z) {
  const double plastic = 1.32471795724474602596;
  GBuffer gbuffer(width, height);
  for (std::size_t i = 0; i < gbuffer.position.size(); ++i) {
    const double u = std::fmod(0.5 + static_cast<double>(i) / plastic, 1.0);
    const double v = std::fmod(0.5 + static_cast<double>(i) / (plastic * plastic), 1.0);
    gbuffer.instance[i] = 0;
    gbuffer.triangle[i] = 0;
    gbuffer.position[i] = vec3(min_x + u * (max_x - min_x), 0.0, min_z + v * (max_z - min_z));
    gbuffer.geometric_normal[i] = vec3(0, 1, 0);
    gbuffer.shading_normal[i] = vec3(0, 1, 0);
  }
  return gbuffer;
}

double mean(const Image<float>& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.size());
}

vec4 shares(const WrongTaps& wrong, std::size_t pixel) {
  return vec4(wrong.weights[pixel]) / static_cast<float>(wrong.weight_sum);
}

vec4 mean(const WrongTaps& wrong) {
  glm::dvec4 sum(0.0);
  for (std::size_t i = 0; i < wrong.weights.size(); ++i) sum += glm::dvec4(wrong.weights[i]);
  return vec4(sum / (static_cast<double>(wrong.weights.size()) * wrong.weight_sum));
}

}  // namespace umbrameter::testing_scenes
