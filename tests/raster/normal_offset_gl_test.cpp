// Normal offsets of receivers and casters. On a plane at the angle θ to the light, a shift of s metres along the normal
// acts as a bias of s / cos θ along the light; the part of s across the light alone, as s sin θ tan θ. Nearest taps of
// texels of the side t have critical biases spread evenly over ±½ t tan θ, if the texels run along the slope, so that a
// bias b lights the share ½ + b / (t tan θ) of the plane.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "map_depth_cases.h"
#include "test_scenes.h"
#include "tests/support/shadow_depths.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

constexpr double texel = 0.02;
constexpr OffsetProfile profiles[] = {OffsetProfile::sine, OffsetProfile::constant, OffsetProfile::one_minus_cosine,
                                      OffsetProfile::eevee};

double scale_of(OffsetProfile profile, double theta) {
  return profile == OffsetProfile::sine       ? std::sin(theta)
         : profile == OffsetProfile::constant ? 1.0
         : profile == OffsetProfile::eevee    ? std::sin(theta) + 0.195 * std::cos(0.534)
                                              : 1.0 - std::cos(theta);
}

// In metres: in texels, in metres, or half in each.
std::vector<NormalOffset> offsets_of(double metres, OffsetProfile profile) {
  return {{metres / texel, 0.0, profile}, {0.0, metres, profile}, {0.5 * metres / texel, 0.5 * metres, profile}};
}

class NormalOffsetGl : public MapDepthGl {
 protected:
  // Of a plane through the origin.
  double lit_share(double theta, const Scene& scene, const ShadowParams& params) const {
    const MapLayout layout = exact_layout({std::sin(theta), std::cos(theta), 0}, 256, texel, 0.0);
    const Light light = light_of(layout);
    const UploadedScene uploaded = upload(context(), scene);
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout, params.map_depth);
    const GpuGBuffer surfels = upload(context(), surfels_on_ground(256, 256, -1.2, 1.2, -1.2, 1.2));
    return mean(
        draw_visibility(context(), {uploaded, surfels, map, light, params.bias, make_technique(params)}).visibility);
  }
};

ShadowParams without_bias() {
  ShadowParams params;
  params.bias.constant = 0.0;
  return params;
}

Scene plane() {
  Scene scene;
  add_mesh(scene, ground(30.0f));
  return scene;
}

TEST_F(NormalOffsetGl, A_receiver_moves_by_its_profile_along_the_normal_or_across_the_light) {
  for (const double theta : {0.5, 0.9, 1.2}) {
    const double half_range = 0.5 * texel * std::tan(theta);
    for (const OffsetProfile profile : profiles) {
      for (const OffsetDirection direction : {OffsetDirection::normal, OffsetDirection::across}) {
        const double per_metre =
            scale_of(profile, theta) *
            (direction == OffsetDirection::normal ? 1.0 / std::cos(theta) : std::sin(theta) * std::tan(theta));
        for (const double lit : {0.3, 0.75}) {
          for (const NormalOffset& offset : offsets_of((2.0 * lit - 1.0) * half_range / per_metre, profile)) {
            ShadowParams params = without_bias();
            params.bias.normal_offset = offset;
            params.bias.offset_direction = direction;
            EXPECT_NEAR(lit_share(theta, plane(), params), lit, 5e-3)
                << theta << " " << static_cast<int>(profile) << static_cast<int>(direction);
          }
        }
      }
    }
  }
}

// A plane that is seen and lit from its back, once by its winding and once by a mirrored instance.
TEST_F(NormalOffsetGl, The_normal_of_the_front_moves_the_receiver_of_a_back_face_into_its_surface) {
  Mesh turned = ground(30.0f);
  for (uvec3& triangle : turned.triangles) std::swap(triangle.y, triangle.z);
  Scene from_behind;
  add_mesh(from_behind, turned);
  Scene mirrored_from_behind;
  add_mesh(mirrored_from_behind, turned, glm::scale(dmat4(1.0), dvec3(-1, 1, 1)));
  Scene mirrored;
  add_mesh(mirrored, ground(30.0f), glm::scale(dmat4(1.0), dvec3(-1, 1, 1)));
  constexpr double theta = 0.9;
  for (const OffsetProfile profile : {OffsetProfile::sine, OffsetProfile::constant, OffsetProfile::one_minus_cosine}) {
    for (const OffsetDirection direction : {OffsetDirection::normal, OffsetDirection::across}) {
      const auto lit = [&](const Scene& scene, OffsetFacing facing, double texels) {
        ShadowParams params = without_bias();
        params.bias.normal_offset = {texels, 0.0, profile};
        params.bias.offset_direction = direction;
        params.bias.offset_facing = facing;
        return lit_share(theta, scene, params);
      };
      const double outwards = lit(plane(), OffsetFacing::viewer, 0.1);
      EXPECT_GT(outwards, 0.51);
      for (const Scene& scene : {from_behind, mirrored_from_behind}) {
        EXPECT_EQ(lit(scene, OffsetFacing::viewer, 0.1), outwards);
        // 1 − max(cos θ, 0) is 1 for a normal that is turned away from the light.
        const double factor =
            profile == OffsetProfile::one_minus_cosine ? 1.0 / scale_of(OffsetProfile::one_minus_cosine, theta) : 1.0;
        EXPECT_NEAR(lit(scene, OffsetFacing::front, 0.1), lit(plane(), OffsetFacing::viewer, -0.1 * factor), 1e-4);
      }
      for (const Scene& scene : {plane(), mirrored}) EXPECT_EQ(lit(scene, OffsetFacing::front, 0.1), outwards);
    }
  }
}

TEST_F(NormalOffsetGl, A_caster_moves_inwards_as_far_as_a_receiver_would_move_outwards) {
  // Faces without normals, the same with normals, and mirrored.
  Scene smooth;
  Mesh with_normals = ground(30.0f);
  with_normals.normals.assign(with_normals.positions.size(), vec3(0, 2, 0));
  add_mesh(smooth, with_normals);
  Scene mirrored;
  add_mesh(mirrored, ground(30.0f), glm::scale(dmat4(1.0), dvec3(-1, 1, 1)));
  Scene smooth_mirrored;
  add_mesh(smooth_mirrored, with_normals, glm::scale(dmat4(1.0), dvec3(2, 3, -1)));
  for (const double theta : {0.5, 1.2}) {
    for (const OffsetProfile profile : profiles) {
      const double half_range = 0.5 * texel * std::sin(theta) / scale_of(profile, theta);
      for (const NormalOffset& offset : offsets_of(0.5 * half_range, profile)) {
        ShadowParams params = without_bias();
        params.map_depth.caster_offset = offset;
        for (const Scene& scene : {plane(), smooth, mirrored, smooth_mirrored}) {
          EXPECT_NEAR(lit_share(theta, scene, params), 0.75, 5e-3) << theta << " " << static_cast<int>(profile);
        }
      }
    }
  }
}

// A square straight below the light, 3 m away and a metre above the floor, is seen 0.5 m farther away.
TEST_F(NormalOffsetGl, Casters_move_in_the_maps_of_spot_and_point_lights) {
  Scene scene;
  add_mesh(scene, quad({-0.04f, 0, 0.04f}, {0.04f, 0, 0.04f}, {0.04f, 0, -0.04f}, {-0.04f, 0, -0.04f}));
  add_mesh(scene, quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}));
  const Light spot = spot_light({0, 3, 0}, {0, 0, 0}, 0.3);
  const Light point = point_light({0, 3, 0});
  struct Case {
    Light light;
    PointMap point_map = PointMap::cube;
    bool cube_passes = false;
  };
  for (const Case& c :
       {Case{spot}, Case{point}, Case{point, PointMap::cube, true}, Case{point, PointMap::paraboloid}}) {
    const MapLayout layout = with_point_map(fit_light(c.light, bounds_of(scene), 512), c.point_map);
    const double texel_there = texel_at(layout, {0, 0, 0});
    for (const NormalOffset& offset : {NormalOffset{0.0, 0.5, OffsetProfile::constant},
                                       NormalOffset{0.5 / texel_there, 0.0, OffsetProfile::constant}}) {
      MapDepthParams params;
      params.point_map = c.point_map;
      params.cube_passes = c.cube_passes;
      params.caster_offset = offset;
      float nearest = 1e9f;
      for (const Image<float>& view : test::to_metres(draw(scene, c.light, layout, params), layout)) {
        nearest = std::min(nearest, *std::min_element(view.pixels.begin(), view.pixels.end()));
      }
      EXPECT_NEAR(nearest, 3.5, 0.01) << static_cast<int>(layout.kind) << " " << offset.texels;
    }
  }
}

}  // namespace
}  // namespace umbrameter
