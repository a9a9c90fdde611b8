// An alpha mask against the same bars as geometry, traced.
#include <gtest/gtest.h>

#include "raytrace/tracer.h"
#include "scenes/light.h"
#include "scenes/view.h"
#include "tests/support/fence_twins.h"

namespace umbrameter {
namespace {

using test::compare_coverage;
using test::expect_same_coverage;
using test::fence_point;
using test::FencePoint;
using test::FenceTwins;
using test::TwinCount;

// Hit distances are single precision: micrometres at these lengths, ten thousandths of a texel.
constexpr double margin = 0.01;

class TracedFence : public testing::Test {
 protected:
  const FenceTwins twins_ = test::fence_twins();
  const Tracer masked_{twins_.masked};
  const Tracer solid_{twins_.solid};
};

TEST_F(TracedFence, The_mask_and_its_geometric_twin_cover_the_same_pixels_off_the_mask_s_edges) {
  for (const Camera& camera : twins_.masked.cameras) {
    const View view{960, 540, camera};
    const GBuffer a = trace_gbuffer(masked_, view);
    const GBuffer b = trace_gbuffer(solid_, view);
    const TwinCount count = compare_coverage(twins_, view, a, b, margin, 1e-5f);
    expect_same_coverage(count, camera.name);
    RecordProperty(camera.name + ", differ on edges", count.different_on_edges);
  }
}

TEST_F(TracedFence, The_mask_and_its_geometric_twin_cast_the_same_shadow_off_the_mask_s_edges) {
  const View view{960, 540, twins_.masked.cameras.front()};
  // The surfels are the same for both, and none of them lies on the fence.
  GBuffer gbuffer = trace_gbuffer(masked_, view);
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (gbuffer.instance[i] == twins_.instance) gbuffer.instance[i] = gbuffer.triangle[i] = no_id;
  }
  for (const Light& light : twins_.masked.lights) {
    const Image<float> a = trace_visibility(masked_, gbuffer, light).visibility;
    const Image<float> b = trace_visibility(solid_, gbuffer, light).visibility;
    TwinCount count;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!gbuffer.is_surface(i)) continue;
      const dvec3 point(gbuffer.position[i]);
      const double reach = std::holds_alternative<DirectionalLight>(light.shape)
                               ? std::numeric_limits<double>::infinity()
                               : glm::length(light.position() - point);
      const FencePoint where = fence_point(twins_, point, to_light(light, point), margin, reach);
      if (where == FencePoint::edge) {
        ++count.edges;
        count.different_on_edges += a[i] != b[i] ? 1 : 0;
        continue;
      }
      count.different += a[i] != b[i] ? 1 : 0;
      count.bars += where == FencePoint::bar && a[i] == 0.0f ? 1 : 0;
      count.open += where == FencePoint::open && a[i] == 1.0f ? 1 : 0;
    }
    EXPECT_EQ(count.different, 0) << light.name;
    EXPECT_GT(count.bars, 3000) << light.name;
    EXPECT_GT(count.open, 3000) << light.name;
    EXPECT_LT(count.edges, (count.bars + count.open) / 4) << light.name;
    RecordProperty(light.name + ", differ on edges", count.different_on_edges);
  }
}

}  // namespace
}  // namespace umbrameter
