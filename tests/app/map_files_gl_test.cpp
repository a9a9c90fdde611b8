// Shadow look-ups made outside the program, from the files of --write-maps as docs/techniques/files.md describes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/math.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

struct MapFilesRun : GlRun {};

std::vector<double> numbers_of(const LayeredImage& file, const std::string& attribute) {
  std::istringstream text(file.attributes.at(attribute));
  std::vector<double> numbers;
  for (double number = 0.0; text >> number;) numbers.push_back(number);
  return numbers;
}

struct TexelPlace {
  std::size_t view = 0;
  dvec2 uv{0.0};       // −1 to 1 on the map
  double depth = 0.0;  // metres
};

// The face of the largest component, by its axis and sign: +x, −x, +y, −y, +z, −z.
TexelPlace on_cube(const dvec3& p) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(p[i]) > std::abs(p[axis])) axis = i;
  }
  dvec3 forward(0.0);
  forward[axis] = p[axis] < 0.0 ? -1.0 : 1.0;
  const dvec3 up = axis == 1 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
  const dvec3 right = glm::cross(forward, up);
  const double along = glm::dot(forward, p);
  const int view = 2 * axis + (p[axis] < 0.0 ? 1 : 0);
  return {static_cast<std::size_t>(view), dvec2(glm::dot(right, p), glm::dot(up, p)) / along, glm::length(p)};
}

// Light space from world.
dmat4 to_light_of(const LayeredImage& map) {
  const std::vector<double> rows = numbers_of(map, "light_from_world");
  dmat4 matrix(0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) matrix[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = rows[i];
  return matrix;
}

TexelPlace place_of(const LayeredImage& map, const dvec3& p) {
  const std::string& kind = map.attributes.at("kind");
  if (kind == "cube") return on_cube(p);
  const double half_extent = numbers_of(map, "view0_half_extent").front();
  if (kind == "perspective") return {0, dvec2(p) / (-p.z * half_extent), -p.z};
  const std::vector<double> center = numbers_of(map, "view0_center");
  return {0, (dvec2(p) - dvec2(center[0], center[1])) / half_extent, -p.z};
}

// Surfaces that face away are dark without a look-up, as is what lies outside the cone that a spot light's map holds.
bool is_looked_up(const LayeredImage& map, const dvec3& p, const dvec3& normal, const TexelPlace& place) {
  const std::string& kind = map.attributes.at("kind");
  const dvec3 to_light = kind == "orthographic" ? dvec3(0, 0, 1) : -glm::normalize(p);
  const double radius =
      kind == "perspective" ? glm::length(place.uv) : std::max(std::abs(place.uv.x), std::abs(place.uv.y));
  return glm::dot(normal, to_light) > 1e-3 && place.depth > 0.0 && radius < 0.95;
}

// Whether single precision may find another texel, or another side of the bias.
bool is_borderline(const dvec2& texel, double beyond) {
  const dvec2 from_border = glm::abs(texel - glm::round(texel));
  return std::min(from_border.x, from_border.y) < 1e-3 || std::abs(beyond) < 1e-5;
}

TEST_F(MapFilesRun, Nearest_taps_can_be_looked_up_from_the_files_alone) {
  constexpr double bias = 0.05;
  const ProgramResult result =
      run_program({"raster", "courtyard", "-o", folder_ / "out", "--size", "96x54", "--shadow.resolution", "256",
                   "--shadow.constant-bias", "5cm", "--write-maps", "--no-figures", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const LayeredImage images = read_exr(folder_ / "out/images.exr");
  const Image<dvec3> positions = vectors(images, "gbuffer_position");
  const Image<dvec3> normals = vectors(images, "gbuffer_normal");
  for (const std::string light : {"sun", "lantern", "spot"}) {
    EXPECT_NE(result.out.find("shadow_map_" + light + ".exr"), std::string::npos);
    const LayeredImage map = read_exr(folder_ / "out" / ("shadow_map_" + light + ".exr"));
    EXPECT_EQ(numbers_of(map, "shadow.constant-bias").front(), bias);
    const Image<float>& drawn = channel(images, "raster_visibility_" + light + ".Y");
    const dmat4 to_light = to_light_of(map);
    std::size_t lit = 0;
    std::size_t dark = 0;
    std::size_t borderline = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (!std::isfinite(drawn[i]) || !std::isfinite(positions[i].x)) continue;
      const dvec3 p(to_light * dvec4(positions[i], 1.0));
      const TexelPlace place = place_of(map, p);
      if (!is_looked_up(map, p, dmat3(to_light) * normals[i], place)) continue;
      const Image<float>& depth = channel(map, "view" + std::to_string(place.view) + "_depth.Y");
      const dvec2 texel = 0.5 * dvec2(place.uv.x + 1.0, 1.0 - place.uv.y) * static_cast<double>(depth.width);
      const double beyond =
          place.depth - static_cast<double>(depth.at(static_cast<int>(texel.x), static_cast<int>(texel.y))) - bias;
      if (is_borderline(texel, beyond)) {
        ++borderline;
        continue;
      }
      const bool is_lit = beyond <= 0.0;
      EXPECT_EQ(drawn[i], is_lit ? 1.0f : 0.0f) << light << " " << i << " " << beyond;
      ++(is_lit ? lit : dark);
    }
    EXPECT_GT(lit, 20u) << light;
    EXPECT_GT(dark, 20u) << light;
    EXPECT_LT(borderline, drawn.size() / 100) << light;
  }
}

}  // namespace
}  // namespace umbrameter
