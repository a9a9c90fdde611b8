// The screen that AO methods read, on the CPU. A method's struct includes its shared text, so that the processor
// computes what the shader computes.
#pragma once

#include "core/image.h"
#include "core/math.h"

namespace umbrameter::shared {

using glm::abs;
using glm::acos;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::fract;
using glm::length;
using glm::log;
using glm::max;
using glm::min;
using glm::normalize;
using glm::pow;
using glm::sin;
using glm::sqrt;

/// What the camera sees. `depth` has the top row first.
struct AoScreen {
  mat4 clip_from_view{1.0f};
  ivec2 size{0};
  int is_orthographic = 0;
  Image<float> depth;

  float depth_at(ivec2 pixel) const { return depth.at(pixel.x, size.y - 1 - pixel.y); }

#include "techniques/ao/screen.glsl"
};

}  // namespace umbrameter::shared
