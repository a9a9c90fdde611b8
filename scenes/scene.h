// The scene as both sides see it: meshes, instances, materials, cameras, lights. Plain data.
// Right-handed, Y up, metres (glTF 2.0, section 3.4).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/bounds.h"
#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

enum class Wrap : int { repeat, mirrored_repeat, clamp_to_edge };

/// 8-bit RGBA texels as stored in the file; row 0 is v = 0. What reads them knows whether they are sRGB: the RGB of
/// base colours and specular colours is, everything else is linear.
struct Texture {
  std::string name;
  Image<glm::u8vec4> texels;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
};

enum class AlphaMode : int { opaque, mask, blend };

/// Reflectance at normal incidence of a dielectric of index 1.5 (glTF 2.0, appendix B.2.2).
inline constexpr float dielectric_f0 = 0.04f;

struct Material {
  std::string name;
  vec4 base_color{1.0f};  ///< linear factor; w is alpha
  std::optional<std::uint32_t> base_color_texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;  ///< mask: a point exists where alpha ≥ cutoff
  bool double_sided = false;  ///< false: the camera does not see back faces; shadows and AO do
  float metallic = 0.0f;      ///< 0 to 1
  float roughness = 1.0f;     ///< perceptual, 0 to 1
  float specular = 1.0f;      ///< KHR_materials_specular: strength of the dielectric reflection
  vec3 specular_color{1.0f};  ///< the same: linear tint of it; times dielectric_f0 this is F0
  float transmission = 0.0f;  ///< KHR_materials_transmission: share of light that passes through, 0 to 1
  /// Textures multiply the factors. The loader sets these three only where LoadOptions::materials asks for them.
  std::optional<std::uint32_t> metallic_roughness_texture{};  ///< linear: roughness in G, metallic in B
  std::optional<std::uint32_t> specular_texture{};            ///< linear: strength in A
  std::optional<std::uint32_t> specular_color_texture{};      ///< sRGB: tint in RGB
};

/// One glTF primitive: indexed triangles of one material, in the mesh's own space.
struct Mesh {
  std::string name;
  std::vector<vec3> positions;
  std::vector<vec3> normals;     ///< one a vertex, unit; empty: use the triangle's
  std::vector<vec2> texcoords;   ///< one a vertex, or empty
  std::vector<uvec3> triangles;  ///< counter-clockwise seen from the front
  std::uint32_t material = 0;
};

/// A mesh placed in the world. Shared meshes are stored once.
struct Instance {
  std::uint32_t mesh = 0;
  std::uint32_t object = 0;  ///< index into Scene::objects
  dmat4 world_from_mesh{1.0};
};

/// A glTF node that holds a mesh: what a user calls an object.
struct Object {
  std::string name;
};

struct PerspectiveProjection {
  double vertical_fov = 0.8;  ///< radians
  double near_plane = 0.01;   ///< metres
  double far_plane = std::numeric_limits<double>::infinity();
};
struct OrthographicProjection {
  double half_width = 1.0;   ///< metres; the image's own aspect ratio adjusts this one
  double half_height = 1.0;  ///< metres
  double near_plane = 0.0;
  double far_plane = 100.0;
};

/// Looks along its own −Z, +Y up (glTF 2.0, section 3.10).
struct Camera {
  std::string name;
  dmat4 world_from_camera{1.0};  ///< rigid: node scale removed
  std::variant<PerspectiveProjection, OrthographicProjection> projection;
};

struct DirectionalLight {};
struct PointLight {
  double range = 0.0;  ///< metres; 0 is unlimited
};
struct SpotLight {
  double range = 0.0;             ///< metres; 0 is unlimited
  double inner_cone_angle = 0.0;  ///< radians from the axis
  double outer_cone_angle = pi / 4;
};

/// How large a light is, which is what gives its shadows a penumbra. Sizes are in the world: no node scales them.
struct SphereEmitter {
  double radius = 0.0;  ///< metres, about the light's position
};
struct DiskEmitter {
  double radius = 0.0;  ///< metres, about the light's position, across its axis
};
struct RectangleEmitter {
  double width = 0.0;   ///< metres, along the light's own x, its position in the middle
  double height = 0.0;  ///< metres, along its own y
};
/// A disk at infinity about the axis, like the sun; for directional lights alone.
struct DistantEmitter {
  double angular_diameter = 0.0;  ///< radians, less than π
};
/// Empty for a light without extent, whose shadows are hard. Sizes are above 0.
using Emitter = std::variant<std::monostate, SphereEmitter, DiskEmitter, RectangleEmitter, DistantEmitter>;

/// KHR_lights_punctual: shines along its own −Z; its +Y fixes the roll of its shadow map.
struct Light {
  std::string name;             ///< empty when the file gives none
  dmat4 world_from_light{1.0};  ///< rigid
  vec3 color{1.0f};             ///< linear
  double intensity = 1.0;       ///< directional: lux; point and spot: candela
  std::variant<DirectionalLight, SpotLight, PointLight> shape;
  Emitter emitter{};

  dvec3 position() const { return dvec3(world_from_light[3]); }
  /// Unit, the way that the light travels along its axis.
  dvec3 axis() const { return -glm::normalize(dvec3(world_from_light[2])); }
};

struct Scene {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Instance> instances;
  std::optional<std::uint32_t> ground{};  ///< instance that scene.ground added (ground.h), the last one
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  dvec3 origin{0.0};               ///< of this scene, metres, in the coordinates of its file; move_to_centre() sets it
  std::vector<std::string> notes;  ///< what was assumed or dropped on loading, one line each
};

struct SceneCounts {
  std::uint64_t triangles = 0;         ///< over all instances
  std::uint64_t stored_triangles = 0;  ///< over all meshes
  std::uint64_t vertices = 0;          ///< over all meshes
};

SceneCounts count(const Scene& scene);

/// World bounds of all instances but the ground, from every vertex: the size of the scene. Empty for a scene without
/// triangles.
Bounds bounds_of(const Scene& scene);

/// World box around the mesh's own box of each instance, as engines cull by; empty where the mesh has no triangles.
std::vector<Bounds> boxes_of(const Scene& scene);

/// The three world-space corners of a triangle, transformed in double precision.
struct Triangle {
  dvec3 a, b, c;
};
Triangle world_triangle(const Scene& scene, std::uint32_t instance, std::uint32_t triangle);

/// Multiplies every length in the scene: places, clipping planes and image sizes of cameras, ranges and extents of
/// lights. Intensities stay as they are.
void scale(Scene& scene, double factor);

/// True when the transform mirrors: front faces then turn clockwise.
bool is_mirrored(const dmat4& transform);

/// Upper bound on the factor by which the transform lengthens any difference of two points, at most 1e-6 above the
/// least: its largest singular value.
double largest_stretch(const dmat4& transform);

}  // namespace umbrameter
