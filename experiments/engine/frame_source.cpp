#include "experiments/engine/frame_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/error.h"

namespace umbrameter {
namespace {

/// Frames of one request: one after the other would start each alone, all at once would show no progress.
constexpr std::size_t most_at_once = 8;

double luminance_of(const vec3& color) { return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z; }

// One image a set of parameters, of one output or of the quotient of two.
std::vector<Image<float>> shares(Engine& engine, std::span<const EngineParams> params, const std::string& output,
                                 const std::vector<std::string>& pair) {
  const bool is_direct = engine.description().writes(output);
  std::vector<Image<float>> images;
  for (std::size_t first = 0; first < params.size(); first += most_at_once) {
    const auto some = params.subspan(first, std::min(most_at_once, params.size() - first));
    for (const EngineFrame& frame : engine.render(is_direct ? std::vector{output} : pair, some)) {
      images.push_back(is_direct ? share_of(frame.images[0], output) : ratio_of(frame.images[0], frame.images[1]));
    }
  }
  return images;
}

}  // namespace

FrameSource frames_of(std::shared_ptr<Engine> engine) {
  const EngineDescription& described = engine->description();
  FrameSource source;
  source.title = described.title();
  source.has_shadows = described.writes("visibility") || described.writes("lit");
  source.has_ao = described.writes("ao") || described.writes("occluded");
  const auto at = [engine](const FramedView& framed) -> Engine& {
    engine->load(framed.scene, framed.content, framed.view, framed.light);
    return *engine;
  };
  source.surfaces = [at](const FramedView& framed) -> std::optional<FrameSurfaces> {
    Engine& loaded = at(framed);
    const EngineDescription& can = loaded.description();
    const std::string output = can.writes("position") ? "position" : "depth";
    if (!can.writes(output)) return std::nullopt;
    const EngineParams params = loaded.parameters();
    EngineFrame frame = loaded.render({output}, {&params, 1}).front();
    FrameSurfaces surfaces;
    if (output == "position") {
      surfaces.position = std::move(frame.images.front());
      return surfaces;
    }
    surfaces.convention = can.depth;
    surfaces.depth = Image<float>(framed.view.width, framed.view.height, 0.0f);
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i) surfaces.depth[i] = frame.images.front()[i].x;
    return surfaces;
  };
  source.visibility = [at](const FramedView& framed, std::span<const EngineParams> params) {
    return shares(at(framed), params, "visibility", {"lit", "unshadowed"});
  };
  source.ao = [at](const FramedView& framed, std::span<const EngineParams> params) {
    return shares(at(framed), params, "ao", {"occluded", "open"});
  };
  source.take_warnings = [engine] { return engine->take_warnings(); };
  return source;
}

Image<float> ratio_of(const Image<vec3>& with, const Image<vec3>& without) {
  Image<float> ratio(with.width, with.height, 1.0f);
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    const double all = luminance_of(without[i]);
    if (std::isnan(all) || std::isnan(luminance_of(with[i]))) {
      ratio[i] = std::numeric_limits<float>::quiet_NaN();
    } else if (all > 0.0) {
      ratio[i] = static_cast<float>(std::clamp(luminance_of(with[i]) / all, 0.0, 1.0));
    }
  }
  return ratio;
}

Image<float> share_of(const Image<vec3>& image, const std::string& what) {
  constexpr float rounding = 1e-3f;
  Image<float> share(image.width, image.height, 0.0f);
  for (std::size_t i = 0; i < share.size(); ++i) {
    const float value = image[i].x;
    if (value < -rounding || value > 1.0f + rounding) {
      throw Error(ExitCode::unreadable_input, what,
                  fmt::format("its value {:.4g} at pixel ({}, {}) is no share of light, 0 to 1", value,
                              i % static_cast<std::size_t>(image.width), i / static_cast<std::size_t>(image.width)),
                  "write what the shadow or the occlusion multiplies, linear");
    }
    share[i] = std::isnan(value) ? value : std::clamp(value, 0.0f, 1.0f);
  }
  return share;
}

}  // namespace umbrameter
