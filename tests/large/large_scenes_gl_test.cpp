// Scenes of many instances, many triangles and buffers beyond 128 MiB: both sides still see the same triangles.
#include <set>

#include "raytrace/tracer.h"
#include "tests/raster/test_scenes.h"

namespace umbrameter::testing_scenes {
namespace {

using LargeScenesGl = GlTest;

bool is_same(const GBuffer& a, std::size_t i, const GBuffer& b, std::size_t j) {
  return a.instance[i] == b.instance[j] && a.triangle[i] == b.triangle[j];
}

// Whether the pixel and its eight neighbours see one triangle: far enough from edges for any rasteriser.
bool is_inner(const GBuffer& gbuffer, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= gbuffer.width || y + 1 >= gbuffer.height) return false;
  const std::size_t middle = gbuffer.instance.index(x, y);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!is_same(gbuffer, gbuffer.instance.index(x + dx, y + dy), gbuffer, middle)) return false;
    }
  }
  return true;
}

// Expects equal ids at inner pixels, and at least that many of them.
void expect_same_ids(const GBuffer& drawn, const GBuffer& traced, int least) {
  int inner = 0;
  int different = 0;
  for (int y = 0; y < drawn.height; ++y) {
    for (int x = 0; x < drawn.width; ++x) {
      if (!is_inner(drawn, x, y)) continue;
      const std::size_t i = drawn.instance.index(x, y);
      ++inner;
      if (!is_same(drawn, i, traced, i)) ++different;
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GE(inner, least);
}

TEST_F(LargeScenesGl, Instances_by_the_ten_thousand_draw_and_trace_the_same_ids) {
  // A square of 100 by 100 places, seen from above with 12 pixels a side for each; three meshes and mirrored ones take
  // turns, so that neighbours in the list are never drawn together.
  constexpr int side = 100;
  constexpr int pixels = 12;
  Scene scene;
  add_mesh(scene, box({0.1f, 0.0f, 0.1f}, {0.9f, 0.5f, 0.9f}));
  add_mesh(scene, quad({0.1f, 0, 0.9f}, {0.9f, 0, 0.9f}, {0.9f, 0, 0.1f}, {0.1f, 0, 0.1f}));
  Mesh roof = quad({0.1f, 0, 0.9f}, {0.9f, 0, 0.9f}, {0.9f, 0.3f, 0.1f}, {0.1f, 0.2f, 0.1f});
  roof.normals.assign(roof.positions.size(), vec3(0, 1, 0));
  add_mesh(scene, roof);
  const Instance first = scene.instances[0];
  scene.instances.clear();
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      Instance instance = first;
      const auto i = static_cast<std::uint32_t>(scene.instances.size());
      instance.mesh = i % 3;
      const bool is_flipped = i % 7 == 0;
      instance.world_from_mesh[0][0] = is_flipped ? -1.0 : 1.0;
      instance.world_from_mesh[3] = dvec4(column + (is_flipped ? 1 : 0), 0, row, 1);
      scene.instances.push_back(instance);
    }
  }
  const View view = orthographic_view(side * pixels, side * pixels, {50, 10, 50}, {50, 0, 50}, 50.0, {0, 0, -1});
  const UploadedScene uploaded = upload(context(), scene);
  EXPECT_EQ(uploaded.draws.size(), 6u);  // three meshes, each as it is and mirrored
  const GBuffer drawn = read_back(context(), draw_gbuffer(context(), uploaded, view));
  // The middle of a place lies on the diagonal of its quads; a quarter off it does not.
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const std::size_t i = drawn.instance.index(column * pixels + 5, row * pixels + 3);
      ASSERT_EQ(drawn.instance[i], static_cast<std::uint32_t>(row * side + column));
    }
  }
  const Tracer tracer(scene);
  expect_same_ids(drawn, trace_gbuffer(tracer, view), side * side * 20);

  // From the side, the light's map sees the same as it does from rays.
  const Light light = directional_light({0.3, 1.0, 0.2});
  const ShadowMap map = draw_shadow_map(context(), uploaded, light, fit_light(light, bounds_of(scene), 1024));
  ShadowParams params;
  params.bias.constant = 0.05;
  const GpuGBuffer surfels = upload(context(), drawn);
  const RasterVisibility raster =
      draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)});
  const TracedVisibility truth = trace_visibility(tracer, drawn, light);
  EXPECT_NEAR(mean(raster.visibility), mean(truth.visibility), 0.02);
}

TEST_F(LargeScenesGl, A_triangle_of_a_large_mesh_has_its_own_number_on_both_sides) {
  // 300 by 300 squares of two triangles, four pixels each: drivers split a draw of 180,000 triangles.
  constexpr std::uint32_t side = 300;
  constexpr int pixels = 4;
  Mesh sheet;
  for (std::uint32_t z = 0; z <= side; ++z) {
    for (std::uint32_t x = 0; x <= side; ++x) sheet.positions.emplace_back(x, 0, z);
  }
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = z * (side + 1) + x;
      sheet.triangles.emplace_back(a, a + side + 1, a + side + 2);
      sheet.triangles.emplace_back(a, a + side + 2, a + 1);
    }
  }
  Scene scene;
  const std::uint32_t placed = add_mesh(scene, sheet);
  Instance second = scene.instances[placed];
  second.world_from_mesh[3] = dvec4(side, 0, 0, 1);
  scene.instances.push_back(second);
  const View view = orthographic_view(2 * side * pixels, side * pixels, {side, 10, 0.5 * side}, {side, 0, 0.5 * side},
                                      0.5 * side, {0, 0, -1});
  const UploadedScene uploaded = upload(context(), scene);
  const GBuffer drawn = read_back(context(), draw_gbuffer(context(), uploaded, view));
  int wrong = 0;
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t x = 0; x < 2 * side; ++x) {
      // One pixel left and below of the diagonal, one right and above of it.
      const auto at = [&](int dx, int dz) {
        return drawn.instance.index(static_cast<int>(x) * pixels + dx, static_cast<int>(z) * pixels + dz);
      };
      const std::uint32_t expected = 2 * (z * side + x % side);
      const bool is_right = drawn.triangle[at(0, 2)] == expected && drawn.triangle[at(2, 0)] == expected + 1 &&
                            drawn.instance[at(0, 2)] == x / side && drawn.instance[at(2, 0)] == x / side;
      if (!is_right) ++wrong;
    }
  }
  EXPECT_EQ(wrong, 0);
  const GBuffer traced = trace_gbuffer(Tracer(scene), view);
  for (int y = 2; y < drawn.height; y += 4 * 7) {
    for (int x = 0; x < drawn.width; x += 4 * 5) {
      const std::size_t i = drawn.instance.index(x, y);
      ASSERT_TRUE(is_same(drawn, i, traced, i)) << x << ", " << y;
    }
  }
}

TEST_F(LargeScenesGl, Buffers_beyond_the_size_of_storage_buffers_are_read_to_their_end) {
  // OpenGL 4.5 promises storage buffers of 128 MiB (table 23.64), which is also what llvmpipe has: 11,184,810 times
  // three floats. The mesh that is drawn comes behind one of 11.5 million vertices, normals and triangles.
  constexpr std::size_t many = 11'500'000;
  static_assert(many * sizeof(vec3) > (std::size_t{1} << 27u));
  if (context().max_buffer_texels() < many + 6) GTEST_SKIP() << "this device has no buffer textures of that size";
  Scene scene;
  Mesh heap;
  heap.positions.assign(many, vec3(0));
  heap.normals.assign(many, vec3(1, 0, 0));
  heap.triangles.assign(many, uvec3(0));
  add_mesh(scene, std::move(heap));
  Mesh shown = quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
  const vec3 tilted = glm::normalize(vec3(0.0f, 0.8f, 0.6f));
  shown.normals.assign(shown.positions.size(), tilted);
  add_mesh(scene, shown);
  scene.instances.erase(scene.instances.begin());
  const UploadedScene uploaded = upload(context(), scene);
  const View view = orthographic_view(16, 16, {0, 5, 0}, {0, 0, 0}, 1.0, {0, 0, -1});
  const GBuffer gbuffer = read_back(context(), draw_gbuffer(context(), uploaded, view));
  std::set<std::uint32_t> triangles;
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    ASSERT_EQ(gbuffer.instance[i], 0u);
    triangles.insert(gbuffer.triangle[i]);
    ASSERT_EQ(gbuffer.position[i].y, 0.0f);
    ASSERT_EQ(gbuffer.geometric_normal[i], vec3(0, 1, 0));
    ASSERT_LT(glm::length(gbuffer.shading_normal[i] - tilted), 1e-6f);
  }
  EXPECT_EQ(triangles, (std::set<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace umbrameter::testing_scenes
