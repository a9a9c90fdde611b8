#include "raster/shadow/shadow_map.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"
#include "raster/gl/pass.h"
#include "raster/shadow/map_layer.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

int layer_count(const MapLayout& layout) { return static_cast<int>(layout.views.size()); }

// Depth and ids; another encoding's texture; and both layers of a combined surface, with the ids of one.
std::size_t texel_bytes(const MapLayout& layout, const MapDepthParams& params) {
  const std::size_t depth = gl::texel_bytes(gl::Format::depth32f);
  const std::size_t ids = gl::texel_bytes(gl::Format::rg32ui);
  return depth + ids + (stores_linear_floats(params, layout) ? 0 : depth) +
         (params.surface == StoredSurface::nearest ? 0 : 2 * depth + ids);
}

void require_room(const gl::Context& context, const MapLayout& layout, const MapDepthParams& params) {
  const auto side = static_cast<std::size_t>(layout.resolution);
  const std::size_t bytes = side * side * static_cast<std::size_t>(layer_count(layout)) * texel_bytes(layout, params);
  std::string given = std::to_string(layout.resolution);
  given += " texels ";
  if (layout.resolution > context.max_texture_size()) {
    throw Error(ExitCode::usage, "shadow.resolution",
                given + "are more than " + context.device().renderer + " can draw",
                "at most " + std::to_string(context.max_texture_size()));
  }
  if (bytes > context.memory_limit_bytes()) {
    throw Error(ExitCode::usage, "shadow.resolution",
                given + "take " + std::to_string(bytes >> 20) + " MiB of the machine's " +
                    std::to_string(context.memory_limit_bytes() >> 20) + " MiB",
                "choose a smaller resolution");
  }
}

gl::Texture make_depth(const MapLayout& layout, gl::Format format) {
  return gl::make_texture("shadow depth", format, layout.resolution, layout.resolution, layer_count(layout));
}

gl::Texture make_ids(const MapLayout& layout) {
  return gl::make_texture("shadow ids", gl::Format::rg32ui, layout.resolution, layout.resolution, layer_count(layout));
}

gl::Texture make_stored(const gl::Context& context, const MapLayout& layout, MapDepthFormat format) {
  gl::Texture stored = make_depth(layout, texture_format(format));
  const int wanted = format == MapDepthFormat::fixed16 ? 16 : format == MapDepthFormat::fixed24 ? 24 : 32;
  const int given = gl::depth_bits_of(stored);
  if (given != wanted) {
    throw Error(ExitCode::usage, "shadow.depth-format",
                context.device().renderer + " stores " + std::to_string(given) + " bits for " + std::to_string(wanted),
                "use 32f");
  }
  return stored;
}

// The ids are those of the surface whose depth is stored. Of a depth between two surfaces they are the nearer one's:
// a tap is acne or false occlusion by the surface that the light sees, whatever part of the gap behind it is stored.
void draw_surface(const MapSource& source, const ShadowMap& map, const gl::Texture& stored, int mapping) {
  const gl::Texture nearest = make_depth(map.layout, gl::Format::depth32f);
  const gl::Texture second = make_depth(map.layout, gl::Format::depth32f);
  const gl::Texture other_ids = make_ids(map.layout);
  const bool is_second = source.params.surface == StoredSurface::second;
  draw_map_layer(source, {nearest, is_second ? other_ids : map.ids, MapDepthFormat::f32, shared::DEPTH_LINEAR});
  draw_map_layer(source,
                 {second, is_second ? map.ids : other_ids, MapDepthFormat::f32, shared::DEPTH_LINEAR, &nearest});
  combine_layers(source, {nearest, second}, stored, mapping);
}

}  // namespace

ShadowMap make_shadow_map(const gl::Context& context, const MapLayout& layout) {
  require_room(context, layout, {});
  ShadowMap map;
  map.layout = layout;
  map.depth = make_depth(layout, gl::Format::depth32f);
  map.ids = make_ids(layout);
  context.check("shadow map textures");
  return map;
}

bool has_textures_for(const ShadowMap& map, const MapLayout& layout) {
  return map.layout.resolution == layout.resolution && layer_count(map.layout) == layer_count(layout);
}

void redraw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light, ShadowMap& map,
                       const MapDepthParams& params) {
  require_sense(params, map.layout);
  map.layout = with_depth_encoding(std::move(map.layout), params);
  require_room(context, map.layout, params);
  const MapSource source{context, scene, light, map.layout, params};
  const bool is_direct = stores_linear_floats(params, map.layout);
  const int mapping = depth_mapping(params, map.layout);
  gl::Texture encoded;
  if (!is_direct) encoded = make_stored(context, map.layout, params.format);
  const gl::Texture& stored = is_direct ? map.depth : encoded;
  if (params.surface == StoredSurface::nearest) {
    draw_map_layer(source, {stored, map.ids, params.format, mapping});
  } else {
    draw_surface(source, map, stored, mapping);
  }
  if (!is_direct) decode_depth_map(source, stored, map.depth);
}

ShadowMap draw_shadow_map(const gl::Context& context, const UploadedScene& scene, const Light& light,
                          const MapLayout& layout, const MapDepthParams& params) {
  ShadowMap map = make_shadow_map(context, layout);
  redraw_shadow_map(context, scene, light, map, params);
  return map;
}

std::optional<DepthRange> depth_range_of(const gl::Context& context, const ShadowMap& map) {
  std::array<std::uint32_t, 2> bits = {0xffffffffu, 0u};
  const gl::Buffer range = gl::make_buffer("depth range", std::span<const std::uint32_t>(bits));
  gl::Pass pass(context, {{"depth_range.comp"}, {}});
  pass.texture("shadow_depth", map.depth)
      .buffer("Range", range)
      .dispatch(map.layout.resolution, map.layout.resolution, layer_count(map.layout));
  gl::read_buffer(range, std::as_writable_bytes(std::span(bits)));
  if (bits[0] > bits[1]) return std::nullopt;
  const auto metres = [&](std::uint32_t each) {
    return static_cast<double>(std::bit_cast<float>(each)) * map.layout.far_depth;
  };
  return DepthRange{metres(bits[0]), metres(bits[1])};
}

ShadowMapImages read_back(const gl::Context& context, const ShadowMap& map) {
  const int layers = layer_count(map.layout);
  ShadowMapImages images;
  images.depth = read_layers<float>(map.depth, gl::Format::depth32f, layers);
  for (const Image<uvec2>& ids : read_layers<uvec2>(map.ids, gl::Format::rg32ui, layers)) {
    Image<std::uint32_t>& instance = images.instance.emplace_back(ids.width, ids.height);
    Image<std::uint32_t>& triangle = images.triangle.emplace_back(ids.width, ids.height);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      instance[i] = ids[i].x;
      triangle[i] = ids[i].y;
    }
  }
  context.check("shadow map read back");
  return images;
}

}  // namespace umbrameter
