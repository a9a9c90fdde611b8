// Cameras and lights of a glTF file. Internal to scenes/gltf*.cpp.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "scenes/gltf_nodes.h"

namespace umbrameter::gltf {
namespace {

// Without scale, shear and mirroring; keeps the viewing axis −Z, then the side of +Y. A rigid one stays bit for bit.
dmat4 rigid(const dmat4& transform, const Document& document, const std::string& object) {
  const dmat3 axes(transform);
  const dmat3 gram = glm::transpose(axes) * axes;
  double off = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) off = std::max(off, std::abs(gram[column][row] - (column == row ? 1.0 : 0.0)));
  }
  if (off < 1e-12 && glm::determinant(axes) > 0.0) return transform;
  const dvec3 z = glm::normalize(axes[2]);
  const dvec3 x = glm::normalize(glm::cross(glm::normalize(axes[1]), z));
  const dvec3 y = glm::cross(z, x);
  const double sum = glm::dot(x + y + z, dvec3(1.0));
  if (!std::isfinite(sum)) fail(document.path, object, "its transform leaves no direction", "undo the zero scale");
  return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), transform[3]};
}

}  // namespace

Camera read_camera(const tinygltf::Camera& source, const std::string& node_name, const dmat4& transform,
                   const Document& document, const std::string& object) {
  Camera camera;
  camera.name = source.name.empty() ? node_name : source.name;
  camera.world_from_camera = rigid(transform, document, object);
  if (source.type == "orthographic") {
    const tinygltf::OrthographicCamera& lens = source.orthographic;
    if (!(lens.xmag != 0.0 && lens.ymag != 0.0 && lens.znear >= 0.0 && lens.zfar > lens.znear)) {
      fail(document.path, object, "an orthographic camera needs xmag and ymag, and zfar > znear >= 0");
    }
    camera.projection = OrthographicProjection{std::abs(lens.xmag), std::abs(lens.ymag), lens.znear, lens.zfar};
    return camera;
  }
  const tinygltf::PerspectiveCamera& lens = source.perspective;
  PerspectiveProjection projection{lens.yfov, lens.znear};
  if (lens.zfar != 0.0) projection.far_plane = lens.zfar;
  if (!(lens.yfov > 0.0 && lens.yfov < pi && lens.znear > 0.0 && projection.far_plane > lens.znear)) {
    fail(document.path, object, "a perspective camera needs 0 < yfov < pi, and zfar > znear > 0");
  }
  camera.projection = projection;
  return camera;
}

Light read_light(const tinygltf::Light& source, const dmat4& transform, const Document& document,
                 const std::string& object, std::vector<std::string>& notes) {
  Light light;
  light.name = source.name;
  light.world_from_light = rigid(transform, document, object);
  if (!source.color.empty()) {
    if (source.color.size() < 3) fail(document.path, object, "its color is not three numbers");
    for (int i = 0; i < 3; ++i) light.color[i] = static_cast<float>(source.color[static_cast<std::size_t>(i)]);
  }
  light.intensity = source.intensity;
  const bool bright = light.intensity >= 0.0 && light.color.x >= 0.0f && light.color.y >= 0.0f && light.color.z >= 0.0f;
  if (!bright || !(source.range >= 0.0)) fail(document.path, object, "its color, intensity or range is below zero");
  const double range = std::isfinite(source.range) ? source.range : 0.0;
  if (source.type == "directional") {
    light.shape = DirectionalLight{};
  } else if (source.type == "point") {
    light.shape = PointLight{range};
  } else if (source.type == "spot") {
    SpotLight spot{range, source.spot.innerConeAngle, source.spot.outerConeAngle};
    if (!(spot.outer_cone_angle > 0.0 && spot.outer_cone_angle < 0.5 * pi + 1e-6 && spot.inner_cone_angle >= 0.0)) {
      fail(document.path, object, "a spot light needs 0 <= innerConeAngle < outerConeAngle <= pi/2");
    }
    if (spot.inner_cone_angle > spot.outer_cone_angle) {
      notes.push_back(object + ": its innerConeAngle was lowered to its outerConeAngle");
      spot.inner_cone_angle = spot.outer_cone_angle;
    }
    light.shape = spot;
  } else {
    fail(document.path, object, "unknown light type '" + source.type.substr(0, 60) + "'");
  }
  return light;
}

}  // namespace umbrameter::gltf
