#include "raster/shadow/prefiltered_pass.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/error.h"
#include "raster/gbuffer/view_block.h"
#include "raster/shader_interface.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

struct MapFormat {
  gl::Format format;
  std::string layout;  // the same in GLSL
};

// A single value is a float: that of ESM.
MapFormat map_format(const Prefiltered& technique) {
  using enum gl::Format;
  static const MapFormat pairs[] = {{rg32f, "rg32f"}, {rg16f, "rg16f"}, {rg16, "rg16"}};
  static const MapFormat quads[] = {{rgba32f, "rgba32f"}, {rgba16f, "rgba16f"}, {rgba16, "rgba16"}};
  if (technique.values == 1) return {r32f, "r32f"};
  return (technique.values == 2 ? pairs : quads)[static_cast<std::size_t>(technique.format)];
}

// The technique is constant in the program, and its settings are not.
std::string defines_of(const Prefiltered& technique) {
  return "#define TECHNIQUE_TEXT " + std::string(technique.text) + "\n#define CONSTANTS " + technique.constants + "\n" +
         define("GROUPS", static_cast<unsigned>(technique.groups));
}

// For the result and the one of the first axis.
void require_room(const gl::Context& context, int side, int layers, gl::Format format) {
  const std::size_t texels =
      static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * static_cast<std::size_t>(layers);
  const std::size_t bytes = 2 * texels * gl::texel_bytes(format);
  if (bytes <= context.memory_limit_bytes()) return;
  throw Error(ExitCode::usage, "shadow.resolution",
              "the filtered map takes " + std::to_string(bytes >> 20) + " MiB of the machine's " +
                  std::to_string(context.memory_limit_bytes() >> 20) + " MiB",
              "choose a smaller resolution, fewer terms or a smaller format");
}

}  // namespace

FilteredMap filter(const DrawnMap& drawn, const Prefiltered& technique) {
  const gl::Context& context = drawn.context;
  const ShadowMap& map = drawn.map;
  const int side = map.layout.resolution;
  const int layers = static_cast<int>(map.layout.views.size()) * technique.groups;
  const MapFormat format = map_format(technique);
  require_room(context, side, layers, format.format);
  const gl::Buffer weights = gl::make_buffer("blur weights", std::span<const float>(technique.blur));
  const gl::Buffer settings = gl::make_buffer("filter settings", technique.settings);
  const auto blur = [&](const gl::Texture& source, bool is_first) {
    const int levels = technique.mipmaps && !is_first ? gl::mipmap_levels(side, side) : 1;
    gl::Texture blurred = gl::make_texture("filtered shadow map", format.format, side, side, layers, levels);
    gl::Pass pass(context, {{"prefilter.comp"},
                            defines_of(technique) + define("IS_DEPTH", is_first ? 1 : 0) +
                                define("SAMPLES", static_cast<unsigned>(technique.samples_per_side)) +
                                "#define MAP_FORMAT " + format.layout + "\n"});
    pass.buffer("MapSettings", settings)
        .texture("source", source)
        .image("blurred", blurred, format.format, true)
        .buffer("BlurWeights", weights)
        .value("taps", static_cast<int>(technique.blur.size()))
        .value("axis", is_first ? 1 : 0, is_first ? 0 : 1)
        .dispatch(side, side, layers);
    return blurred;
  };
  // The same projection, with smaller texels.
  std::optional<ShadowMap> finer;
  if (technique.samples_per_side > 1) {
    MapLayout layout = map.layout;
    layout.resolution *= technique.samples_per_side;
    finer = draw_shadow_map(context, drawn.scene, drawn.light, layout, drawn.depth);
  }
  FilteredMap filtered{blur(blur(finer ? finer->depth : map.depth, true), false)};
  if (technique.mipmaps) gl::compute_mipmaps(filtered.values);
  return filtered;
}

std::vector<Image<float>> draw_lookups(const gl::Context& context, const ShadowLookup& lookup,
                                       const Prefiltered& technique, std::span<const PrefilteredLookup> lookups) {
  assert(lookup.drawn != nullptr && lookups.size() <= max_lookups);
  const int width = lookup.gbuffer.width;
  const int height = lookup.gbuffer.height;
  const int layers = static_cast<int>(lookups.size());
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, width, height, layers);
  std::vector<std::byte> values;
  for (const PrefilteredLookup& each : lookups) std::ranges::copy(each.values, std::back_inserter(values));
  gl::Pass pass = lookup_pass(
      context, lookup, lookup.bias.constant.unit,
      {{"prefiltered_visibility.comp"}, defines_of(technique) + define("HAS_MIPMAPS", technique.mipmaps ? 1 : 0)});
  if (technique.mipmaps) {
    assert(lookup.view != nullptr);
    pass.block("View", make_view_block(*lookup.view));
  }
  pass.value("lookup_count", layers)
      .buffer("Lookups", gl::make_buffer("look-ups", values))
      .texture("values", std::get<FilteredMap>(lookup.drawn->of_technique).values)
      .image("visibility_image", visibility, gl::Format::r32f, true)
      .dispatch(width, height);
  return read_layers<float>(visibility, gl::Format::r32f, layers);
}

PrefilteredLookup lookup_of(const BiasParams& bias, const Prefiltered& technique) {
  PrefilteredLookup lookup{bytes_of(vec2(bias.constant.number, bias.slope))};
  std::ranges::copy(technique.settings, std::back_inserter(lookup.values));
  return lookup;
}

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Prefiltered& technique) {
  const PrefilteredLookup one = lookup_of(lookup.bias, technique);
  Image<float> visibility = std::move(draw_lookups(context, lookup, technique, {&one, 1}).front());
  return {std::move(visibility), {Image<uvec4>(lookup.gbuffer.width, lookup.gbuffer.height, uvec4(0)), 1}};
}

}  // namespace umbrameter
