// Frames of another renderer for the stages of a run: where its surfaces lie, and what its shadows and its ambient
// occlusion multiply. They come from an engine that runs, or from files that one wrote.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/frame_alignment.h"
#include "experiments/engine/engine.h"

namespace umbrameter {

/// One view of the scene under one light.
struct FramedView {
  const Scene& scene;
  const std::string& content;  ///< scene_content() of the scene
  const View& view;
  const Light& light;
};

/// What a shadow or an occlusion multiplies: 0 to 1; NaN where the frame shows nothing.
struct FrameShare {
  Image<float> image;
  double milliseconds = 0.0;  ///< that the frame took; 0: unknown
};

struct FrameSource {
  std::string title;  ///< "three.js 0.187.0"
  bool has_shadows = false;
  bool has_ao = false;
  /// Where its surfaces lie; nothing if it does not say.
  std::function<std::optional<FrameSurfaces>(const FramedView&)> surfaces;
  /// For each set of parameters an image of the view's size.
  std::function<std::vector<FrameShare>(const FramedView&, std::span<const EngineParams>)> visibility;
  std::function<std::vector<FrameShare>(const FramedView&, std::span<const EngineParams>)> ao;
  /// The pixels that the light does not reach even without shadows: they tell nothing of shadows. Empty if the source
  /// has no frame without shadows.
  std::function<Image<std::uint8_t>(const FramedView&)> unlit = [](const FramedView&) { return Image<std::uint8_t>(); };
  std::function<std::vector<std::string>()> take_warnings = [] { return std::vector<std::string>(); };
};

/// Frames of one request: each request costs a round trip, and what is interrupted in it is lost.
inline constexpr std::size_t most_frames_at_once = 8;

FrameSource frames_of(std::shared_ptr<Engine> engine);

/// Whether an engine shows its shadows, and whether its ambient occlusion.
bool shows_shadows(const EngineDescription& engine);
bool shows_ao(const EngineDescription& engine);

/// The quotient of two frames by luminance, 0 to 1: what a shadow or an occlusion has multiplied. 1 where the divisor
/// has no light to take away.
Image<float> ratio_of(const Image<vec3>& with, const Image<vec3>& without);

/// 1 where the frame without shadows has no light.
Image<std::uint8_t> unlit_of(const Image<vec3>& without);

/// The first channel, between 0 and 1. Throws Error (unreadable_input) naming `what` if more than rounding lies
/// outside.
Image<float> share_of(const Image<vec3>& image, const std::string& what);

}  // namespace umbrameter
