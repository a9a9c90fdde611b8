// The surface that one primary ray meets. For raytrace/*.cpp alone: others call trace_gbuffer().
#pragma once

#include "raytrace/tracer.h"
#include "scenes/view.h"

namespace umbrameter {

struct PrimaryHit {
  std::uint32_t instance = no_id;  ///< no_id where nothing is hit; the other members are then undefined
  std::uint32_t triangle = no_id;
  dvec2 weight{0.0};    ///< barycentric coordinates for the second and third corner
  dvec3 position{0.0};  ///< world, metres, on the exact triangle
  dvec3 normal{0.0};    ///< unit, of the triangle, turned to the viewer
};

/// Without back faces of single-sided materials.
PrimaryHit trace_primary(const Tracer& tracer, const View& view, const Ray& ray);

}  // namespace umbrameter
