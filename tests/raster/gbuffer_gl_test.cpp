#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.h"
#include "core/random.h"
#include "scenes/material.h"
#include "scenes/view.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class GbufferGl : public GlTest {
 protected:
  GBuffer draw(const Scene& scene, const View& view) const {
    return read_back(context(), draw_gbuffer(context(), upload(context(), scene), view));
  }
};

// Intersection of a pixel's ray with the plane n·p = d, in double precision.
dvec3 on_plane(const View& view, int x, int y, const dvec3& n, double d) {
  const Ray ray = pixel_ray(view, x, y);
  return ray.origin + ray.direction * ((d - glm::dot(n, ray.origin)) / glm::dot(n, ray.direction));
}

void expect_near(const vec3& found, const dvec3& expected, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(static_cast<double>(found[i]), expected[i], tolerance);
}

TEST_F(GbufferGl, A_quad_gives_the_positions_normals_depths_and_ids_of_its_plane) {
  Scene scene;
  add_mesh(scene, box({20, 20, 20}, {21, 21, 21}));
  const std::uint32_t floor = add_mesh(scene, quad({-50, 0, 50}, {50, 0, 50}, {50, 0, -50}, {-50, 0, -50}));
  const View view = perspective_view(160, 90, {1, 5, 12}, {0, 0, 0});
  const GBuffer gbuffer = draw(scene, view);
  const dvec3 axis = glm::normalize(dvec3(0, 0, 0) - dvec3(1, 5, 12));
  int seen = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 160; ++x) {
      const std::size_t i = gbuffer.position.index(x, y);
      if (gbuffer.instance[i] != floor) continue;
      ++seen;
      const dvec3 expected = on_plane(view, x, y, {0, 1, 0}, 0);
      // Half a unit in the last place of a coordinate below 64, and nothing more.
      expect_near(gbuffer.position[i], expected, 2.0e-6);
      EXPECT_EQ(gbuffer.position[i].y, 0.0f);
      EXPECT_EQ(gbuffer.geometric_normal[i], vec3(0, 1, 0));
      EXPECT_EQ(gbuffer.shading_normal[i], vec3(0, 1, 0));
      EXPECT_NEAR(static_cast<double>(gbuffer.depth[i]), glm::dot(expected - dvec3(1, 5, 12), axis), 4e-6);
      // Triangle 0 is a b c: below the diagonal from (-50, 50) to (50, -50) in x, z.
      if (std::abs(expected.x + expected.z) > 0.1) {
        EXPECT_EQ(gbuffer.triangle[i], expected.x + expected.z > 0 ? 0u : 1u);
      }
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(seen, 8000);
}

TEST_F(GbufferGl, Row_zero_is_the_top_row) {
  Scene scene;
  add_mesh(scene, quad({-1, 0.25f, 0}, {-0.5f, 0.25f, 0}, {-0.5f, 0.75f, 0}, {-1, 0.75f, 0}));
  // One unit is 20 pixels; x from -2 to 2, y from -1 to 1.
  const GBuffer gbuffer = draw(scene, orthographic_view(80, 40, {0, 0, 5}, {0, 0, 0}, 1.0));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 80; ++x) {
      const bool is_covered = x >= 20 && x < 30 && y >= 5 && y < 15;
      ASSERT_EQ(gbuffer.is_surface(gbuffer.instance.index(x, y)), is_covered) << x << " " << y;
    }
  }
  EXPECT_NEAR(static_cast<double>(gbuffer.position.at(20, 5).x), -0.975, 1e-6);
  EXPECT_NEAR(static_cast<double>(gbuffer.position.at(20, 5).y), 0.725, 1e-6);
  EXPECT_EQ(gbuffer.depth.at(20, 5), 5.0f);
}

TEST_F(GbufferGl, Background_holds_no_id_and_zeros) {
  const GBuffer gbuffer = draw(Scene{}, perspective_view(8, 8, {0, 0, 5}, {0, 0, 0}));
  EXPECT_EQ(gbuffer, GBuffer(8, 8));
}

TEST_F(GbufferGl, Positions_far_from_the_origin_are_as_good_as_a_float_allows) {
  Scene scene;
  const dvec3 far_away(5000, 300, -7000);
  add_mesh(scene, quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}),
           glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, far_away.x, far_away.y, far_away.z, 1));
  const View view = perspective_view(64, 64, far_away + dvec3(0, 1, 0.3), far_away);
  const GBuffer gbuffer = draw(scene, view);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const std::size_t i = gbuffer.position.index(x, y);
      ASSERT_TRUE(gbuffer.is_surface(i));
      const dvec3 expected = on_plane(view, x, y, {0, 1, 0}, 300);
      ASSERT_EQ(gbuffer.position[i], vec3(expected)) << x << " " << y;
    }
  }
}

// Rasterisers snap vertices to 1/256 pixel, so that slivers cover pixels whose rays pass beside them.
TEST_F(GbufferGl, Surfels_of_slivers_lie_where_their_pixels_see_them) {
  constexpr int width = 160;
  constexpr int height = 90;
  const View view = perspective_view(width, height, {0, 0, 0}, {0, 0, -1});
  const auto at = [&](double x, double y, double depth) {
    const Ray corner = pixel_ray(view, 0, 0);
    const Ray right = pixel_ray(view, 1, 0);
    const Ray down = pixel_ray(view, 0, 1);
    const auto on_screen = [](const Ray& ray) { return ray.direction / -ray.direction.z; };
    const dvec3 direction = on_screen(corner) + (x - 0.5) * (on_screen(right) - on_screen(corner)) +
                            (y - 0.5) * (on_screen(down) - on_screen(corner));
    return direction * depth;
  };
  Mesh slivers;
  std::mt19937 random(7);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const dvec2 a(any(0, width), any(0, height));
    const dvec2 b(any(0, width), any(0, height));
    const dvec2 across = glm::normalize(dvec2(a.y - b.y, b.x - a.x));
    const dvec2 c = glm::mix(a, b, any(0, 1)) + any(-0.01, 0.01) * across;
    for (const dvec2& corner : {a, b, c}) slivers.positions.emplace_back(at(corner.x, corner.y, any(2, 20)));
    slivers.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  Scene scene;
  add_mesh(scene, std::move(slivers));
  scene.materials.front().double_sided = true;
  const GBuffer gbuffer = draw(scene, view);
  const dmat4 clip_from_world = clip_from_view(view) * view_from_world(view);
  int seen = 0;
  double farthest = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = gbuffer.position.index(x, y);
      if (!gbuffer.is_surface(i)) continue;
      ++seen;
      const dvec4 clip = clip_from_world * dvec4(dvec3(gbuffer.position[i]), 1.0);
      const dvec2 place(0.5 * width * (1.0 + clip.x / clip.w), 0.5 * height * (1.0 - clip.y / clip.w));
      farthest = std::max(farthest, glm::distance(place, dvec2(x + 0.5, y + 0.5)));
    }
  }
  EXPECT_GT(seen, 300);
  EXPECT_LT(farthest, 1.0 / 128.0) << "pixels";
}

TEST_F(GbufferGl, A_box_shows_its_faces_with_normals_to_the_viewer) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}));
  const GBuffer front = draw(scene, perspective_view(33, 33, {0, 0, 6}, {0, 0, 0}));
  EXPECT_EQ(front.geometric_normal.at(16, 16), vec3(0, 0, 1));
  EXPECT_NEAR(static_cast<double>(front.depth.at(16, 16)), 5.0, 1e-6);
  const GBuffer inside = draw(scene, perspective_view(33, 33, {0, 0, 0}, {0, 0, -1}));
  EXPECT_FALSE(inside.is_surface(inside.instance.index(16, 16))) << "back faces of a single-sided material are unseen";
  scene.materials[0].double_sided = true;
  const GBuffer lined = draw(scene, perspective_view(33, 33, {0, 0, 0}, {0, 0, -1}));
  EXPECT_EQ(lined.geometric_normal.at(16, 16), vec3(0, 0, 1));
}

TEST_F(GbufferGl, A_mirrored_instance_shows_its_front) {
  Scene scene;
  dmat4 mirror(1.0);
  mirror[0][0] = -2.0;
  mirror[3] = dvec4(3, 0, 0, 1);
  const std::uint32_t mesh_instance = add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}));
  scene.instances.push_back({0, 0, mirror});
  scene.instances.push_back({0, 0, dmat4(1.0)});
  ASSERT_EQ(mesh_instance, 0u);
  scene.instances[2].world_from_mesh[3] = dvec4(-6, 0, 0, 1);
  const View view = orthographic_view(101, 41, {0, 0, 6}, {0, 0, 0}, 4.0);
  const GBuffer gbuffer = draw(scene, view);
  int seen[3] = {};
  for (std::size_t i = 0; i < gbuffer.instance.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    ++seen[gbuffer.instance[i]];
    ASSERT_EQ(gbuffer.geometric_normal[i], vec3(0, 0, 1));
    ASSERT_EQ(gbuffer.position[i].z, 1.0f) << "a back face was drawn for instance " << gbuffer.instance[i];
  }
  // 0.195 m a pixel: 2 m are 10 rows; 4 m less the metre that the first box hides.
  EXPECT_GT(seen[0], 90);
  EXPECT_GT(seen[1], 140);
  EXPECT_GT(seen[2], 90);
}

TEST_F(GbufferGl, Shading_normals_are_interpolated_and_keep_to_the_viewers_side) {
  Scene scene;
  Mesh mesh = quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  // Tilted by 45 degrees to either side: halfway between them the normal is +z.
  const float s = std::numbers::sqrt2_v<float> / 2;
  mesh.normals = {{-s, 0, s}, {s, 0, s}, {s, 0, s}, {-s, 0, s}};
  add_mesh(scene, mesh);
  scene.materials[0].double_sided = true;
  dmat4 squeeze(1.0);
  squeeze[0][0] = 0.5;
  scene.instances[0].world_from_mesh = squeeze;
  for (const double side : {1.0, -1.0}) {
    const View view = orthographic_view(41, 41, {0, 0, 5 * side}, {0, 0, 0}, 1.0);
    const GBuffer gbuffer = draw(scene, view);
    for (const int x : {12, 20, 28}) {
      const std::size_t i = gbuffer.position.index(x, 20);
      ASSERT_TRUE(gbuffer.is_surface(i));
      // Mesh-space x is twice the world's; normals transform with the inverse transpose: (2 nx, nz).
      const double mesh_x = 2.0 * static_cast<double>(gbuffer.position[i].x);
      const dvec3 expected = glm::normalize(dvec3(2.0 * mesh_x, 0, 1)) * side;
      expect_near(gbuffer.shading_normal[i], expected, 1e-6);
    }
  }
}

TEST_F(GbufferGl, Alpha_masks_and_colours_equal_those_of_the_scene_under_every_wrap_mode) {
  Scene scene;
  Mesh mesh = quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  // Beyond 0 to 1 on both sides, so that wrapping counts.
  mesh.texcoords = {{-1.3f, 2.2f}, {1.9f, 2.2f}, {1.9f, -1.1f}, {-1.3f, -1.1f}};
  add_mesh(scene, mesh);
  Texture texture;
  texture.texels = Image<glm::u8vec4>(5, 3);
  for (std::size_t i = 0; i < texture.texels.size(); ++i) {
    const auto n = static_cast<unsigned>(i);
    texture.texels[i] =
        glm::u8vec4((n * 97 + 13) % 256, (n * 41 + 200) % 256, (n * 151 + 5) % 256, (n * 113 + 60) % 256);
  }
  scene.textures = {texture};
  scene.materials[0].base_color_texture = 0;
  scene.materials[0].base_color = vec4(0.5f, 1.0f, 0.25f, 0.9f);
  scene.materials[0].alpha_cutoff = 0.4f;
  scene.materials[0].metallic = 0.75f;
  scene.materials[0].roughness = 0.625f;
  scene.materials[0].specular_color = vec3(0.5f, 2.0f, 30.0f);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    scene.textures[0].wrap_u = wrap;
    scene.textures[0].wrap_v = wrap == Wrap::repeat ? Wrap::clamp_to_edge : Wrap::repeat;
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask}) {
      scene.materials[0].alpha_mode = mode;
      const GBuffer gbuffer = draw(scene, orthographic_view(128, 128, {0, 0, 5}, {0, 0, 0}, 1.0));
      int holes = 0;
      for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
          const std::size_t i = gbuffer.position.index(x, y);
          const vec2 texcoord(-1.3 + 3.2 * (x + 0.5) / 128, -1.1 + 3.3 * (y + 0.5) / 128);
          const float alpha = alpha_at(scene, scene.materials[0], texcoord);
          if (std::abs(alpha - 0.4f) < 1e-4f) continue;
          const bool exists = mode == AlphaMode::opaque || alpha >= 0.4f;
          ASSERT_EQ(gbuffer.is_surface(i), exists) << x << " " << y << " alpha " << alpha;
          if (!exists) {
            ++holes;
            continue;
          }
          const SurfaceMaterial expected = surface_material_at(scene, scene.materials[0], texcoord);
          for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(gbuffer.albedo[i][c], expected.base_color[c], 2e-4f) << x << " " << y;
            ASSERT_NEAR(gbuffer.specular[i][c], expected.specular[c], 2e-4f) << x << " " << y;
          }
          ASSERT_NEAR(gbuffer.metallic[i], expected.metallic, 2e-4f);
          ASSERT_NEAR(gbuffer.specular[i].w, expected.roughness, 2e-4f);
        }
      }
      EXPECT_EQ(holes > 1000, mode == AlphaMode::mask);
    }
  }
}

TEST_F(GbufferGl, Each_texture_of_a_material_is_sampled_with_its_wrap_modes_without_a_base_color_texture) {
  Scene scene;
  Mesh mesh = quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
  mesh.texcoords = {{-1.3f, 2.2f}, {1.9f, 2.2f}, {1.9f, -1.1f}, {-1.3f, -1.1f}};
  add_mesh(scene, mesh);
  Material& material = scene.materials[0];
  material.metallic = 0.75f;
  material.specular_color = vec3(8.0f, 16.0f, 4.0f);
  const std::array<Wrap, 3> wraps{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
  for (std::size_t t = 0; t < 3; ++t) {
    Texture texture;
    texture.texels = Image<glm::u8vec4>(4 + static_cast<int>(t), 3);
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
      for (int c = 0; c < 4; ++c)
        texture.texels[i][c] = static_cast<std::uint8_t>(
            hash(static_cast<std::uint32_t>(4 * i) + static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(t)));
    }
    texture.wrap_u = wraps[t];
    texture.wrap_v = wraps[(t + 1) % 3];
    scene.textures.push_back(texture);
    material.*texture_members[t + 1] = static_cast<std::uint32_t>(t);
  }
  const GBuffer gbuffer = draw(scene, orthographic_view(128, 128, {0, 0, 5}, {0, 0, 0}, 1.0));
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const std::size_t i = gbuffer.position.index(x, y);
      const vec2 texcoord(-1.3 + 3.2 * (x + 0.5) / 128, -1.1 + 3.3 * (y + 0.5) / 128);
      const SurfaceMaterial expected = surface_material_at(scene, material, texcoord);
      ASSERT_NEAR(gbuffer.metallic[i], expected.metallic, 2e-4f) << x << " " << y;
      const vec4 specular(expected.specular, expected.roughness);
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(gbuffer.specular[i][c], specular[c], 2e-4f) << x << " " << y << " " << c;
    }
  }
}

TEST_F(GbufferGl, Upload_and_read_back_are_exact_copies) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}));
  scene.materials[0].metallic = 0.25f;
  const GBuffer drawn = draw(scene, perspective_view(61, 37, {2, 3, 4}, {0, 0, 0}));
  EXPECT_EQ(read_back(context(), upload(context(), drawn)), drawn);
}

TEST_F(GbufferGl, A_view_larger_than_the_device_allows_is_an_error_that_names_the_size) {
  const UploadedScene empty = upload(context(), Scene{});
  try {
    draw_gbuffer(context(), empty, perspective_view(context().max_texture_size() + 1, 4, {0, 0, 5}, {0, 0, 0}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("view.size"), std::string::npos);
  }
}

}  // namespace
}  // namespace umbrameter
