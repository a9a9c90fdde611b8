#include "ao_invariants.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace umbrameter {
namespace {

constexpr double degree = pi / 180.0;

Scene endless_plane() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 4000}, {3500, 0, -2000}, {-3500, 0, -2000}};
  mesh.triangles = {{0, 1, 2}};
  scene.materials.push_back({});
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({"plane"});
  scene.instances.push_back({0, 0, dmat4(1.0)});
  return scene;
}

constexpr double plane_distance = 3.0;
const double vertical_fov = 2.0 * std::atan(std::tan(25.0 * degree) / 3.0);

View plane_view(double angle, int height) {
  const double a = angle * degree;
  View view{3 * height, height, {}};
  view.camera.world_from_camera =
      dmat4(dvec4(1, 0, 0, 0), dvec4(0, std::sin(a), -std::cos(a), 0), dvec4(0, std::cos(a), std::sin(a), 0),
            dvec4(0, plane_distance * std::cos(a), plane_distance * std::sin(a), 1));
  view.camera.projection = PerspectiveProjection{vertical_fov};
  return view;
}

struct Seen {
  GBuffer surfels;
  Image<double> mean;   // over the seeds
  Image<double> noise;  // variance
};

Seen see(const gl::Context& context, const UploadedScene& scene, const View& view, const AoParams& params, int seeds) {
  const GpuGBuffer gbuffer = draw_gbuffer(context, scene, view);
  Seen seen{read_back(context, gbuffer), Image<double>(view.width, view.height, 0.0),
            Image<double>(view.width, view.height, 0.0)};
  for (int seed = 1; seed <= seeds; ++seed) {
    const Image<float> ao = draw_ao(context, gbuffer, view, params, static_cast<std::uint32_t>(seed));
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double value = static_cast<double>(ao[i]);
      seen.mean[i] += value / seeds;
      seen.noise[i] += value * value / seeds;
    }
  }
  for (std::size_t i = 0; i < seen.mean.size(); ++i) {
    seen.noise[i] = std::max(0.0, seen.noise[i] - seen.mean[i] * seen.mean[i]) * seeds / std::max(1, seeds - 1);
  }
  return seen;
}

View rotated(const View& view) {
  View other{view.height, view.width, view.camera};
  dmat4& from_camera = other.camera.world_from_camera;
  const dvec4 right = from_camera[0];
  from_camera[0] = from_camera[1];
  from_camera[1] = -right;
  auto& projection = std::get<PerspectiveProjection>(other.camera.projection);
  projection.vertical_fov = 2.0 * std::atan(std::tan(0.5 * projection.vertical_fov) * view.width / view.height);
  return other;
}

class MeanSquare {
 public:
  void add(double square) {
    sum_ += square;
    ++count_;
  }
  double root() const { return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : 0.0; }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

double radius_in_pixels(const AoParams& params, int height) {
  return params.sampling.radius.number / plane_distance * 0.5 * height / std::tan(0.5 * vertical_fov);
}

Darkening open_plane_darkening(const gl::Context& context, const AoParams& params, const PlanePlace& place) {
  const View view = plane_view(place.angle, place.height);
  const UploadedScene scene = upload(context, endless_plane());
  const Seen seen = see(context, scene, view, params, place.seeds);
  const int half = place.height / 10;
  const int center = place.is_at_edge ? view.width - half : view.width / 2;
  Darkening darkening;
  double count = 0.0;
  for (int y = view.height / 2 - half; y < view.height / 2 + half; ++y) {
    for (int x = center - half; x < center + half; ++x) {
      const std::size_t i = seen.mean.index(x, y);
      if (!seen.surfels.is_surface(i)) continue;
      darkening.mean += 1.0 - seen.mean[i];
      darkening.worst = std::max(darkening.worst, 1.0 - seen.mean[i]);
      count += 1.0;
    }
  }
  if (count > 0.0) darkening.mean /= count;
  return darkening;
}

AoVariation measure_variation(const gl::Context& context, const UploadedScene& scene, const View& view,
                              const AoParams& params, int seeds) {
  const Seen full = see(context, scene, view, params, seeds);
  const Seen turned = see(context, scene, rotated(view), params, seeds);
  View half_view = view;
  half_view.width /= 2;
  half_view.height /= 2;
  const Seen half = see(context, scene, half_view, params, seeds);
  MeanSquare rotation, resolution, noise;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::size_t i = full.mean.index(x, y);
      const std::size_t j = turned.mean.index(view.height - 1 - y, x);
      if (!full.surfels.is_surface(i) || !turned.surfels.is_surface(j)) continue;
      rotation.add(std::pow(full.mean[i] - turned.mean[j], 2));
      noise.add(full.noise[i]);
    }
  }
  for (int y = 0; y < half_view.height; ++y) {
    for (int x = 0; x < half_view.width; ++x) {
      double sum = 0.0;
      bool is_surface = half.surfels.is_surface(half.mean.index(x, y));
      for (const int k : {0, 1, 2, 3}) {
        const std::size_t i = full.mean.index(2 * x + k % 2, 2 * y + k / 2);
        is_surface = is_surface && full.surfels.is_surface(i);
        sum += 0.25 * full.mean[i];
      }
      if (is_surface) resolution.add(std::pow(half.mean.at(x, y) - sum, 2));
    }
  }
  return {rotation.root(), resolution.root(), noise.root()};
}

double measure_period(const gl::Context& context, const UploadedScene& scene, const View& view, const AoParams& params,
                      int seeds) {
  const Seen mean = see(context, scene, view, params, seeds);
  const int tile = params.noise.size;
  const GpuGBuffer gbuffer = draw_gbuffer(context, scene, view);
  double covariance = 0.0;
  double count = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Image<float> ao = draw_ao(context, gbuffer, view, params, static_cast<std::uint32_t>(seed));
    // Less the mean of the tile about the pixel: a seed that darkens evenly shows no pattern.
    Image<double> pattern(view.width, view.height, 0.0);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        double sum = 0.0;
        double pixels = 0.0;
        for (int v = std::max(0, y - tile / 2); v < std::min(view.height, y - tile / 2 + tile); ++v) {
          for (int u = std::max(0, x - tile / 2); u < std::min(view.width, x - tile / 2 + tile); ++u) {
            const std::size_t j = ao.index(u, v);
            if (!mean.surfels.is_surface(j)) continue;
            sum += static_cast<double>(ao[j]) - mean.mean[j];
            pixels += 1.0;
          }
        }
        const std::size_t i = ao.index(x, y);
        if (mean.surfels.is_surface(i)) pattern[i] = static_cast<double>(ao[i]) - mean.mean[i] - sum / pixels;
      }
    }
    for (int y = 0; y + tile < view.height; ++y) {
      for (int x = 0; x + tile < view.width; ++x) {
        const double here = pattern.at(x, y);
        if (!mean.surfels.is_surface(ao.index(x, y))) continue;
        covariance += 0.5 * here * (pattern.at(x + tile, y) + pattern.at(x, y + tile));
        count += 1.0;
      }
    }
  }
  // The mean over the seeds has their share of the variance.
  return std::sqrt(std::max(0.0, covariance / count) * seeds / std::max(1, seeds - 1));
}

std::vector<double> measure_changes(const gl::Context& context, const UploadedScene& scene, const View& view,
                                    const AoParams& params, int seeds, const std::vector<AoSetting>& settings) {
  const Seen before = see(context, scene, view, params, seeds);
  std::vector<double> changes;
  for (const AoSetting& setting : settings) {
    AoParams other = params;
    require(describe(other), setting.key).set_text(std::string(setting.value));
    const Seen after = see(context, scene, view, other, seeds);
    MeanSquare square;
    for (std::size_t i = 0; i < after.mean.size(); ++i) {
      if (after.surfels.is_surface(i)) square.add(std::pow(after.mean[i] - before.mean[i], 2));
    }
    changes.push_back(square.root());
  }
  return changes;
}

std::optional<BentNormalError> measure_bent_normals(const gl::Context& context, const GpuGBuffer& gbuffer,
                                                    const View& view, const AoParams& params, int seeds,
                                                    const Image<vec3>& reference) {
  const GBuffer surfels = read_back(context, gbuffer);
  const auto angle = [](const vec3& a, const vec3& b) {
    const dvec3 exact(a);
    return std::atan2(glm::length(glm::cross(exact, dvec3(b))), glm::dot(exact, dvec3(b))) / degree;
  };
  BentNormalError error;
  double count = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto bent = draw_bent_normals(context, gbuffer, view, params, static_cast<std::uint32_t>(seed));
    if (!bent) return {};
    for (std::size_t i = 0; i < bent->size(); ++i) {
      if (!surfels.is_surface(i) || (*bent)[i] == vec3(0) || reference[i] == vec3(0)) continue;
      error.method += angle((*bent)[i], reference[i]);
      error.normal += angle(surfels.geometric_normal[i], reference[i]);
      count += 1.0;
    }
  }
  return BentNormalError{error.method / count, error.normal / count};
}

}  // namespace umbrameter
