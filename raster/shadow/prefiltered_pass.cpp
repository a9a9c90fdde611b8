#include "raster/shadow/prefiltered_pass.h"

#include <algorithm>
#include <array>
#include <cassert>
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

static_assert(max_lookups == constant("MAX_LOOKUPS"));

struct MapFormat {
  gl::Format format;
  std::string layout;  // the same in GLSL
};

MapFormat map_format(const Prefiltered& technique) {
  const int of_values = technique.settings.technique;
  if (of_values == shared::ESM) return {gl::Format::r32f, "r32f"};
  const bool is_pair = of_values == shared::VSM || of_values == shared::EVSM2;
  switch (technique.format) {
    case MomentFormat::f16:
      return is_pair ? MapFormat{gl::Format::rg16f, "rg16f"} : MapFormat{gl::Format::rgba16f, "rgba16f"};
    case MomentFormat::unorm16:
      return is_pair ? MapFormat{gl::Format::rg16, "rg16"} : MapFormat{gl::Format::rgba16, "rgba16"};
    case MomentFormat::f32:
      break;
  }
  return is_pair ? MapFormat{gl::Format::rg32f, "rg32f"} : MapFormat{gl::Format::rgba32f, "rgba32f"};
}

// The technique is constant in the program, and what a sweep varies is not.
std::string defines_of(const Prefiltered& technique) {
  return define("TECHNIQUE", static_cast<unsigned>(technique.settings.technique)) +
         define("IS_QUANTIZED", static_cast<unsigned>(technique.settings.is_quantized)) +
         define("IS_HAUSDORFF", static_cast<unsigned>(technique.settings.is_hausdorff)) +
         define("TERMS", static_cast<unsigned>(technique.settings.terms)) +
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
  const auto blur = [&](const gl::Texture& source, bool is_first) {
    const int levels = technique.mipmaps && !is_first ? gl::mipmap_levels(side, side) : 1;
    gl::Texture blurred = gl::make_texture("filtered shadow map", format.format, side, side, layers, levels);
    gl::Pass pass(context, {{"prefilter.comp"},
                            defines_of(technique) + define("IS_DEPTH", is_first ? 1 : 0) +
                                define("SAMPLES", static_cast<unsigned>(technique.samples_per_side)) +
                                "#define MAP_FORMAT " + format.layout + "\n"});
    pass.value("exponents", technique.settings.exponents)
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
  assert(lookup.filtered != nullptr && lookups.size() <= max_lookups);
  const int width = lookup.gbuffer.width;
  const int height = lookup.gbuffer.height;
  const int layers = static_cast<int>(lookups.size());
  const gl::Texture visibility = gl::make_texture("visibility", gl::Format::r32f, width, height, layers);
  std::array<PrefilteredLookup, max_lookups> block{};
  std::ranges::copy(lookups, block.begin());
  gl::Pass pass = lookup_pass(
      context, lookup, lookup.bias.constant.unit,
      {{"prefiltered_visibility.comp"}, defines_of(technique) + define("HAS_MIPMAPS", technique.mipmaps ? 1 : 0)});
  if (technique.mipmaps) {
    assert(lookup.view != nullptr);
    pass.block("View", make_view_block(*lookup.view));
  }
  pass.value("exponents", technique.settings.exponents)
      .value("lookup_count", layers)
      .block("Lookups", block)
      .texture("values", lookup.filtered->values)
      .image("visibility_image", visibility, gl::Format::r32f, true)
      .dispatch(width, height);
  return read_layers<float>(visibility, gl::Format::r32f, layers);
}

PrefilteredLookup lookup_of(const BiasParams& bias, const Prefiltered& technique) {
  const shared::PrefilterSettings& settings = technique.settings;
  return {static_cast<float>(bias.constant.number),
          static_cast<float>(bias.slope),
          settings.min_variance,
          settings.bleeding_reduction,
          settings.moment_bias,
          settings.ringing_reduction,
          settings.contrast};
}

RasterVisibility draw(const gl::Context& context, const ShadowLookup& lookup, const Prefiltered& technique) {
  const PrefilteredLookup one = lookup_of(lookup.bias, technique);
  Image<float> visibility = std::move(draw_lookups(context, lookup, technique, {&one, 1}).front());
  return {std::move(visibility), {Image<uvec4>(lookup.gbuffer.width, lookup.gbuffer.height, uvec4(0)), 1}};
}

}  // namespace umbrameter
