#include "techniques/shading/light_model.h"

#include <cassert>
#include <cmath>
#include <variant>

#include "core/parallel.h"

namespace umbrameter {
namespace {

template <class Shade>
void add_to_surfaces(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Shade& shade) {
  assert(radiance.size() == gbuffer.instance.size());
  const auto width = static_cast<std::size_t>(gbuffer.width);
  parallel_for(static_cast<std::size_t>(gbuffer.height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      if (gbuffer.is_surface(i)) radiance[i] += shade(surface_point(gbuffer, view, i), i);
    }
  });
}

}  // namespace

shared::LightModel light_model(const ShadingParams& params) {
  shared::LightModel model{};
  model.attenuation_factors = vec4(vec3(dvec3(params.constant, params.linear, params.quadratic)), 0.0f);
  model.specular = static_cast<int>(params.specular);
  model.normalization = static_cast<int>(params.normalization);
  model.attenuation = static_cast<int>(params.attenuation);
  model.spot_falloff = static_cast<int>(params.spot_falloff);
  return model;
}

shared::LightSource light_source(const Light& light) {
  double range = 0.0;
  double inner = 0.0;
  double outer = pi;
  float kind = 0.0f;
  if (const auto* point = std::get_if<PointLight>(&light.shape)) {
    kind = 1.0f;
    range = point->range;
  } else if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    kind = 2.0f;
    range = spot->range;
    inner = spot->inner_cone_angle;
    outer = spot->outer_cone_angle;
  }
  shared::LightSource source{};
  source.position_range = vec4(vec3(light.position()), static_cast<float>(range));
  source.axis_kind = vec4(vec3(light.axis()), kind);
  source.color_cone = vec4(light.color * static_cast<float>(light.intensity), static_cast<float>(outer));
  source.cone = vec4(static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer)), 0.0f, 0.0f);
  return source;
}

shared::SurfacePoint surface_point(const GBuffer& gbuffer, const View& view, std::size_t pixel) {
  shared::SurfacePoint point{};
  point.position = gbuffer.position[pixel];
  point.normal = gbuffer.shading_normal[pixel];
  point.to_viewer = vec3(to_viewer(view, dvec3(gbuffer.position[pixel])));
  point.diffuse = gbuffer.albedo[pixel] * (1.0f - gbuffer.metallic[pixel]);
  point.specular = vec3(gbuffer.specular[pixel]);
  point.shininess = shared::shininess_of(gbuffer.specular[pixel].w);
  return point;
}

void add_light(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Light& light,
               const Image<float>& visibility, const ShadingParams& params) {
  const shared::LightModel model = light_model(params);
  const shared::LightSource source = light_source(light);
  add_to_surfaces(radiance, gbuffer, view, [&](const shared::SurfacePoint& point, std::size_t i) {
    const shared::Reflection reflection = shared::reflect_light(point, source, model);
    return visibility[i] * (reflection.diffuse + reflection.specular);
  });
}

void add_ambient(Image<vec3>& radiance, const GBuffer& gbuffer, const View& view, const Image<float>& ao,
                 const ShadingParams& params) {
  add_to_surfaces(radiance, gbuffer, view, [&](const shared::SurfacePoint& point, std::size_t i) {
    return ao[i] * shared::reflect_ambient(point, static_cast<float>(params.ambient));
  });
}

}  // namespace umbrameter
