#include "raster/ao/ao_pass.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "raster/ao/ao_passes.h"
#include "raster/gl/pass.h"
#include "raster/texture_image.h"

namespace umbrameter {

namespace {

// Levels beyond the first: a depth pyramid.
gl::Texture linear_depth_of(const gl::Context& context, const GpuGBuffer& gbuffer, int further_levels) {
  const int levels = std::min(1 + further_levels, gl::mipmap_levels(gbuffer.width, gbuffer.height));
  gl::Texture depth = gl::make_texture("ao linear depth", gl::Format::r32f, gbuffer.width, gbuffer.height, 0, levels);
  gl::Pass(context, {{"linear_depth.comp"}, {}})
      .texture("ids", gbuffer.ids)
      .texture("position_depth", gbuffer.position_depth)
      .image("linear_depth", depth, gl::Format::r32f)
      .dispatch(gbuffer.width, gbuffer.height);
  for (int level = 1; level < levels; ++level) {
    gl::Pass(context, {{"depth_pyramid.comp"}, {}})
        .texture("finer_levels", depth)
        .image("level_image", depth, gl::Format::r32f, false, level)
        .value("level", level)
        .dispatch(std::max(gbuffer.width >> level, 1), std::max(gbuffer.height >> level, 1));
  }
  return depth;
}

// What the techniques read besides the G-buffer.
struct AoTextures {
  gl::Texture linear_depth;            // with the levels that the technique reads
  std::optional<gl::Texture> normals;  // if they are not those of the G-buffer
};

AoTextures prepare(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params) {
  AoTextures textures{linear_depth_of(context, gbuffer, capabilities_of(make_technique(params)).depth_levels), {}};
  if (params.inputs.normals != AoNormals::exact) {
    textures.normals = draw_normals(context, gbuffer, textures.linear_depth, view, params.inputs);
  }
  return textures;
}

AoInputs inputs_of(const GpuGBuffer& gbuffer, const AoTextures& textures, const View& view, std::uint32_t seed) {
  return {gbuffer, textures.normals ? *textures.normals : gbuffer.geometric_normal, textures.linear_depth, view, seed};
}

Image<vec3> directions_of(const Image<vec4>& texels) {
  Image<vec3> directions(texels.width, texels.height);
  for (std::size_t i = 0; i < texels.size(); ++i) directions[i] = vec3(texels[i]);
  return directions;
}

}  // namespace

Image<float> draw_ao(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                     std::uint32_t seed) {
  assert(params.sampling.radius.unit == LengthUnit::metres && params.bias.depth.unit == LengthUnit::metres);
  const AoTextures textures = prepare(context, gbuffer, view, params);
  AoInputs inputs = inputs_of(gbuffer, textures, view, seed);
  inputs.resolution = params.resolution.kind;
  gl::Texture ao = blur(context, inputs, draw(context, inputs, make_technique(params)), params);
  if (params.resolution.kind == AoResolution::half) ao = upsample(context, inputs, ao, params);
  Image<float> image = read_image<float>(ao, gl::Format::r32f);
  // GTAO's estimate exceeds 1 in some pixels, and only its mean over the noise does not.
  Image<vec4> albedo;
  if (reads_surface(params.tone)) albedo = read_image<vec4>(gbuffer.albedo, gl::Format::rgba32f);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const AoToneParams tone = albedo.empty() ? params.tone : at_surface(params.tone, vec3(albedo[i]), albedo[i].w);
    image[i] = with_tone(std::min(image[i], 1.0f), tone);
  }
  return image;
}

std::optional<Image<vec3>> draw_bent_normals(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view,
                                             const AoParams& params, std::uint32_t seed) {
  const AoTextures textures = prepare(context, gbuffer, view, params);
  const auto drawn = draw_bent_normals(context, inputs_of(gbuffer, textures, view, seed), make_technique(params));
  if (!drawn) return {};
  return directions_of(read_image<vec4>(*drawn, gl::Format::rgba32f));
}

AoSurfelImages read_ao_surfels(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view,
                               const AoParams& params) {
  const AoTextures textures = prepare(context, gbuffer, view, params);
  const AoInputs inputs = inputs_of(gbuffer, textures, view, 0);
  return {read_image<float>(inputs.linear_depth, gl::Format::r32f),
          directions_of(read_image<vec4>(inputs.normals, gl::Format::rgba32f))};
}

void draw_ao_response(const gl::Context& context, const GpuGBuffer& gbuffer, const View& view, const AoParams& params,
                      std::uint32_t seed, const AoAxes& axes, const AoResponseSink& sink) {
  const AoTextures textures = prepare(context, gbuffer, view, params);
  list_occluding_samples(context, inputs_of(gbuffer, textures, view, seed), std::get<Ssao>(make_technique(params)),
                         axes, sink);
}

}  // namespace umbrameter
