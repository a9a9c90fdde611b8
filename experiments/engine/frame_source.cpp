#include "experiments/engine/frame_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_space.h"
#include "core/error.h"

namespace umbrameter {
namespace {

// One image a set of parameters, of one output or of the quotient of two.
std::vector<FrameShare> shares(Engine& engine, std::span<const EngineParams> params, const std::string& output,
                               const std::vector<std::string>& pair) {
  const bool is_direct = engine.description().writes(output);
  std::vector<FrameShare> images;
  for (std::size_t first = 0; first < params.size(); first += most_frames_at_once) {
    const auto some = params.subspan(first, std::min(most_frames_at_once, params.size() - first));
    for (const EngineFrame& frame : engine.render(is_direct ? std::vector{output} : pair, some)) {
      images.push_back({is_direct ? share_of(frame.images[0], output) : ratio_of(frame.images[0], frame.images[1]),
                        frame.milliseconds});
    }
  }
  return images;
}

}  // namespace

FrameSource frames_of(std::shared_ptr<Engine> engine) {
  const EngineDescription& described = engine->description();
  FrameSource source;
  source.title = described.title();
  source.has_shadows = shows_shadows(described);
  source.has_ao = shows_ao(described);
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
    std::visit([&](const auto& lens) { surfaces.near_plane = lens.near_plane, surfaces.far_plane = lens.far_plane; },
               loaded.view().camera.projection);
    surfaces.depth = Image<float>(framed.view.width, framed.view.height, 0.0f);
    for (std::size_t i = 0; i < surfaces.depth.size(); ++i) surfaces.depth[i] = frame.images.front()[i].x;
    return surfaces;
  };
  source.visibility = [at](const FramedView& framed, std::span<const EngineParams> params) {
    return shares(at(framed), params, "visibility", {"lit", "unshadowed"});
  };
  if (!described.writes("visibility") && described.writes("unshadowed")) {
    source.unlit = [at](const FramedView& framed) {
      Engine& loaded = at(framed);
      const EngineParams params = loaded.parameters();
      return unlit_of(loaded.render({"lit", "unshadowed"}, {&params, 1}).front().images[1]);
    };
  }
  source.ao = [at](const FramedView& framed, std::span<const EngineParams> params) {
    return shares(at(framed), params, "ao", {"occluded", "open"});
  };
  source.take_warnings = [engine] { return engine->take_warnings(); };
  return source;
}

bool shows_shadows(const EngineDescription& engine) { return engine.writes("visibility") || engine.writes("lit"); }

bool shows_ao(const EngineDescription& engine) { return engine.writes("ao") || engine.writes("occluded"); }

Image<float> ratio_of(const Image<vec3>& with, const Image<vec3>& without) {
  Image<float> ratio(with.width, with.height, 1.0f);
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    const double all = luminance(without[i]);
    if (std::isnan(all) || std::isnan(luminance(with[i]))) {
      ratio[i] = std::numeric_limits<float>::quiet_NaN();
    } else if (all > 0.0) {
      ratio[i] = static_cast<float>(std::clamp(luminance(with[i]) / all, 0.0, 1.0));
    }
  }
  return ratio;
}

Image<std::uint8_t> unlit_of(const Image<vec3>& without) {
  Image<std::uint8_t> unlit(without.width, without.height, 0);
  for (std::size_t i = 0; i < unlit.size(); ++i) unlit[i] = luminance(without[i]) <= 0.0 ? 1 : 0;
  return unlit;
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
