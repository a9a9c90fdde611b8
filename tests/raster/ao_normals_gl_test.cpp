// The normals that AO techniques read from compact inputs.
#include <cmath>

#include "ao_fixture.h"
#include "raster/ao/ao_passes.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class AoNormalsGl : public AoMethodsGl {
 protected:
  struct Normals {
    GBuffer surfels;
    Image<vec4> read;
  };
  Normals normals_of(const Scene& scene, const View& view, AoNormals kind) const {
    const GpuGBuffer surfels = draw_gbuffer(context(), upload(context(), scene), view);
    const GBuffer exact = read_back(context(), surfels);
    Image<float> depth = exact.depth;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      if (!exact.is_surface(i)) depth[i] = std::numeric_limits<float>::infinity();
    }
    const gl::Texture linear = upload(context(), depth);
    const gl::Texture drawn = draw_normals(context(), surfels, linear, view, {kind});
    return {exact, read_image<vec4>(drawn, gl::Format::rgba32f)};
  }
  static double angle(const vec3& a, const vec4& b) {
    return std::atan2(glm::length(glm::cross(dvec3(a), dvec3(b))), glm::dot(dvec3(a), dvec3(b)));
  }
};

Scene boxes() {
  Scene scene;
  add_mesh(scene, ground(20));
  add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
  add_mesh(scene, box({-0.2f, 1, -0.2f}, {0.1f, 2, 0.1f}));
  return scene;
}

TEST_F(AoNormalsGl, Eight_bits_a_component_round_each_to_1_in_255) {
  const View view = perspective_view(64, 48, {2, 3, 4}, {0, 1.5, 0});
  const Normals normals = normals_of(boxes(), view, AoNormals::rgb8);
  double worst = 0.0;
  for (std::size_t i = 0; i < normals.read.size(); ++i) {
    if (!normals.surfels.is_surface(i)) continue;
    dvec3 expected;
    for (const int k : {0, 1, 2}) {
      const double n = static_cast<double>(normals.surfels.geometric_normal[i][k]);
      expected[k] = std::floor((n * 0.5 + 0.5) * 255.0 + 0.5) / 255.0 * 2.0 - 1.0;
    }
    ASSERT_LT(angle(vec3(glm::normalize(expected)), normals.read[i]), 1e-6);
    worst = std::max(worst, angle(normals.surfels.geometric_normal[i], normals.read[i]));
  }
  // 0 is no multiple of 1/255 of the range: axes are off by 1/255 in two components, that is by √2/255.
  EXPECT_NEAR(worst, std::sqrt(2.0) / 255.0, 2e-4);
}

TEST_F(AoNormalsGl, Depths_give_the_normal_wherever_one_neighbour_on_each_axis_lies_in_the_same_plane) {
  for (const View& view :
       {perspective_view(96, 72, {2, 3, 4}, {0, 1.0, 0}), orthographic_view(96, 72, {2, 3, 4}, {0, 0.5, 0}, 2.0)}) {
    const Normals normals = normals_of(boxes(), view, AoNormals::depth);
    int wrong = 0;
    int surfels = 0;
    for (std::size_t i = 0; i < normals.read.size(); ++i) {
      if (!normals.surfels.is_surface(i)) {
        EXPECT_EQ(normals.read[i], vec4(0.0f));
        continue;
      }
      ++surfels;
      wrong += angle(normals.surfels.geometric_normal[i], normals.read[i]) > 5e-3 ? 1 : 0;
    }
    EXPECT_GT(surfels, 3000);
    // At creases the closer depth may be the other face's.
    EXPECT_LT(wrong, surfels / 20);
    EXPECT_GT(wrong, 0);
  }
}

TEST_F(AoNormalsGl, Techniques_read_the_selected_normals) {
  const View view = perspective_view(64, 48, {2, 3, 4}, {0, 0.5, 0});
  for (const AoTechniques::Choice name :
       {AoTechniques::choice<Ssao>, AoTechniques::choice<Gtao>, AoTechniques::choice<Alchemy>}) {
    AoParams params = method(name);
    const Seen exact = see(boxes(), view, params);
    params.inputs.normals = AoNormals::rgb8;
    const Seen rgb8 = see(boxes(), view, params);
    params.inputs.normals = AoNormals::depth;
    const Seen depth = see(boxes(), view, params);
    double of_rgb8 = 0.0;
    double of_depth = 0.0;
    for (std::size_t i = 0; i < exact.ao.size(); ++i) {
      of_rgb8 += std::abs(static_cast<double>(exact.ao[i] - rgb8.ao[i])) / static_cast<double>(exact.ao.size());
      of_depth += std::abs(static_cast<double>(exact.ao[i] - depth.ao[i])) / static_cast<double>(exact.ao.size());
    }
    EXPECT_GT(of_rgb8, 1e-6) << static_cast<int>(name);
    EXPECT_LT(of_rgb8, 0.01) << static_cast<int>(name);
    EXPECT_GT(of_depth, 1e-6) << static_cast<int>(name);
    EXPECT_LT(of_depth, 0.02) << static_cast<int>(name);
  }
}

}  // namespace
}  // namespace umbrameter
