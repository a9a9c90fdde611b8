// An alpha mask against the same bars as geometry, drawn.
#include <variant>

#include "techniques/shadow/reference/lookup.h"
#include "test_scenes.h"
#include "tests/support/fence_twins.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;
using test::compare_coverage;
using test::expect_same_coverage;
using test::fence_point;
using test::FencePoint;
using test::FenceTwins;
using test::TwinCount;

class DrawnFence : public GlTest {
 protected:
  const FenceTwins twins_ = test::fence_twins();
};

// The ray that a texel's centre stands for.
Ray world_ray(const MapLayout& layout, int face, int x, int y) {
  const dmat4 world_from_light = glm::inverse(layout.light_from_world);
  const TexelRay ray = texel_ray(layout, {x, layout.resolution - 1 - y}, face);
  return {dvec3(world_from_light * dvec4(ray.origin, 1.0)),
          glm::normalize(dvec3(world_from_light * dvec4(ray.direction, 0.0)))};
}

TEST_F(DrawnFence, The_mask_and_its_geometric_twin_have_the_same_shadow_map_off_the_mask_s_edges) {
  // Vertices snap to 1/256 of a texel of the map, which are up to three texels of the mask where it is drawn.
  constexpr double margin = 0.02;
  const UploadedScene masked = upload(context(), twins_.masked), solid = upload(context(), twins_.solid);
  const Bounds bounds = bounds_of(twins_.masked);
  for (const Light& light : twins_.masked.lights) {
    const int resolution = std::holds_alternative<PointLight>(light.shape) ? 1024 : 2048;
    const MapLayout layout = fit_light(light, bounds, resolution);
    const ShadowMapImages a = read_back(context(), draw_shadow_map(context(), masked, light, layout));
    const ShadowMapImages b = read_back(context(), draw_shadow_map(context(), solid, light, layout));
    TwinCount count;
    for (int face = 0; face < static_cast<int>(a.depth.size()); ++face) {
      const auto layer = static_cast<std::size_t>(face);
      for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x) {
          const Ray ray = world_ray(layout, face, x, y);
          const FencePoint where = fence_point(twins_, ray.origin, ray.direction, margin);
          const std::uint32_t id = a.instance[layer].at(x, y);
          // 32-bit depth resolves 6e-8 of far_depth; the two are interpolated over different triangles.
          const bool same =
              id == b.instance[layer].at(x, y) &&
              (id == no_id || std::abs(a.depth[layer].at(x, y) - b.depth[layer].at(x, y)) < 4e-6 * layout.far_depth);
          if (where == FencePoint::edge) {
            ++count.edges;
            count.different_on_edges += same ? 0 : 1;
            continue;
          }
          count.different += same ? 0 : 1;
          count.bars += where == FencePoint::bar && id == twins_.instance ? 1 : 0;
          count.open += where == FencePoint::open && id != twins_.instance ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(count.different, 0) << light.name;
    EXPECT_GT(count.bars, 3000) << light.name;
    EXPECT_GT(count.open, 6000) << light.name;
    EXPECT_LT(count.edges, (count.bars + count.open) / 4) << light.name;
    RecordProperty(light.name + ", differ on edges", count.different_on_edges);
  }
}

TEST_F(DrawnFence, The_mask_and_its_geometric_twin_cover_the_same_pixels_off_the_mask_s_edges) {
  constexpr double margin = 0.02;
  const UploadedScene masked = upload(context(), twins_.masked), solid = upload(context(), twins_.solid);
  for (const Camera& camera : twins_.masked.cameras) {
    const View view{960, 540, camera};
    const GBuffer a = read_back(context(), draw_gbuffer(context(), masked, view));
    const GBuffer b = read_back(context(), draw_gbuffer(context(), solid, view));
    // Vertices snap to 1/256 of a pixel, 0.06 mm here: a centre may go to the piece beside its own, and onto it.
    const TwinCount count = compare_coverage(twins_, view, a, b, margin, 1e-4f);
    expect_same_coverage(count, camera.name);
    RecordProperty(camera.name + ", differ on edges", count.different_on_edges);
  }
}

}  // namespace
}  // namespace umbrameter
