// Every construct of glTF, drawn and traced: both sides see the same surfaces, from a camera and from a light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/rasterizer.h"
#include "raytrace/tracer.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/gltf_constructs.h"
#include "tests/support/reference_caster.h"
#include "tests/support/shadow_depths.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter::test {
namespace {

/// 1 where a surface is seen.
Image<float> coverage_of(const Image<std::uint32_t>& instances) {
  Image<float> coverage(instances.width, instances.height, 0.0f);
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i] = instances[i] == no_id ? 0.0f : 1.0f;
  return coverage;
}

double mean(const Image<float>& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.size());
}

/// How two coverages compare in pixels that are away from the edges of both: all neighbours are alike.
struct SideAgreement {
  int compared = 0;
  int different = 0;
};
SideAgreement compare(const Image<float>& drawn, const Image<float>& traced) {
  const Image<std::uint8_t> drawn_edges = near_edges(drawn);
  const Image<std::uint8_t> traced_edges = near_edges(traced);
  SideAgreement agreement;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn_edges[i] != 0 || traced_edges[i] != 0) continue;
    ++agreement.compared;
    if (drawn[i] != traced[i]) ++agreement.different;
  }
  return agreement;
}

// Rasterisers interpolate texture coordinates with less precision, and a value may change by 1 from texel to texel.
bool is_same_material(const GBuffer& drawn, const GBuffer& traced, std::size_t i) {
  constexpr float tolerance = 1e-3f;
  const vec4 specular = glm::abs(drawn.specular[i] - traced.specular[i]);
  return glm::distance(drawn.albedo[i], traced.albedo[i]) < tolerance &&
         std::abs(drawn.metallic[i] - traced.metallic[i]) < tolerance &&
         std::max({specular.x, specular.y, specular.z, specular.w}) < tolerance;
}

class ConstructsGl : public GlFixture {
 protected:
  /// Every construct that can be loaded.
  template <class Check>
  void for_each_scene(const Check& check) const {
    for (const Construct& construct : all_constructs()) {
      if (!construct.refused.empty()) continue;
      SCOPED_TRACE(construct.name);
      const TemporaryFolder folder;
      Scene scene = load(construct, folder.path());
      scene.cameras.clear();
      check(construct, scene);
    }
  }
};

bool is_hidden_whole(const Construct& construct) { return construct.name == "a mask that hides all"; }

TEST_F(ConstructsGl, Drawn_and_traced_surfels_cover_the_same_pixels_away_from_edges) {
  for_each_scene([&](const Construct& construct, const Scene& scene) {
    std::vector<std::string> notes;
    const View view{192, 144, select_camera(scene, "", 192.0 / 144.0, notes)};
    const GBuffer drawn = read_back(context(), draw_gbuffer(context(), upload(context(), scene), view));
    const GBuffer traced = trace_gbuffer(Tracer(scene), view);
    const Image<float> coverage = coverage_of(drawn.instance);
    const SideAgreement agreement = compare(coverage, coverage_of(traced.instance));
    EXPECT_EQ(agreement.different, 0);
    EXPECT_GT(agreement.compared, 192 * 144 / 2);
    if (is_hidden_whole(construct)) {
      EXPECT_EQ(mean(coverage), 0.0);
    } else {
      EXPECT_GT(mean(coverage), 0.01);
    }
    int elsewhere = 0;
    int made_otherwise = 0;
    for (std::size_t i = 0; i < drawn.instance.size(); ++i) {
      const bool is_common = drawn.is_surface(i) && traced.is_surface(i) && drawn.triangle[i] == traced.triangle[i] &&
                             drawn.instance[i] == traced.instance[i];
      if (is_common && glm::distance(drawn.position[i], traced.position[i]) > 1e-4f) ++elsewhere;
      if (is_common && !is_same_material(drawn, traced, i)) ++made_otherwise;
    }
    EXPECT_EQ(elsewhere, 0);
    EXPECT_EQ(made_otherwise, 0);
  });
}

// The light's map against rays from a camera that stands where the light's map is laid out.
TEST_F(ConstructsGl, A_shadow_map_and_rays_along_the_light_meet_the_same_surfaces_away_from_edges) {
  constexpr int side = 160;
  const Light light = shapes::directional({0.4, 1.0, 0.8});
  for_each_scene([&](const Construct& construct, Scene scene) {
    const MapLayout frame = fit_light(light, bounds_of(scene), side);
    const ShadowMapImages map =
        read_back(context(), draw_shadow_map(context(), upload(context(), scene), light, frame));
    // Shadows are cast by both faces.
    for (Material& material : scene.materials) material.double_sided = true;
    View view{side, side, {}};
    view.camera.world_from_camera = glm::inverse(frame.light_from_world);
    view.camera.projection =
        OrthographicProjection{frame.views.front().half_extent, frame.views.front().half_extent, 0.0, frame.far_depth};
    const GBuffer traced = trace_gbuffer(Tracer(scene), view);
    const std::vector<Image<float>> depths = to_metres(map, frame);
    const Image<float> coverage = coverage_of(map.instance[0]);
    const SideAgreement agreement = compare(coverage, coverage_of(traced.instance));
    EXPECT_EQ(agreement.different, 0);
    EXPECT_GT(agreement.compared, side * side / 2);
    if (!is_hidden_whole(construct)) {
      EXPECT_GT(mean(coverage), 0.01);
    }
    int elsewhere = 0;
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      const bool is_common =
          traced.is_surface(i) && map.triangle[0][i] == traced.triangle[i] && map.instance[0][i] == traced.instance[i];
      if (!is_common) continue;
      // Rasterisers snap vertices to 1/256 texel: a slope's depth moves by up to 1/512 texel along both axes.
      const double cosine = std::abs(glm::dot(dvec3(traced.geometric_normal[i]), light.axis()));
      const double slope = std::sqrt(1.0 - std::min(cosine * cosine, 1.0)) / std::max(cosine, 1e-9);
      const double snapped = std::sqrt(2.0) / 512.0 * slope * 2.0 * frame.views.front().half_extent / side;
      if (std::abs(depths[0][i] - traced.depth[i]) > 1e-4 * frame.far_depth + snapped) ++elsewhere;
    }
    EXPECT_EQ(elsewhere, 0);
  });
}

}  // namespace
}  // namespace umbrameter::test
