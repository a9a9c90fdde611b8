// What each pixel centre sees: the surfels for which the rasteriser and the ray tracer both answer.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// Id of a pixel, tap or ray that meets no surface.
inline constexpr std::uint32_t no_id = 0xffffffffu;

/// One image a quantity, all of one size. Values of background pixels (instance == no_id) are zero.
struct GBuffer {
  int width = 0;
  int height = 0;
  Image<std::uint32_t> instance;  ///< index into Scene::instances; no_id on background
  Image<std::uint32_t> triangle;  ///< index of the triangle in the instance's mesh; no_id on background
  Image<vec3> position;           ///< world position, metres
  Image<vec3> geometric_normal;   ///< unit, world, of the triangle, turned to the viewer
  Image<vec3> shading_normal;     ///< unit, world, interpolated, on the viewer's side of the triangle
  Image<vec3> albedo;             ///< base colour, linear, 0 to 1
  Image<float> metallic;          ///< 0 to 1
  Image<vec4> specular;           ///< linear reflectance at normal incidence, perceptual roughness; 0 to 1
  Image<float> depth;             ///< distance along the camera's axis, metres

  GBuffer() = default;
  GBuffer(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        instance(image_width, image_height, no_id),
        triangle(image_width, image_height, no_id),
        position(image_width, image_height, vec3(0)),
        geometric_normal(image_width, image_height, vec3(0)),
        shading_normal(image_width, image_height, vec3(0)),
        albedo(image_width, image_height, vec3(0)),
        metallic(image_width, image_height, 0.0f),
        specular(image_width, image_height, vec4(0)),
        depth(image_width, image_height, 0.0f) {}

  bool is_surface(std::size_t i) const { return instance[i] != no_id; }

  friend bool operator==(const GBuffer&, const GBuffer&) = default;
};

}  // namespace umbrameter
