// The GLM types that the toolkit uses, under short names.
// Clip-space depth runs from 0 to 1: the build sets GLM_FORCE_DEPTH_ZERO_TO_ONE on this target for everyone.
#pragma once

#include <glm/glm.hpp>

namespace umbrameter {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr double pi = 3.14159265358979323846;

}  // namespace umbrameter
