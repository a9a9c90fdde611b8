// Lengths across edges on surfaces whose footprints are known.
#include "compare/edge_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrameter {
namespace {

constexpr int side = 64;
constexpr double half_width = 3.2;  // metres: a pixel is 0.1 m wide

// An orthographic camera that looks along −z, and a plane through the origin tilted by `tilt` about x.
struct Tilted {
  explicit Tilted(double tilt) {
    view.width = side;
    view.height = side;
    view.camera.projection = OrthographicProjection{half_width, half_width, 0.0, 20.0};
    view.camera.world_from_camera[3] = {0.0, 0.0, 10.0, 1.0};
    const dvec3 normal(0.0, -std::sin(tilt), std::cos(tilt));
    gbuffer = GBuffer(side, side);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const Ray ray = pixel_ray(view, x, y);
        const double distance = glm::dot(-ray.origin, normal) / glm::dot(ray.direction, normal);
        const std::size_t i = gbuffer.instance.index(x, y);
        gbuffer.instance[i] = 0;
        gbuffer.position[i] = vec3(ray.origin + distance * ray.direction);
        gbuffer.geometric_normal[i] = vec3(normal);
      }
    }
  }
  // A sun whose light comes from +z turned by `angle` about y, with texels of 0.05 m.
  LengthFactors at(double angle, const dvec2& tangent) const {
    Light sun;
    sun.shape = DirectionalLight{};
    sun.world_from_light = dmat4(1.0);
    sun.world_from_light[0] = {std::cos(angle), 0.0, -std::sin(angle), 0.0};
    sun.world_from_light[2] = {std::sin(angle), 0.0, std::cos(angle), 0.0};
    MapLayout layout;
    layout.resolution = 200;
    layout.views[0].half_extent = 5.0;
    layout.light_from_world = glm::inverse(sun.world_from_light);
    return edge_scale(gbuffer, view, sun, layout)(gbuffer.instance.index(20, 40), glm::normalize(tangent));
  }
  View view;
  GBuffer gbuffer;
};

TEST(EdgeScale, Of_a_plane_that_faces_the_camera_is_that_of_the_pixels) {
  for (const dvec2 tangent : {dvec2(1, 0), dvec2(0, 1), dvec2(1, 1)}) {
    const LengthFactors factors = Tilted(0.0).at(0.0, tangent);
    EXPECT_NEAR(factors.metres, 0.1, 1e-6);
    EXPECT_NEAR(factors.texels, 2.0, 1e-5) << "0.1 m in texels of 0.05 m";
  }
}

// Down the image a pixel covers 0.1 m / cos 60° of the surface. Lines at 45° in the image with a distance of one pixel
// are √2 pixels apart along x, so that they are 0.1 · √2 · cos(atan ½) m apart: on the surface they run (0.1, 0.2).
TEST(EdgeScale, Of_a_tilted_plane_depends_on_the_direction_of_the_edge) {
  const Tilted plane(pi / 3.0);
  EXPECT_NEAR(plane.at(0.0, {1, 0}).metres, 0.2, 1e-6) << "an edge along x, across which pixels are longer";
  EXPECT_NEAR(plane.at(0.0, {0, 1}).metres, 0.1, 1e-6);
  EXPECT_NEAR(plane.at(0.0, {1, 1}).metres, 0.1 * std::sqrt(2.0) * 2.0 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(plane.at(0.0, {1, 0}).texels, 2.0, 1e-5) << "the light along the view sees no tilt";
}

// A light turned by 60° about y sees lengths along x halved and those along y as they are.
TEST(EdgeScale, Texels_are_perpendicular_to_the_light) {
  const Tilted plane(0.0);
  EXPECT_NEAR(plane.at(pi / 3.0, {0, 1}).texels, 1.0, 1e-5);
  EXPECT_NEAR(plane.at(pi / 3.0, {1, 0}).texels, 2.0, 1e-5);
  EXPECT_NEAR(plane.at(pi / 3.0, {0, 1}).metres, 0.1, 1e-6);
}

TEST(EdgeScale, Is_unknown_on_the_background) {
  Tilted plane(0.0);
  plane.gbuffer.instance = Image<std::uint32_t>(side, side, no_id);
  EXPECT_TRUE(std::isnan(plane.at(0.0, {1, 0}).metres));
}

}  // namespace
}  // namespace umbrameter
