#include "experiments/stages/reference_key.h"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "core/content_hash.h"
#include "raytrace/tracer.h"

// Structured bindings name every member of a struct, so a new member does not compile until it is added to the key or
// left out here.

namespace umbrameter {
namespace {

void add_texture(ContentHash& hash, const Texture& texture) {
  const auto& [name, texels, wrap_u, wrap_v] = texture;
  hash.add(texels.width).add(texels.height).add(texels.pixels).add(wrap_u).add(wrap_v);
}

// Only where alpha can make holes.
void add_material(ContentHash& hash, const Scene& scene, const Material& material) {
  const auto& [name, base_color, base_color_texture, alpha_mode, alpha_cutoff, double_sided, metallic, roughness,
               specular, specular_color, transmission, metallic_roughness_texture, specular_texture,
               specular_color_texture] = material;
  const bool masked = alpha_mode == AlphaMode::mask;
  hash.add(masked);
  if (!masked) return;
  hash.add(alpha_cutoff).add(base_color.w).add(base_color_texture.has_value());
  if (base_color_texture) add_texture(hash, scene.textures[*base_color_texture]);
}

void add_mesh(ContentHash& hash, const Scene& scene, const Mesh& mesh) {
  const auto& [name, positions, normals, texcoords, triangles, material] = mesh;
  hash.add(positions).add(triangles);
  add_material(hash, scene, scene.materials[material]);
  if (scene.materials[material].alpha_mode == AlphaMode::mask) hash.add(texcoords);
}

void add_instance(ContentHash& hash, const Instance& instance) {
  const auto& [mesh, object, world_from_mesh] = instance;
  hash.add(mesh).add(world_from_mesh);
}

void add_shape(ContentHash&, const DirectionalLight&) {}
// Ranges and cones are not applied to visibility.
void add_shape(ContentHash&, const SpotLight& spot) {
  [[maybe_unused]] const auto& [range, inner_cone_angle, outer_cone_angle] = spot;
}
void add_shape(ContentHash&, const PointLight& point) { [[maybe_unused]] const auto& [range] = point; }

void add_extent(ContentHash&, const std::monostate&) {}
void add_extent(ContentHash& hash, const SphereEmitter& sphere) { hash.add(sphere.radius); }
void add_extent(ContentHash& hash, const DiskEmitter& disk) { hash.add(disk.radius); }
void add_extent(ContentHash& hash, const RectangleEmitter& rectangle) {
  const auto& [width, height] = rectangle;
  hash.add(width).add(height);
}
void add_extent(ContentHash& hash, const DistantEmitter& sun) { hash.add(sun.angular_diameter); }

void add_projection(ContentHash& hash, const PerspectiveProjection& perspective) {
  const auto& [vertical_fov, near_plane, far_plane] = perspective;
  hash.add(vertical_fov).add(near_plane).add(far_plane);
}
void add_projection(ContentHash& hash, const OrthographicProjection& orthographic) {
  const auto& [half_width, half_height, near_plane, far_plane] = orthographic;
  hash.add(half_width).add(half_height).add(near_plane).add(far_plane);
}

std::string content_of_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  ContentHash hash;
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0) {
    hash.add_bytes(std::as_bytes(std::span(block.data(), static_cast<std::size_t>(file.gcount()))));
  }
  return hash.hex();
}

// The line of features: "flags" on x86, "Features" on Arm.
std::string processor_features() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("flags") || line.starts_with("Features")) return ContentHash().add(line).hex();
  }
  return "unknown";
}

}  // namespace

std::string to_text(const ReferenceKey& key) {
  const auto& [kind, tracer, scene, surfels, light, parameters, seed] = key;
  return fmt::format("kind={}\ntracer={}\nscene={}\nsurfels={}\nlight={}\n{}run.seed={}\n", kind, tracer, scene,
                     surfels, light, parameters, seed);
}

std::string scene_content(const Scene& scene) {
  const auto& [name, textures, materials, meshes, objects, instances, ground, cameras, lights, origin, notes] = scene;
  ContentHash hash;
  hash.add(meshes.size());
  for (const Mesh& mesh : meshes) add_mesh(hash, scene, mesh);
  hash.add(instances.size());
  for (const Instance& instance : instances) add_instance(hash, instance);
  return hash.hex();
}

std::string surfel_content(const GBuffer& gbuffer) {
  const auto& [width, height, instance, triangle, position, geometric_normal, shading_normal, albedo, metallic,
               specular, depth] = gbuffer;
  return ContentHash()
      .add(width)
      .add(height)
      .add(instance.pixels)
      .add(triangle.pixels)
      .add(position.pixels)
      .add(geometric_normal.pixels)
      .add(shading_normal.pixels)
      .hex();
}

std::string light_content(const Light& light) {
  const auto& [name, world_from_light, color, intensity, shape, emitter] = light;
  ContentHash hash;
  hash.add(world_from_light).add(shape.index());
  std::visit([&](const auto& form) { add_shape(hash, form); }, shape);
  hash.add(emitter.index());
  std::visit([&](const auto& extent) { add_extent(hash, extent); }, emitter);
  return hash.hex();
}

std::string camera_content(const Camera& camera) {
  const auto& [name, world_from_camera, projection] = camera;
  ContentHash hash;
  hash.add(world_from_camera).add(projection.index());
  std::visit([&](const auto& form) { add_projection(hash, form); }, projection);
  return hash.hex();
}

std::string tracer_identity() {
  return fmt::format("umbrameter {} {} on {}, Embree {}", UMBRAMETER_VERSION, content_of_file("/proc/self/exe"),
                     processor_features(), loaded_embree_version());
}

}  // namespace umbrameter
