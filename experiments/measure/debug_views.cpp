#include "experiments/measure/debug_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

#include "core/error.h"
#include "core/lists.h"
#include "core/suggestion.h"
#include "raster/rasterizer.h"
#include "raster/texture_image.h"
#include "reports/figures/figures.h"
#include "results/number_text.h"
#include "scenes/light.h"
#include "techniques/shading/light_model.h"

namespace umbrameter {
namespace {

using Colors = Image<glm::u8vec3>;

constexpr std::array<std::string_view, 11> view_kinds = {"unshadowed",   "shadows",    "ao",        "depth",
                                                         "position",     "normal",     "albedo",    "specular",
                                                         "light-buffer", "shadow-map", "light-view"};

struct Wanted {
  std::string kind;
  std::vector<std::uint32_t> lights;  // of shadow-map and light-view
};

bool is_of_light(std::string_view kind) { return kind == "shadow-map" || kind == "light-view"; }

// What run.overlay may list: "all, unshadowed, …, shadow-map[:LIGHT]".
std::string debug_view_names() {
  std::string names = "all";
  for (const std::string_view kind : view_kinds)
    names += fmt::format(", {}{}", kind, is_of_light(kind) ? "[:LIGHT]" : "");
  return names;
}

std::vector<Wanted> parse(const Stages& stages, const Experiment& experiment) {
  const bool has_light_buffer = experiment.shading.path == ShadingPath::deferred;
  std::vector<Wanted> all;
  for (const std::string& name : split(experiment.run.overlay, ',')) {
    if (name.empty()) continue;
    if (name == "all") {
      for (const std::string_view kind : view_kinds) {
        if (kind == "light-buffer" && !has_light_buffer) continue;
        all.push_back({std::string(kind),
                       is_of_light(kind) ? stages.lights(experiment.view.light) : std::vector<std::uint32_t>{}});
      }
      continue;
    }
    const std::size_t colon = name.find(':');
    const std::string kind = name.substr(0, colon);
    if (std::ranges::find(view_kinds, kind) == view_kinds.end() || (colon != std::string::npos && !is_of_light(kind))) {
      const std::vector<std::string> names(view_kinds.begin(), view_kinds.end());
      const std::string similar = suggestion(similar_names(kind, names));
      throw Error(ExitCode::usage, fmt::format("--overlay {}", name), "there is no such view",
                  similar.empty() ? "one of: " + debug_view_names() : similar);
    }
    if (kind == "light-buffer" && !has_light_buffer) {
      throw Error(ExitCode::usage, fmt::format("--overlay {}", name), "the forward path has no light buffer",
                  "use --shading.path deferred");
    }
    Wanted wanted{kind, {}};
    if (is_of_light(kind)) {
      wanted.lights = stages.lights(colon == std::string::npos ? experiment.view.light : name.substr(colon + 1));
    }
    all.push_back(std::move(wanted));
  }
  return all;
}

Colors map_pixels(const GBuffer& gbuffer, const std::function<vec3(std::size_t)>& color) {
  Colors picture(gbuffer.width, gbuffer.height, glm::u8vec3(255));
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (gbuffer.is_surface(i)) picture[i] = glm::u8vec3(glm::clamp(color(i), 0.0f, 1.0f) * 255.0f + 0.5f);
  }
  return picture;
}

struct Range {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
};

// The range of all values except `none`.
Range range_of(const Image<float>& values, float none) {
  Range range;
  for (const float value : values.pixels) {
    if (value == none) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

// The lowest value is dark; `none` is white.
Colors gray(const Image<float>& values, float none) {
  const auto [low, high] = range_of(values, none);
  const float scale = high > low ? 1.0f / (high - low) : 0.0f;
  Colors picture(values.width, values.height, glm::u8vec3(255));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == none) continue;
    picture[i] = glm::u8vec3(static_cast<std::uint8_t>(20.0f + 200.0f * (values[i] - low) * scale));
  }
  return picture;
}

std::string range_text(const Image<float>& values, float none, double unit) {
  const auto [low, high] = range_of(values, none);
  if (!(high >= low)) return "It is empty.";
  return fmt::format("From {} (dark) to {}; white: nothing.", metres_text(low * unit), metres_text(high * unit));
}

// A camera at the light that sees what this view of its map covers.
View light_view(const Light& light, const MapLayout& layout, std::size_t view) {
  const MapView& map_view = layout.views[view];
  View seen;
  seen.width = seen.height = 512;
  dmat4 world_from_camera = glm::inverse(layout.light_from_world);
  if (layout.kind == MapKind::orthographic) {
    dmat4 to_view(1.0);
    to_view[3] = dvec4(map_view.center, 0.0, 1.0);
    world_from_camera = world_from_camera * to_view;
    seen.camera.projection = OrthographicProjection{map_view.half_extent, map_view.half_extent, 0.0, layout.far_depth};
  } else {
    if (layout.kind == MapKind::cube) {
      // A camera looks along −z of its frame; cube_face() has right, up and forward.
      const dmat3 face = cube_face(static_cast<int>(view));
      world_from_camera = world_from_camera * dmat4(dmat3(face[0], face[1], -face[2]));
    }
    // Of a hemisphere, the middle.
    if (layout.kind == MapKind::paraboloid && view == 1) {
      world_from_camera =
          world_from_camera * dmat4(dvec4(-1, 0, 0, 0), dvec4(0, 1, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 0, 0, 1));
    }
    seen.camera.projection =
        PerspectiveProjection{2.0 * std::atan(map_view.half_extent), 1e-4 * layout.far_depth, layout.far_depth};
  }
  seen.camera.world_from_camera = world_from_camera;
  seen.camera.name = light.name;
  return seen;
}

class Views {
 public:
  Views(Stages& stages, const Measurement& measurement)
      : stages_(stages),
        measurement_(measurement),
        experiment_(measurement.experiment),
        shading_(stages.shading_surfels(experiment_)),
        gbuffer_(*shading_.gbuffer) {}

  void add(const Wanted& wanted) {
    if (wanted.kind == "shadow-map") {
      for (const std::uint32_t light : wanted.lights) add_map(light);
    } else if (wanted.kind == "light-view") {
      for (const std::uint32_t light : wanted.lights) add_light_view(light);
    } else {
      add_buffer(wanted.kind);
    }
  }

  std::vector<DebugView> take() { return std::move(views_); }

 private:
  void add_buffer(const std::string& kind) {
    const GBuffer& g = gbuffer_;
    if (kind == "depth") {
      push(kind, "Depth", range_text(g.depth, 0.0f, 1.0), gray(g.depth, 0.0f));
    } else if (kind == "position") {
      const Bounds& bounds = stages_.bounds();
      const dvec3 low = bounds.corner(0);
      const dvec3 size = glm::max(bounds.corner(7) - low, dvec3(1e-9));
      push(kind, "Positions", "x is red, y green, z blue, over the scene's bounds.",
           map_pixels(g, [&](std::size_t i) { return vec3((dvec3(g.position[i]) - low) / size); }));
    } else if (kind == "normal") {
      push(kind, "Shading normals", "World space; (n + 1) / 2 as red, green and blue.",
           map_pixels(g, [&](std::size_t i) { return g.shading_normal[i] * 0.5f + 0.5f; }));
    } else if (kind == "albedo" || kind == "specular") {
      Image<vec3> colors(g.width, g.height, vec3(1.0f));
      for (std::size_t i = 0; i < colors.size(); ++i) {
        if (g.is_surface(i)) colors[i] = kind == "albedo" ? g.albedo[i] * (1.0f - g.metallic[i]) : vec3(g.specular[i]);
      }
      push(kind, kind == "albedo" ? "Diffuse reflectance" : "Specular reflectance at normal incidence", "sRGB.",
           tone_map(colors, 1.0f));
    } else if (kind == "ao") {
      const Image<float>& ao = *measurement_.ao->raster;
      push(kind, "Ambient occlusion", "Accessibility of the technique: white is open.",
           map_pixels(g, [&](std::size_t i) { return vec3(ao[i]); }));
    } else if (kind == "light-buffer") {
      push(kind, "Light buffer", "The sum over the lights, without ambient light.",
           tone_map(measurement_.image->raster->light_buffer, exposure()));
    } else {
      push(kind, kind == "shadows" ? "With shadows, without AO" : "Without shadows and AO",
           "The same exposure as the image.", tone_map(shaded(kind == "shadows"), exposure()));
    }
  }

  float exposure() const { return static_cast<float>(experiment_.shading.exposure); }

  Image<vec3> shaded(bool with_shadows) const {
    const View& view = measurement_.surfels.view;
    const Image<float> open(gbuffer_.width, gbuffer_.height, 1.0f);
    Image<vec3> image(gbuffer_.width, gbuffer_.height, vec3(0));
    for (const ShadowMeasurement& shadow : measurement_.shadows) {
      add_light(image, gbuffer_, view, stages_.light(experiment_, shadow.light),
                with_shadows ? shadow.raster->visibility : open, experiment_.shading);
    }
    add_ambient(image, gbuffer_, view, open, experiment_.shading);
    return image;
  }

  void add_map(std::uint32_t light) {
    const auto map = stages_.map(experiment_, light);
    const int layers = static_cast<int>(map->layout.views.size());
    const std::vector<Image<float>> depths = read_layers<float>(map->depth, gl::Format::depth32f, layers);
    for (std::size_t v = 0; v < depths.size(); ++v) {
      push_of_light("shadow_map_", "Shadow map", light, map->layout, v,
                    "Depth from the light. " + range_text(depths[v], 1.0f, map->layout.far_depth),
                    gray(depths[v], 1.0f));
    }
  }

  void add_light_view(std::uint32_t light) {
    const MapLayout layout = *stages_.layout(experiment_, light);
    for (std::size_t v = 0; v < layout.views.size(); ++v) {
      const View view = light_view(stages_.scene().lights[light], layout, v);
      const GBuffer seen = read_back(stages_.context(), draw_gbuffer(stages_.context(), stages_.uploaded(), view));
      Image<vec3> colors(seen.width, seen.height, vec3(1.0f));
      for (std::size_t i = 0; i < colors.size(); ++i) {
        if (!seen.is_surface(i)) continue;
        const dvec3 to_eye = to_viewer(view, dvec3(seen.position[i]));
        const auto cosine = static_cast<float>(glm::dot(dvec3(seen.shading_normal[i]), to_eye));
        colors[i] = seen.albedo[i] * (0.25f + 0.75f * std::max(cosine, 0.0f));
      }
      push_of_light("light_view_", "Seen from", light, layout, v,
                    "What the light lights: its colours, brighter where they face it.", tone_map(colors, 1.0f));
    }
  }

  // A view that is listed twice is shown once.
  void add(DebugView view) {
    const bool is_new = std::ranges::none_of(views_, [&](const DebugView& other) { return other.stem == view.stem; });
    if (is_new) views_.push_back(std::move(view));
  }

  void push(const std::string& kind, std::string title, std::string caption, Colors picture) {
    std::string stem = "view_" + kind;
    std::replace(stem.begin(), stem.end(), '-', '_');
    add({std::move(stem), std::move(title), std::move(caption), std::move(picture)});
  }

  void push_of_light(const std::string& stem, const std::string& title, std::uint32_t light, const MapLayout& layout,
                     std::size_t view, std::string caption, Colors picture) {
    const std::string& layer = stages_.layer(light);
    const std::string name = stages_.title(light);
    const std::string part = view_name(layout, view);
    add({part.empty() ? stem + layer : fmt::format("{}{}_{}", stem, layer, view),
         part.empty() ? title + ": " + name : fmt::format("{}: {}, {}", title, name, part), std::move(caption),
         std::move(picture)});
  }

  Stages& stages_;
  const Measurement& measurement_;
  const Experiment& experiment_;
  ShadingSurfels shading_;
  const GBuffer& gbuffer_;
  std::vector<DebugView> views_;
};

}  // namespace

void check_debug_views(const Stages& stages, const Experiment& experiment) { parse(stages, experiment); }

std::vector<DebugView> make_debug_views(Stages& stages, const Measurement& measurement) {
  Views views(stages, measurement);
  for (const Wanted& wanted : parse(stages, measurement.experiment)) views.add(wanted);
  return views.take();
}

}  // namespace umbrameter
