// Filters and biases whose taps are placed or compared in ways of their own: the device against the processor.
#include <gtest/gtest.h>

#include "scenes/builtin.h"
#include "techniques/shadow/cascades.h"
#include "tests/agreement/bias_agreement.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/reference/taps.h"

namespace umbrameter::test {
namespace {

class TapsGl : public GlFixture {
 protected:
  void SetUp() override {
    GlFixture::SetUp();
    std::vector<std::string> notes;
    view_ = {96, 54, select_camera(scene_, "", 16.0 / 9.0, notes)};
  }
  void expect_agreement(const std::vector<NamedFilter>& filters, std::size_t judged) {
    BiasGrid grid;
    grid.axes = {{-0.01f, 0.02f, 0.3f}, {0.0f, 1.5f}};
    grid.resolutions = {96};
    grid.filters = filters;
    grid.judged_filters = judged;
    for (const Light& light : lights_) {
      const Agreement found = compare_ways(context(), scene_, view_, light, grid);
      for (const std::string& line : found.disagreements) ADD_FAILURE() << line;
      EXPECT_GT(found.wrong_cells, 0u);
    }
  }

  const Scene scene_ = load_scene("contact-box");
  const std::vector<Light> lights_ = lights_of_every_kind(scene_);
  View view_;
};

NamedFilter filter(const char* name, ShadowFilter kind, int size, FilterTaps taps = FilterTaps::nearest) {
  NamedFilter named{name, {}};
  named.params.pcf.filter = kind;
  named.params.pcf.size = size;
  named.params.pcf.taps = taps;
  return named;
}

TEST_F(TapsGl, Even_kernels_area_tents_and_rotations_agree) {
  std::vector<NamedFilter> filters = {
      filter("4×4 Gaussian", ShadowFilter::gaussian, 4),
      filter("4×4 tent of linear taps", ShadowFilter::tent, 4, FilterTaps::linear),
      filter("6×6 Gaussian of linear taps", ShadowFilter::gaussian, 6, FilterTaps::linear),
      filter("5×5 optimized", ShadowFilter::optimized, 5),
      filter("5×5 area tent", ShadowFilter::area_tent, 5),
      filter("4×4 area tent", ShadowFilter::area_tent, 4)};
  for (const DiskRotation rotation : {DiskRotation::fixed, DiskRotation::gradient}) {
    NamedFilter disk = filter("Vogel disk", ShadowFilter::vogel, 1);
    disk.params.pcf.rotation = rotation;
    disk.params.pcf.samples = 8;
    filters.push_back(disk);
  }
  expect_agreement(filters, 1);
}

TEST_F(TapsGl, Receiver_plane_and_cone_bias_agree) {
  NamedFilter plane = filter("3×3 box at the receiver's plane", ShadowFilter::box, 3);
  plane.params.bias.receiver_plane = true;
  NamedFilter cone = filter("Gaussian of linear taps with a cone bias", ShadowFilter::gaussian, 3, FilterTaps::linear);
  cone.params.bias.cone = 0.8;
  NamedFilter both = filter("disk with both", ShadowFilter::poisson, 1);
  both.params.bias.receiver_plane = true;
  both.params.bias.cone = 0.2;
  expect_agreement({plane, cone, both}, 1);
}

TEST_F(TapsGl, Shadows_that_follow_the_size_of_the_light_agree_in_every_pixel) {
  const UploadedScene uploaded = upload(context(), scene_);
  const GpuGBuffer surfels = draw_gbuffer(context(), uploaded, view_);
  const GBuffer gbuffer = read_back(context(), surfels);
  for (const Light& light : lights_) {
    const double extent = std::holds_alternative<DirectionalLight>(light.shape) ? 0.05 : 0.3;
    const MapLayout layout = fit_map(light, bounds_of(scene_), {.resolution = 256}, {gbuffer, view_});
    const ShadowMap map = draw_shadow_map(context(), uploaded, light, layout);
    const ShadowMapImages images = read_back(context(), map);
    struct Variant {
      ShadowTechniques::Choice technique;
      bool in_cone;
    };
    for (const auto& [name, in_cone] : {Variant{ShadowTechniques::choice<Pcss>, false},
                                        {ShadowTechniques::choice<Pcss>, true},
                                        {ShadowTechniques::choice<Dpcf>, false}}) {
      ShadowParams params;
      params.technique = name;
      params.pcss.search_cone = in_cone;
      params.pcss.min_radius = 0.5;
      params.pcf.rotation = DiskRotation::gradient;
      params.bias.slope = 1.0;
      const ShadowTechnique technique = make_technique(params, extent);
      const Image<float> drawn =
          draw_visibility(context(), {uploaded, surfels, map, light, params.bias, technique}).visibility;
      const MapLookup lookup{gbuffer, layout, light, images, *kernel_of(technique), params.bias};
      std::size_t partial = 0;
      std::size_t differing = 0;
      std::vector<Tap> taps;
      for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) {
        if (!gbuffer.is_surface(pixel)) continue;
        const SurfelLookup surfel = look_up(lookup, pixel);
        float expected = 0.0f;
        if (surfel.faces_light) {
          fetch_taps(lookup, surfel, pixel, taps);
          expected = visibility_of(lookup, surfel, taps);
        }
        if (drawn[pixel] != expected) ++differing;
        if (expected > 0.0f && expected < 1.0f) ++partial;
      }
      EXPECT_EQ(differing, 0u);
      EXPECT_GT(partial, 50u) << "the light should have a penumbra";
    }
  }
}

}  // namespace
}  // namespace umbrameter::test
