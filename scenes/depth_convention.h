// What other renderers write as depth.
#pragma once

#include <array>
#include <string_view>

namespace umbrameter {

/// What the numbers of a depth image are. d at distance z along the camera's axis, near plane n, far plane f.
/// axis: z. ray: the distance from the eye. linear: (z − n) / (f − n). window: f (z − n) / (z (f − n)), the depth
/// buffer of OpenGL, Direct3D and Vulkan. reversed: 1 − window. reversed_infinite: n / z. Of an orthographic camera,
/// window is linear and reversed 1 − linear.
enum class DepthConvention : int { axis, ray, linear, window, reversed, reversed_infinite };
inline constexpr std::array<std::string_view, 6> depth_conventions = {"axis",   "ray",      "linear",
                                                                      "window", "reversed", "reversed-infinite"};

}  // namespace umbrameter
