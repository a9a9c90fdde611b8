// Small scenes, lights and surfels whose answers are known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/gbuffer.h"
#include "raster/rasterizer.h"
#include "scenes/scene.h"
#include "scenes/view.h"
#include "tests/support/gl_fixture.h"

namespace umbrameter::testing_scenes {

/// Appends a mesh with its own opaque material, an object and one instance; returns the instance's index.
std::uint32_t add_mesh(Scene& scene, Mesh mesh, const dmat4& world_from_mesh = dmat4(1.0));

/// Two triangles a b c, a c d.
Mesh quad(vec3 a, vec3 b, vec3 c, vec3 d);

/// Twelve triangles, outward faces.
Mesh box(vec3 min, vec3 max);

/// One triangle in the plane y = height that covers the disk of that radius about the origin, seen from above.
Mesh ground(float radius, float height = 0.0f);

/// Rotation and translation of something that looks along −z from `eye` to `target`.
dmat4 look_at(const dvec3& eye, const dvec3& target, const dvec3& up = dvec3(0, 1, 0));

View perspective_view(int width, int height, const dvec3& eye, const dvec3& target, double vertical_fov = 0.8);
View orthographic_view(int width, int height, const dvec3& eye, const dvec3& target, double half_height,
                       const dvec3& up = dvec3(0, 1, 0));

Light directional_light(const dvec3& towards_light);
Light spot_light(const dvec3& position, const dvec3& target, double outer_cone_angle);
Light point_light(const dvec3& position);

/// An orthographic map of that texel size, centred on the origin, whose texel rows are turned by `azimuth` (radians)
/// from the direction in which a horizontal plane slopes.
MapLayout exact_layout(const dvec3& towards_light, int resolution, double texel, double azimuth);
/// A directional light that looks along that layout.
Light light_of(const MapLayout& layout);

/// width · height surfels with normal +y spread evenly over a rectangle of the plane y = 0, on triangle 0 of
/// instance 0 (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018: the R2 sequence).
GBuffer surfels_on_ground(int width, int height, double min_x, double max_x, double min_z, double max_z);

double mean(const Image<float>& image);
/// Of a pixel's taps, by cause.
vec4 shares(const WrongTaps& wrong, std::size_t pixel);
vec4 mean(const WrongTaps& wrong);

using GlTest = test::GlFixture;

}  // namespace umbrameter::testing_scenes
