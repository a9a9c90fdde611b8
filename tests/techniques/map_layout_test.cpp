#include "techniques/shadow/map_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

Bounds box(const dvec3& min, const dvec3& max) {
  Bounds bounds;
  bounds.include(min);
  bounds.include(max);
  return bounds;
}

Light make_light(const dmat4& pose, const decltype(Light::shape)& shape) {
  Light light;
  light.world_from_light = pose;
  light.shape = shape;
  return light;
}

// Shines down −Y with the map's up along −Z.
dmat4 straight_down(const dvec3& position = dvec3(0)) {
  return glm::rotate(glm::translate(dmat4(1.0), position), -pi / 2, dvec3(1, 0, 0));
}

TEST(DirectionalMap, The_square_covers_the_wider_side_with_one_texel_of_margin) {
  const MapLayout layout = fit_light(make_light(straight_down(), DirectionalLight{}), box({-4, 0, -1}, {4, 3, 1}), 102);
  EXPECT_EQ(layout.kind, MapKind::orthographic);
  // 8 m on the inner 100 of 102 texels: half extent 4 · 102/100, texel 0.08 m.
  EXPECT_NEAR(layout.views.front().half_extent, 4.08, 1e-9);
  EXPECT_NEAR(texel_at(layout, {0, 0, 0}), 0.08, 1e-9);
  EXPECT_NEAR(layout.far_depth, 3.0, 1e-4);
  EXPECT_GT(layout.far_depth, 3.0);
}

TEST(DirectionalMap, Depth_runs_from_the_upper_face_along_the_light) {
  const MapLayout layout =
      fit_light(make_light(straight_down({100, 100, 100}), DirectionalLight{}), box({-4, 0, -1}, {4, 3, 1}), 102);
  EXPECT_NEAR(depth_of(layout, {3, 3, 1}), 0.0, 1e-4);
  EXPECT_GE(depth_of(layout, {3, 3, 1}), 0.0);
  EXPECT_NEAR(depth_of(layout, {-2, 1, 0}) - depth_of(layout, {3, 3, 1}), 2.0, 1e-12);
  EXPECT_LT(depth_of(layout, {4, 0, 1}), layout.far_depth);
}

TEST(DirectionalMap, Roll_of_the_light_turns_the_square) {
  // A 2 × 2 m floor seen along a light rolled by 45° spans its diagonal, 2·√2 m.
  const dmat4 rolled = straight_down() * glm::rotate(dmat4(1.0), pi / 4, dvec3(0, 0, 1));
  const MapLayout layout = fit_light(make_light(rolled, DirectionalLight{}), box({-1, 0, -1}, {1, 0, 1}), 1002);
  EXPECT_NEAR(2.0 * layout.views.front().half_extent, 2.0 * std::sqrt(2.0) * 1002.0 / 1000.0, 1e-9);
}

TEST(DirectionalMap, Every_corner_is_at_least_one_texel_inside) {
  const Bounds bounds = box({1000, -5, 20}, {1030, 40, 25});
  const dmat4 pose = glm::rotate(dmat4(1.0), -0.8, glm::normalize(dvec3(1, 0.4, 0.2)));
  for (const int resolution : {4, 16, 1024}) {
    const MapLayout layout = fit_light(make_light(pose, DirectionalLight{}), bounds, resolution);
    double reach = 0.0;
    for (int i = 0; i < 8; ++i) {
      EXPECT_TRUE(is_inside(layout, bounds.corner(i)));
      const dvec3 local(layout.light_from_world * dvec4(bounds.corner(i), 1));
      reach = std::max({reach, std::abs(local.x), std::abs(local.y)});
      EXPECT_GT(depth_of(layout, bounds.corner(i)), 0.0);
      EXPECT_LT(depth_of(layout, bounds.corner(i)), layout.far_depth);
    }
    const double texel = texel_at(layout, bounds.center());
    EXPECT_NEAR((layout.views.front().half_extent - reach) / texel, 1.0, 1e-6);
    EXPECT_FALSE(is_inside(layout, bounds.center() + 100.0 * dvec3(1, 0, 0)));
  }
}

TEST(DirectionalMap, Flat_empty_and_tiny_cases_stay_finite) {
  Bounds point;
  point.include({1, 2, 3});
  for (const Bounds& bounds : {Bounds{}, point, box({0, 0, 0}, {0, 5, 0})}) {
    for (const int resolution : {1, 2, 3}) {
      const MapLayout layout = fit_light(make_light(straight_down(), DirectionalLight{}), bounds, resolution);
      EXPECT_GT(layout.views.front().half_extent, 0.0);
      EXPECT_TRUE(std::isfinite(layout.views.front().half_extent));
      EXPECT_GT(layout.far_depth, 0.0);
    }
  }
}

TEST(SpotMap, It_opens_by_the_outer_cone_and_texels_grow_with_depth) {
  const SpotLight spot{0.0, 0.1, pi / 4};
  const MapLayout layout = fit_light(make_light(straight_down({0, 10, 0}), spot), box({-3, 0, -3}, {3, 1, 3}), 1000);
  EXPECT_EQ(layout.kind, MapKind::perspective);
  EXPECT_NEAR(layout.views.front().half_extent, 1.0, 1e-12);  // tan 45°
  EXPECT_NEAR(depth_of(layout, {2, 1, 0}), 9.0, 1e-12);
  EXPECT_NEAR(texel_at(layout, {2, 1, 0}), 0.018, 1e-12);  // 2 · 9 / 1000
  EXPECT_NEAR(layout.far_depth, 10.0, 1e-3);
  EXPECT_GT(layout.far_depth, 10.0);
}

TEST(SpotMap, The_square_frustum_decides_inside) {
  const MapLayout layout = fit_light(make_light(straight_down({0, 10, 0}), SpotLight{0.0, 0.0, pi / 4}),
                                     box({-30, 0, -30}, {30, 1, 30}), 64);
  EXPECT_TRUE(is_inside(layout, {9.9, 0, 9.9}));
  EXPECT_FALSE(is_inside(layout, {10.1, 0, 0}));
  EXPECT_FALSE(is_inside(layout, {0, 10, 0})) << "the light itself";
  EXPECT_FALSE(is_inside(layout, {0, 11, 0})) << "behind the light";
}

TEST(SpotMap, A_half_space_cone_is_kept_to_a_finite_map) {
  const MapLayout layout =
      fit_light(make_light(straight_down({0, 10, 0}), SpotLight{0.0, 0.0, pi / 2}), box({-1, 0, -1}, {1, 1, 1}), 64);
  EXPECT_NEAR(layout.views.front().half_extent, 572.957, 1e-3);  // tan 89.9°
}

// N. Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 3.1: a sum of four products whose entries
// are rounded, too, is off by at most 5 u times the sum of their magnitudes; the quotient is rounded once more.
TEST(SpotMap, A_receiver_in_single_precision_is_off_by_its_roundings_times_the_square_of_its_depth) {
  dmat4 pose = glm::translate(dmat4(1.0), dvec3(3, 10, 1));
  pose = glm::rotate(glm::rotate(pose, 0.7, dvec3(0, 1, 0)), -1.2, dvec3(1, 0, 0));
  MapLayout layout = fit_light(make_light(pose, SpotLight{0.0, 0.1, pi / 4}), box({-3, 0, -9}, {3, 1, 3}), 1000);
  MapDepthParams params;
  params.encoding = DepthEncoding::perspective;
  params.near_depth = 0.016;
  EXPECT_FALSE(with_depth_encoding(layout, params).rounds_receivers);
  params.receiver_precision = ReceiverPrecision::single;
  layout = with_depth_encoding(layout, params);
  ASSERT_TRUE(layout.rounds_receivers);
  const ClipRows rows = clip_rows(layout);
  const double u = std::ldexp(1.0, -24);
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const vec3 p(-3.0f + 0.0061f * static_cast<float>(i), 0.3f, -3.0f + 0.0057f * static_cast<float>(i));
    const double exact = depth_of(layout, dvec3(p));
    const double error = project_to_map(layout, dvec3(p)).depth - exact;
    const auto size = [&](const vec4& row) { return glm::dot(dvec4(glm::abs(row)), glm::abs(dvec4(p, 1.0))); };
    const double of_number = 5.0 * u * (size(rows.z) + size(rows.w)) / exact + u;
    const double bound = of_number * metres_per_map_depth(layout, exact);
    EXPECT_LE(std::abs(error), bound);
    largest = std::max(largest, std::abs(error) / bound);
  }
  EXPECT_GT(largest, 0.1);
  params.encoding = DepthEncoding::linear;
  EXPECT_FALSE(with_depth_encoding(layout, params).rounds_receivers);
}

TEST(SpotMap, Receivers_pass_half_a_step_before_or_behind_the_stored_number) {
  const double near = 0.016;
  const double far = 16.0;
  const auto depth_of_number = [&](float number) {
    return shared::decode_depth(shared::DEPTH_PERSPECTIVE, static_cast<double>(number), near, far);
  };
  for (const float stored : {0.8f, 0.9f, 0.99f, 0.9975f, 0.9987654f}) {
    // What look-ups read of it.
    const auto read = static_cast<double>(static_cast<float>(depth_of_number(stored) / far)) * far;
    const double equal_fails = shared::passing_depth(read, -1, near, far);
    const double equal_passes = shared::passing_depth(read, 1, near, far);
    EXPECT_LT(depth_of_number(std::nextafter(stored, 0.0f)), equal_fails) << stored;
    EXPECT_LT(equal_fails, depth_of_number(stored)) << stored;
    EXPECT_LT(depth_of_number(stored), equal_passes) << stored;
    EXPECT_LT(equal_passes, depth_of_number(std::nextafter(stored, 1.0f))) << stored;
  }
}

TEST(SpotMap, A_far_plane_of_its_own_changes_the_step_of_the_stored_depth_by_the_near_over_the_far) {
  const MapLayout layout =
      fit_light(make_light(straight_down({0, 10, 0}), SpotLight{0.0, 0.0, pi / 4}), box({-3, 0, -3}, {3, 1, 3}), 64);
  MapDepthParams params;
  params.encoding = DepthEncoding::perspective;
  params.near_depth = 0.5;
  EXPECT_EQ(far_end_of(with_depth_encoding(layout, params)), layout.far_depth);
  params.far_depth = 30.0;
  const MapLayout encoded = with_depth_encoding(layout, params);
  EXPECT_EQ(far_end_of(encoded), 30.0);
  EXPECT_EQ(encoded.far_depth, layout.far_depth);
  EXPECT_NEAR(metres_per_map_depth(encoded, 4.0), 16.0 / 0.5 * (1.0 - 0.5 / 30.0), 1e-12);
  params.encoding = DepthEncoding::linear;
  EXPECT_EQ(far_end_of(with_depth_encoding(layout, params)), layout.far_depth);
}

TEST(CubeMap, Depth_is_radial_and_texels_are_those_of_the_face) {
  const MapLayout layout =
      fit_light(make_light(glm::translate(dmat4(1.0), dvec3(1, 2, 3)), PointLight{}), box({-1, 0, 0}, {1, 2, 3}), 512);
  EXPECT_EQ(layout.kind, MapKind::cube);
  EXPECT_EQ(layout.views.front().half_extent, 1.0);
  EXPECT_NEAR(depth_of(layout, {4, 6, 3}), 5.0, 1e-12);
  EXPECT_NEAR(texel_at(layout, {4, 6, 3}), 2.0 * 4.0 / 512.0, 1e-12);
  EXPECT_NEAR(layout.far_depth, std::sqrt(4.0 + 4.0 + 9.0), 1e-3);
  EXPECT_TRUE(is_inside(layout, {-100, 7, 2}));
}

TEST(MapViews, Faces_cascades_and_halves_have_names) {
  MapLayout layout;
  EXPECT_EQ(view_name(layout, 0), "");
  layout.views.resize(2);
  EXPECT_EQ(view_name(layout, 1), "cascade 2");
  layout.kind = MapKind::paraboloid;
  EXPECT_EQ(view_name(layout, 1), "back");
  layout.kind = MapKind::cube;
  for (int face = 0; face < 6; ++face) {
    // "+x" names the axis along which the face looks.
    const std::string name = view_name(layout, static_cast<std::size_t>(face));
    const char axis = name.back();
    const double sign = name.find('+') != std::string::npos ? 1.0 : -1.0;
    EXPECT_EQ(cube_face(face)[2][axis - 'x'], sign) << name;
  }
}

TEST(ToLight, It_is_against_the_axis_or_towards_the_position) {
  EXPECT_NEAR(glm::distance(to_light(make_light(straight_down({5, 5, 5}), DirectionalLight{}), {9, 9, 9}), {0, 1, 0}),
              0, 1e-15);
  EXPECT_NEAR(glm::distance(to_light(make_light(straight_down({5, 5, 5}), PointLight{}), {5, 5, 2}), {0, 0, 1}), 0,
              1e-15);
}

TEST(PixelExclusion, Each_reason_has_its_class) {
  const Light spot = make_light(straight_down({0, 10, 0}), SpotLight{10.5, 0.1, pi / 4});
  const MapLayout layout = fit_light(spot, box({-30, -5, -30}, {30, 1, 30}), 64);
  const dvec3 up(0, 1, 0);
  EXPECT_EQ(exclusion_of(spot, layout, {0, 0, 0}, up), PixelExclusion::none);
  EXPECT_EQ(exclusion_of(spot, layout, {0, 0, 0}, -up), PixelExclusion::back_facing);
  EXPECT_EQ(exclusion_of(spot, layout, {0, 0, 0}, {1, 0, 0}), PixelExclusion::back_facing) << "grazing: N.L = 0";
  EXPECT_EQ(exclusion_of(spot, layout, {12, 0, 0}, up), PixelExclusion::outside_map);
  EXPECT_EQ(exclusion_of(spot, layout, {9, 0, 9}, up), PixelExclusion::outside_cone) << "in the square's corner";
  EXPECT_EQ(exclusion_of(spot, layout, {0, -1, 0}, up), PixelExclusion::outside_range);
}

TEST(PixelExclusion, A_surfel_that_faces_part_of_a_light_counts_and_one_that_faces_none_is_turned_away) {
  const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
  // From 4 m aside and h below its plane a light of half size s across shows its rim where h < s.
  Light light;
  light.shape = PointLight{};
  light.world_from_light[3] = dvec4(4, 0, 0, 1);
  const MapLayout cube = fit_light(light, bounds, 64);
  const auto at = [&](double y) { return exclusion_of(light, cube, {0, y, 0}, {0, 1, 0}); };
  EXPECT_EQ(at(0.01), PixelExclusion::back_facing) << "no extent: its place decides";
  EXPECT_EQ(at(-0.01), PixelExclusion::none);
  for (const Emitter& emitter :
       {Emitter(SphereEmitter{0.5}), Emitter(DiskEmitter{0.5}), Emitter(RectangleEmitter{2.0, 1.0})}) {
    light.emitter = emitter;
    EXPECT_EQ(at(0.49), PixelExclusion::none) << emitter.index();
    EXPECT_EQ(at(0.51), PixelExclusion::back_facing) << emitter.index();
  }
  // A disk seen from its own plane has no height above it.
  light.emitter = DiskEmitter{0.5};
  light.world_from_light = {dvec4(1, 0, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, -1, 0, 0), dvec4(4, 0, 0, 1)};
  EXPECT_EQ(at(0.01), PixelExclusion::back_facing);
  // A sun 3 degrees below the horizon shows its rim where it is more than 6 degrees wide.
  Light sun = light;
  sun.shape = DirectionalLight{};
  const double below = 3.0 * pi / 180.0;
  sun.world_from_light = {dvec4(0, 0, -1, 0), dvec4(std::sin(below), std::cos(below), 0, 0),
                          dvec4(std::cos(below), -std::sin(below), 0, 0), dvec4(0, 0, 0, 1)};
  const MapLayout square = fit_light(sun, bounds, 64);
  for (const auto& [degrees, expected] : {std::pair{5.9, PixelExclusion::back_facing}, {6.1, PixelExclusion::none}}) {
    sun.emitter = DistantEmitter{degrees * pi / 180.0};
    EXPECT_EQ(exclusion_of(sun, square, {0, 0, 0}, {0, 1, 0}), expected) << degrees;
  }
}

TEST(PixelExclusion, The_cone_ends_at_its_angle) {
  const double outer = 0.5;
  const Light spot = make_light(straight_down({0, 1, 0}), SpotLight{0.0, 0.0, outer});
  const MapLayout layout = fit_light(spot, box({-3, 0, -3}, {3, 0, 3}), 64);
  const auto at = [&](double angle) {
    const double reach = std::tan(angle) / std::sqrt(2.0);  // along the diagonal, inside the square
    return exclusion_of(spot, layout, {reach, 0, reach}, {0, 1, 0});
  };
  EXPECT_EQ(at(outer - 1e-9), PixelExclusion::none);
  EXPECT_EQ(at(outer + 1e-9), PixelExclusion::outside_cone);
}

TEST(PixelExclusion, Point_lights_have_a_range_and_directional_ones_none) {
  const Bounds bounds = box({-9, 0, -9}, {9, 0, 9});
  const Light point = make_light(glm::translate(dmat4(1.0), dvec3(0, 3, 0)), PointLight{5.0});
  const MapLayout cube = fit_light(point, bounds, 64);
  EXPECT_EQ(exclusion_of(point, cube, {3.9, 0, 0}, {0, 1, 0}), PixelExclusion::none);
  EXPECT_EQ(exclusion_of(point, cube, {4.1, 0, 0}, {0, 1, 0}), PixelExclusion::outside_range);
  const Light directional = make_light(straight_down(), DirectionalLight{});
  EXPECT_EQ(exclusion_of(directional, fit_light(directional, bounds, 64), {9, 0, 9}, {0, 1, 0}), PixelExclusion::none);
}

}  // namespace
}  // namespace umbrameter
