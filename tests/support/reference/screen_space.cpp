#include "tests/support/reference/screen_space.h"

#include <algorithm>

#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

bool is_blocked(const GBuffer& gbuffer, const shared::March& march, std::size_t receiver, const ivec2& pixel,
                int is_orthographic, const shared::MarchSettings& settings) {
  const dvec3 position(gbuffer.position[receiver]);
  const dvec3 normal(gbuffer.geometric_normal[receiver]);
  for (int i = 0; i < settings.steps; ++i) {
    const vec3 sample = shared::march_sample(march, i, is_orthographic, settings);
    const ivec2 at(glm::floor(vec2(sample)));
    if (at.x < 0 || at.y < 0 || at.x >= gbuffer.width || at.y >= gbuffer.height) return false;
    if (at == pixel) continue;
    const std::size_t seen =
        static_cast<std::size_t>(gbuffer.height - 1 - at.y) * static_cast<std::size_t>(gbuffer.width) +
        static_cast<std::size_t>(at.x);
    if (!gbuffer.is_surface(seen)) continue;
    const auto above = static_cast<float>(dot_of(normal, dvec3(gbuffer.position[seen]) - position));
    if (shared::blocks_march(sample.z, gbuffer.depth[seen], settings) &&
        shared::is_before_plane(above, sample.z, settings)) {
      return true;
    }
  }
  return false;
}

}  // namespace

Image<float> march_depth_buffer(const GBuffer& gbuffer, const View& view, const Light& light,
                                const ScreenSpace& technique) {
  const dmat4 from_world = view_from_world(view);
  const dmat4 to_clip = clip_from_view(view) * from_world;
  const ivec2 size(gbuffer.width, gbuffer.height);
  const int is_orthographic = std::holds_alternative<OrthographicProjection>(view.camera.projection) ? 1 : 0;
  const dvec4 source = homogeneous_position(light);
  Image<float> visibility(gbuffer.width, gbuffer.height, 1.0f);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    visibility[i] = 0.0f;
    const dvec3 position(gbuffer.position[i]);
    const dvec3 towards = to_light(light, position);
    if (glm::dot(dvec3(gbuffer.geometric_normal[i]), towards) <= 0.0) continue;
    double reach = static_cast<double>(technique.march.reach);
    if (source.w != 0.0) reach = std::min(reach, glm::length(dvec3(source) - position));
    const dvec3 start = shared::on_screen(from_world, to_clip, size, position);
    const double approach = (from_world * dvec4(towards, 0.0)).z;
    if (is_orthographic == 0) reach = shared::length_before_camera(reach, start.z, approach);
    const dvec3 end = shared::on_screen(from_world, to_clip, size, position + reach * towards);
    const ivec2 pixel(static_cast<int>(i) % gbuffer.width, gbuffer.height - 1 - static_cast<int>(i) / gbuffer.width);
    const shared::March march = shared::make_march(start, end, is_orthographic, pixel, technique.march);
    if (!is_blocked(gbuffer, march, i, pixel, is_orthographic, technique.march)) visibility[i] = 1.0f;
  }
  return visibility;
}

}  // namespace umbrameter
