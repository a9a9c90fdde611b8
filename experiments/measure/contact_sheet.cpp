#include "experiments/measure/contact_sheet.h"

#include <algorithm>

#include "compare/metrics/color_space.h"
#include "core/error.h"
#include "raytrace/tracer.h"
#include "reports/figures/figures.h"
#include "scenes/shading.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

constexpr int samples_a_side = 3;
constexpr int ao_rays = 16;  // a sample: 144 a pixel
constexpr double ao_reach = 0.25;
constexpr double mean_luminance = 0.3;
constexpr double white_share = 0.02;
constexpr std::uint32_t seed = 1;
// Shares of the work, for the progress bar.
constexpr double hits_share = 0.1;
constexpr double shadows_share = 0.3;

double quantile(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median_depth(const GBuffer& gbuffer) {
  std::vector<float> depths;
  for (std::size_t i = 0; i < gbuffer.depth.size(); ++i) {
    if (gbuffer.is_surface(i)) depths.push_back(gbuffer.depth[i]);
  }
  return depths.empty() ? 0.0 : quantile(depths, 0.5);
}

double exposure_of(const GBuffer& gbuffer, const Image<vec3>& picture) {
  std::vector<float> luminances;
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    luminances.push_back(static_cast<float>(luminance(picture[i])));
    sum += luminances.back();
  }
  if (!(sum > 0.0)) return 1.0;
  const double mean = sum / static_cast<double>(luminances.size());
  return std::min(mean_luminance / mean, 1.0 / quantile(luminances, 1.0 - white_share));
}

// Paper-like, a little darker towards the top, so that the edge of what is seen shows.
vec3 background(double height) { return vec3(static_cast<float>(glm::mix(0.86, 0.72, height))); }

Image<vec3> exposed(const GBuffer& gbuffer, Image<vec3> picture) {
  const auto exposure = static_cast<float>(exposure_of(gbuffer, picture));
  for (int y = 0; y < picture.height; ++y) {
    const vec3 behind = background(1.0 - (y + 0.5) / picture.height);
    for (int x = 0; x < picture.width; ++x) {
      vec3& pixel = picture.at(x, y);
      // Clipped before the average: a highlight must not eat the edge of what lies before it.
      pixel = gbuffer.is_surface(picture.index(x, y)) ? glm::min(pixel * exposure, vec3(1)) : behind;
    }
  }
  return picture;
}

Image<vec3> averaged(const Image<vec3>& fine) {
  Image<vec3> coarse(fine.width / samples_a_side, fine.height / samples_a_side, vec3(0));
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) coarse.at(x / samples_a_side, y / samples_a_side) += fine.at(x, y);
  }
  for (vec3& pixel : coarse.pixels) pixel /= static_cast<float>(samples_a_side * samples_a_side);
  return coarse;
}

// Whether there is more to see than one thing that fills the picture.
bool shows_something(const GBuffer& gbuffer) {
  const std::uint32_t first = gbuffer.instance[0];
  return std::ranges::any_of(gbuffer.instance.pixels, [&](std::uint32_t instance) { return instance != first; });
}

// Parallel cameras are for measuring. A scene whose cameras look at one plane is shown from the one that would be
// fitted to it.
GBuffer surfels_of(Scene& scene, const Tracer& tracer, Size size, const Progress& progress) {
  const Size fine{samples_a_side * size.width, samples_a_side * size.height};
  for (const Camera& camera : scene.cameras) {
    if (!std::holds_alternative<PerspectiveProjection>(camera.projection)) continue;
    GBuffer gbuffer = trace_gbuffer(tracer, {fine.width, fine.height, camera}, progress);
    if (shows_something(gbuffer)) return gbuffer;
  }
  scene.cameras.clear();
  std::vector<std::string> assumed;
  const double aspect = static_cast<double>(size.width) / size.height;
  return trace_gbuffer(tracer, {fine.width, fine.height, select_camera(scene, {}, aspect, assumed)}, progress);
}

// One sun and all lamps: further suns are there to be chosen instead of the first.
std::vector<const Light*> lights_of(const Scene& scene) {
  std::vector<const Light*> lights;
  bool has_sun = false;
  for (const Light& light : scene.lights) {
    const bool is_sun = std::holds_alternative<DirectionalLight>(light.shape);
    if (!is_sun || !has_sun) lights.push_back(&light);
    has_sun = has_sun || is_sun;
  }
  return lights;
}

Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [&whole, from, to](double share) { whole(from + (to - from) * share); };
}

}  // namespace

Image<glm::u8vec3> draw_tile(Scene scene, Size size, const Progress& progress) {
  std::vector<std::string> assumed;
  add_missing_light(scene, assumed);
  if (bounds_of(scene).empty()) throw Error(ExitCode::unreadable_input, scene.name, "the scene has no triangles");
  const Tracer tracer(scene);
  const GBuffer gbuffer = surfels_of(scene, tracer, size, part_of(progress, 0.0, hits_share));
  const std::vector<const Light*> lights = lights_of(scene);
  std::vector<TracedVisibility> shadows;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const double step = shadows_share / static_cast<double>(lights.size());
    const double from = hits_share + step * static_cast<double>(i);
    shadows.push_back(trace_visibility(tracer, gbuffer, *lights[i], {}, part_of(progress, from, from + step)));
  }
  std::vector<LitBy> lit;
  for (std::size_t i = 0; i < lights.size(); ++i) lit.push_back({lights[i], &shadows[i].visibility});
  TruthParams occlusion;
  occlusion.spp = ao_rays;
  occlusion.ao_distance = ao_reach * median_depth(gbuffer);
  const TracedAo ao = trace_ao(tracer, gbuffer, occlusion, seed, part_of(progress, hits_share + shadows_share, 1.0));
  return tone_map(averaged(exposed(gbuffer, shade(gbuffer, lit, &ao.ao))), 1.0f);
}

}  // namespace umbrameter
