#include "core/error.h"
#include "raster/shadow/shadow_lookup.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

class ShadowLookupGl : public GlTest {};

TEST_F(ShadowLookupGl, A_bilinear_tap_weighs_texels_by_how_near_their_centres_are) {
  // Texels of half a metre and a slab 1 m up over x < 0, which covers the column whose centres are at x = −0.25.
  Scene scene;
  add_mesh(scene, ground(60));
  add_mesh(scene, quad({-20, 1, 20}, {0, 1, 20}, {0, 1, -20}, {-20, 1, -20}));
  const UploadedScene uploaded = upload(context(), scene);
  const MapLayout layout = exact_layout({0, 1, 1e-9}, 64, 0.5, 0.0);
  const ShadowMap map = draw_shadow_map(context(), uploaded, light_of(layout), layout);
  ShadowParams params;
  params.bias.constant = 0.1;
  params.pcf.filter = ShadowFilter::bilinear;
  struct Place {
    float x;
    float visibility;
  };
  for (const Place& place :
       {Place{-0.25f, 0.0f}, Place{-0.125f, 0.25f}, Place{0.0f, 0.5f}, Place{0.125f, 0.75f}, Place{0.25f, 1.0f}}) {
    GBuffer one = surfels_on_ground(1, 1, 0, 1, 0, 1);
    one.position[0] = vec3(place.x, 0, 0.3f);
    const GpuGBuffer surfel = upload(context(), one);
    const Image<float> seen =
        draw_visibility(context(), {uploaded, surfel, map, light_of(layout), params.bias, make_technique(params)})
            .visibility;
    EXPECT_EQ(seen[0], place.visibility) << place.x;
  }
}

TEST_F(ShadowLookupGl, A_view_with_more_pixels_than_a_list_can_hold_is_an_error_that_names_its_size) {
  GpuGBuffer vast;
  vast.width = static_cast<int>(context().max_storage_bytes() / sizeof(std::uint32_t) / 1000);
  vast.height = 1001;
  try {
    const gl::Buffer list = make_pixel_list(context(), vast);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("view.size"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace umbrameter
