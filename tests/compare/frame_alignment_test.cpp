#include "compare/frame_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace umbrameter {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

struct Plane {
  dvec3 normal;
  double offset;  // normal · p = offset
};
// The corner of a room.
const std::vector<Plane> planes = {{{0, 1, 0}, 0.0}, {{0, 0, 1}, -6.0}, {{1, 0, 0}, -2.5}};

View view_of(int width = 160, int height = 90) {
  Camera camera;
  const dvec3 back = glm::normalize(dvec3(0.35, 0.45, 1.0));
  const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), back));
  camera.world_from_camera =
      dmat4(dvec4(right, 0), dvec4(glm::cross(back, right), 0), dvec4(back, 0), dvec4(1.0, 2.5, 3.0, 1.0));
  camera.projection = PerspectiveProjection{0.8, 0.1, 50.0};
  return {width, height, camera};
}

// The nearest plane on the ray through the pixel, whose centre is moved by `shift` pixels, and its index.
std::pair<dvec3, std::size_t> seen(const View& view, int x, int y, const dvec2& shift = dvec2(0.0)) {
  const dvec3 eye(view.camera.world_from_camera[3]);
  const double half = std::tan(0.4);
  const dvec3 local(half * view.width / view.height * (2.0 * (x + 0.5 + shift.x) / view.width - 1.0),
                    half * (1.0 - 2.0 * (y + 0.5 + shift.y) / view.height), -1.0);
  const dvec3 direction = dmat3(view.camera.world_from_camera) * local;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t which = 0;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const double t = (planes[p].offset - glm::dot(planes[p].normal, eye)) / glm::dot(planes[p].normal, direction);
    if (t > 0.0 && t < nearest) nearest = t, which = p;
  }
  return {eye + nearest * direction, which};
}

GBuffer gbuffer_of(const View& view) {
  GBuffer gbuffer(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto [position, plane] = seen(view, x, y);
      const std::size_t i = gbuffer.instance.index(x, y);
      gbuffer.instance[i] = static_cast<std::uint32_t>(plane);
      gbuffer.triangle[i] = 0;
      gbuffer.position[i] = vec3(position);
      gbuffer.geometric_normal[i] = vec3(planes[plane].normal);
    }
  }
  return gbuffer;
}

Image<vec3> shifted_positions(const View& view, const dvec2& shift) {
  Image<vec3> positions(view.width, view.height, vec3(0));
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) positions.at(x, y) = vec3(seen(view, x, y, shift).first);
  }
  return positions;
}

double axis_depth(const View& view, const vec3& position) {
  return -(view_from_world(view) * dvec4(dvec3(position), 1.0)).z;
}

// d at distance z, as docs/engine-protocol.md writes it.
double encoded(DepthConvention convention, double z, const View& view, const vec3& position) {
  const double n = 0.1, f = 50.0;
  switch (convention) {
    case DepthConvention::axis:
      return z;
    case DepthConvention::ray:
      return glm::length(dvec3(position) - dvec3(view.camera.world_from_camera[3]));
    case DepthConvention::linear:
      return (z - n) / (f - n);
    case DepthConvention::window:
      return f * (z - n) / (z * (f - n));
    case DepthConvention::reversed:
      return 1.0 - f * (z - n) / (z * (f - n));
    case DepthConvention::reversed_infinite:
      break;
  }
  return n / z;
}

Image<float> depths(const View& view, DepthConvention convention, const dvec2& shift = dvec2(0.0)) {
  const Image<vec3> positions = shifted_positions(view, shift);
  Image<float> image(view.width, view.height, 0.0f);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = static_cast<float>(encoded(convention, axis_depth(view, positions[i]), view, positions[i]));
  }
  return image;
}

template <class Pixel>
Image<Pixel> flipped(const Image<Pixel>& image, bool x_too, bool y_too) {
  Image<Pixel> result = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      result.at(x, y) = image.at(x_too ? image.width - 1 - x : x, y_too ? image.height - 1 - y : y);
    }
  }
  return result;
}

std::string remedy(const FrameSurfaces& frame) {
  const View view = view_of();
  const FrameAlignment alignment = align_frame(frame, gbuffer_of(view), view);
  EXPECT_FALSE(alignment.fits());
  EXPECT_LE(alignment.unmatched_with_remedy, 2.0 * most_unmatched);
  return alignment.remedy;
}

TEST(FrameAlignment, A_frame_of_our_own_surfels_fits_without_a_rest) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  const FrameAlignment alignment = align_frame({gbuffer.position}, gbuffer, view);
  EXPECT_TRUE(alignment.fits());
  EXPECT_EQ(alignment.surfaces, 160u * 90u);
  EXPECT_EQ(alignment.unmatched, 0u);
  EXPECT_LT(glm::length(alignment.shift), 1e-3);
  EXPECT_EQ(surfels_of_frame({gbuffer.position}, gbuffer, view).position, gbuffer.position);
}

TEST(FrameAlignment, Every_kind_of_depth_gives_the_positions_back) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  for (std::size_t c = 0; c < depth_conventions.size(); ++c) {
    const auto convention = static_cast<DepthConvention>(c);
    const FrameSurfaces frame{{}, depths(view, convention), convention};
    EXPECT_TRUE(align_frame(frame, gbuffer, view).fits()) << depth_conventions[c];
    const Image<vec3> positions = positions_of(frame, view);
    for (std::size_t i = 0; i < positions.size(); i += 97) {
      // A window depth of single precision resolves 6e-8 of z²/n at the end: 0.06 mm at 10 m.
      EXPECT_LT(glm::length(positions[i] - gbuffer.position[i]), 1e-3f) << depth_conventions[c];
    }
  }
}

TEST(FrameAlignment, Depths_are_counted_from_the_planes_of_the_camera_that_wrote_them) {
  View view = view_of();
  FrameSurfaces frame{{}, depths(view, DepthConvention::window), DepthConvention::window};
  std::get<PerspectiveProjection>(view.camera.projection).far_plane = std::numeric_limits<double>::infinity();
  std::get<PerspectiveProjection>(view.camera.projection).near_plane = 0.2;
  const GBuffer gbuffer = gbuffer_of(view);
  EXPECT_FALSE(align_frame(frame, gbuffer, view).fits());
  frame.near_plane = 0.1;
  frame.far_plane = 50.0;
  EXPECT_TRUE(align_frame(frame, gbuffer, view).fits());
}

TEST(FrameAlignment, Another_kind_of_depth_is_named) {
  const View view = view_of();
  const std::vector<std::pair<DepthConvention, DepthConvention>> pairs = {
      {DepthConvention::window, DepthConvention::reversed},
      {DepthConvention::window, DepthConvention::linear},
      {DepthConvention::axis, DepthConvention::ray},
      {DepthConvention::linear, DepthConvention::window},
      {DepthConvention::reversed, DepthConvention::axis},
      {DepthConvention::window, DepthConvention::reversed_infinite}};
  for (const auto& [said, is] : pairs) {
    const std::string name(depth_conventions[static_cast<std::size_t>(is)]);
    EXPECT_EQ(remedy({{}, depths(view, is), said}), "its depth is '" + name + "'");
  }
}

TEST(FrameAlignment, Exchanged_rows_and_columns_are_named) {
  const Image<vec3> positions = gbuffer_of(view_of()).position;
  EXPECT_EQ(remedy({flipped(positions, false, true)}), "its rows run the other way");
  EXPECT_EQ(remedy({flipped(positions, true, false)}), "left and right are exchanged");
  EXPECT_EQ(remedy({{}, flipped(depths(view_of(), DepthConvention::axis), false, true), DepthConvention::axis}),
            "its rows run the other way");
}

TEST(FrameAlignment, A_shift_of_half_a_pixel_is_measured_and_refused) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  const dvec2 shift(0.5, -0.5);
  for (const FrameSurfaces& frame :
       {FrameSurfaces{shifted_positions(view, shift)},
        FrameSurfaces{{}, depths(view, DepthConvention::axis, shift), DepthConvention::axis}}) {
    const FrameAlignment alignment = align_frame(frame, gbuffer, view);
    EXPECT_FALSE(alignment.fits());
    EXPECT_NEAR(alignment.shift.x, 0.5, 0.02);
    EXPECT_NEAR(alignment.shift.y, -0.5, 0.02);
    EXPECT_NE(alignment.remedy.find("it is shifted by (0.5"), std::string::npos) << alignment.remedy;
  }
}

TEST(FrameAlignment, Axes_and_units_are_named) {
  const Image<vec3> ours = gbuffer_of(view_of()).position;
  const auto mapped = [&](auto map) {
    Image<vec3> positions = ours;
    for (vec3& p : positions.pixels) p = map(p);
    return FrameSurfaces{positions};
  };
  EXPECT_EQ(remedy(mapped([](vec3 p) { return vec3(p.x, -p.z, p.y); })), "Z points up");
  EXPECT_EQ(remedy(mapped([](vec3 p) { return vec3(p.x, p.y, -p.z); })), "the axes are left-handed: z is negated");
  EXPECT_EQ(remedy(mapped([](vec3 p) { return 100.0f * p; })), "its lengths are multiplied by 0.01 (cm instead of m)");
  EXPECT_EQ(remedy(mapped([](vec3 p) { return 100.0f * vec3(p.x, -p.z, p.y); })),
            "Z points up, and its lengths are multiplied by 0.01 (cm instead of m)");
}

TEST(FrameAlignment, A_wrong_camera_is_refused_and_nothing_is_promised) {
  const View view = view_of();
  View other = view;
  other.camera.projection = PerspectiveProjection{0.9, 0.1, 50.0};
  // The frame has our own depths, which another field of view puts elsewhere.
  const FrameAlignment of_depth =
      align_frame({{}, depths(view, DepthConvention::axis), DepthConvention::axis}, gbuffer_of(other), other);
  EXPECT_FALSE(of_depth.fits());
  EXPECT_EQ(of_depth.remedy, "");
  other = view;
  other.camera.world_from_camera[3] += dvec4(0.3, 0.0, 0.0, 0.0);
  const FrameAlignment moved = align_frame({gbuffer_of(view).position}, gbuffer_of(other), other);
  EXPECT_FALSE(moved.fits());
  EXPECT_EQ(moved.remedy, "");
  EXPECT_NE(misfit_text(moved).find("matrix"), std::string::npos);
}

TEST(FrameAlignment, Pixels_without_a_partner_are_counted_and_left_out) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  FrameSurfaces frame{gbuffer.position};
  for (std::size_t i = 0; i < 100; ++i) frame.position[i * 137] += vec3(0, 1, 0);
  for (std::size_t i = 0; i < 50; ++i) frame.position[i * 137 + 68] = vec3(nan);
  const FrameAlignment alignment = align_frame(frame, gbuffer, view);
  EXPECT_TRUE(alignment.fits());
  EXPECT_EQ(alignment.unmatched, 150u);
  const GBuffer surfels = surfels_of_frame(frame, gbuffer, view);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < surfels.instance.size(); ++i) left_out += surfels.is_surface(i) ? 0u : 1u;
  EXPECT_EQ(left_out, 150u);
}

TEST(FrameAlignment, A_frame_in_which_meshes_are_missing_is_not_called_a_wrong_camera) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  FrameSurfaces frame{gbuffer.position};
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    if (gbuffer.instance[i] == 2) frame.position[i] = vec3(nan);
  }
  const FrameAlignment alignment = align_frame(frame, gbuffer, view);
  EXPECT_FALSE(alignment.fits());
  EXPECT_LT(alignment.median_error, partner_distance);
  EXPECT_NE(misfit_text(alignment).find("meshes are missing"), std::string::npos) << misfit_text(alignment);
}

TEST(FrameAlignment, Surfels_lie_at_the_frames_positions_in_our_planes) {
  const View view = view_of();
  const GBuffer gbuffer = gbuffer_of(view);
  const FrameSurfaces frame{shifted_positions(view, {0.03, 0.0})};
  const GBuffer surfels = surfels_of_frame(frame, gbuffer, view);
  for (std::size_t i = 0; i < surfels.position.size(); ++i) {
    if (!surfels.is_surface(i)) continue;
    const Plane& plane = planes[surfels.instance[i]];
    EXPECT_NEAR(glm::dot(plane.normal, dvec3(surfels.position[i])), plane.offset, 1e-6);
    EXPECT_LT(glm::length(surfels.position[i] - frame.position[i]), 1e-5f);
  }
}

}  // namespace
}  // namespace umbrameter
