// One pass over all biases against the processor's and against each bias drawn on its own.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/builtin.h"
#include "tests/agreement/bias_agreement.h"
#include "tests/support/gl_fixture.h"

namespace umbrameter::test {
namespace {

class BiasResponseGl : public GlFixture {
 protected:
  void SetUp() override {
    GlFixture::SetUp();
    std::vector<std::string> notes;
    view_ = {96, 54, select_camera(scene_, "", 16.0 / 9.0, notes)};
  }
  std::size_t expect_agreement(const Light& light, const BiasGrid& grid) {
    const Agreement found = compare_ways(context(), scene_, view_, light, grid);
    for (const std::string& line : found.disagreements) ADD_FAILURE() << line;
    EXPECT_EQ(found.wrong_cells, found.cells) << "every cell should have something to count";
    EXPECT_GT(found.tested_taps, 0u);
    EXPECT_LT(found.identity_gap, 1e-7);
    return found.views;
  }

  const Scene scene_ = load_scene("contact-box");
  const std::vector<Light> lights_ = lights_of_every_kind(scene_);
  View view_;
};

TEST_F(BiasResponseGl, One_pass_counts_what_the_processor_and_each_cell_count) {
  BiasGrid grid{{{-0.01f, 0.02f, 0.3f, 2.0f}, {0.0f, 1.5f}}, {200}, usual_filters()};
  expect_agreement(lights_[0], grid);
  // Under the other kinds a box of nearest taps and a tent of linear ones add no path that the others lack.
  const auto is_left_out = [](const NamedFilter& filter) {
    return (filter.params.pcf.filter == ShadowFilter::box && filter.params.pcf.taps == FilterTaps::nearest) ||
           filter.params.pcf.filter == ShadowFilter::tent;
  };
  grid.filters.erase(std::remove_if(grid.filters.begin(), grid.filters.end(), is_left_out), grid.filters.end());
  ASSERT_EQ(grid.filters.size(), 5u);
  expect_agreement(lights_[1], grid);
  expect_agreement(lights_[2], grid);
}

TEST_F(BiasResponseGl, A_normal_offset_and_slopes_below_zero_agree_too) {
  const std::vector<NamedFilter> all = usual_filters();
  BiasGrid grid{{{0.0f, 0.05f}, {-0.5f, 0.5f, 0.0f}}, {64, 130}, {all[1], all[2]}, {0.7}};
  grid.judged_filters = 1;
  for (const Light& light : lights_) expect_agreement(light, grid);
  grid.resolutions = {130};
  BiasParams& bias = grid.filters[0].params.bias;
  bias.normal_offset.metres = 0.03;
  for (const OffsetProfile profile : {OffsetProfile::constant, OffsetProfile::one_minus_cosine, OffsetProfile::eevee}) {
    for (const OffsetDirection direction : {OffsetDirection::normal, OffsetDirection::across}) {
      bias.normal_offset.profile = profile;
      bias.offset_direction = direction;
      for (const Light& light : lights_) expect_agreement(light, grid);
    }
  }
}

TEST_F(BiasResponseGl, Biases_in_texels_agree_too_under_every_kind_of_light) {
  BiasGrid grid{{{-0.25f, 0.5f, 1.5f, 6.0f}, {0.0f, 1.5f}, LengthUnit::texels}, {96}, {usual_filters()[2]}};
  for (const Light& light : lights_) expect_agreement(light, grid);
}

TEST_F(BiasResponseGl, Biases_in_the_map_s_depth_agree_too) {
  BiasGrid grid{{{-1e-3f, 0.0f, 2e-3f, 0.02f}, {0.0f, 1.5f}, LengthUnit::map_depth}, {96}, {usual_filters()[2]}};
  for (const Light& light : lights_) expect_agreement(light, grid);
  grid.filters.front().params.bias.receiver_plane = true;
  for (const DepthEncoding encoding : {DepthEncoding::perspective, DepthEncoding::reversed}) {
    grid.map_depth.encoding = encoding;
    expect_agreement(lights_[1], grid);
  }
  EXPECT_THROW(expect_agreement(lights_[2], grid), Error) << "a face's depth is not the distance from the light";
}

TEST_F(BiasResponseGl, Cascades_agree_too) {
  const std::vector<NamedFilter> all = usual_filters();
  BiasGrid grid{{{0.0f, 0.05f, 0.3f}, {0.0f, 1.5f}}, {96}, {all[0], all[2]}};
  grid.judged_filters = 1;
  grid.cascades = 3;
  expect_agreement(lights_[0], grid);
  grid.fit.cascade_bias = "1,0.7,3.3";
  expect_agreement(lights_[0], grid);
  grid.fit.cascade_bias = own_range;
  grid.axes = {{0.0f, 0.002f, 0.02f}, {0.0f, 1.5f}, LengthUnit::map_depth};
  expect_agreement(lights_[0], grid);
}

TEST_F(BiasResponseGl, Shadows_that_fade_agree_too) {
  BiasGrid grid{{{0.0f, 0.05f}, {0.0f, 1.5f}}, {96}, {usual_filters()[2]}};
  grid.cascades = 2;
  grid.fit.fit = MapFit::view;
  grid.fit.selection = CascadeSelection::depth;
  grid.fit.split_range = SplitRange::camera;
  grid.fit.max_distance = 30.0;
  grid.fit.fade = 0.9;
  expect_agreement(lights_[0], grid);
}

TEST_F(BiasResponseGl, Warped_maps_agree_too) {
  const std::vector<NamedFilter> all = usual_filters();
  BiasGrid grid{{{0.0f, 0.5f, 3.0f}, {0.0f, 1.5f}, LengthUnit::texels}, {96}, {all[0], all[2]}, {0.7}};
  grid.judged_filters = 1;
  grid.fit.fit = MapFit::view;
  grid.fit.warp = Warp::lispsm;
  expect_agreement(lights_[0], grid);
  grid.filters = {all[3]};
  grid.filters.front().params.bias.receiver_plane = true;
  grid.filters.front().params.bias.cone = 0.1;
  grid.map_depth.format = MapDepthFormat::fixed16;
  grid.map_depth.caster_offset.texels = 1.5;
  expect_agreement(lights_[0], grid);
  // Depths over w.
  grid.axes = {{0.0f, 0.05f, 0.3f}, {0.0f, 1.5f}};
  grid.filters = {all[2]};
  grid.filters.front().params.bias.offset_texel = OffsetTexel::middle;
  for (const DepthEncoding encoding : {DepthEncoding::perspective, DepthEncoding::reversed}) {
    grid.map_depth.encoding = encoding;
    expect_agreement(lights_[0], grid);
  }
}

TEST_F(BiasResponseGl, Maps_with_other_depths_agree_too) {
  const auto set = [](const auto& change) {
    MapDepthParams params;
    change(params);
    return params;
  };
  BiasGrid grid{{{-0.2f, 0.0f, 0.05f}, {0.0f, 1.5f}}, {96}, {usual_filters()[2]}};
  grid.judged_filters = 1;
  for (const MapDepthParams& params : {set([](MapDepthParams& p) { p.format = MapDepthFormat::fixed16; }),
                                       set([](MapDepthParams& p) { p.format = MapDepthFormat::f16; }),
                                       set([](MapDepthParams& p) { p.encoding = DepthEncoding::reversed; }),
                                       set([](MapDepthParams& p) { p.faces = CasterFaces::back; }),
                                       set([](MapDepthParams& p) { p.surface = StoredSurface::midpoint; }),
                                       set([](MapDepthParams& p) { p.surface = StoredSurface::second; }),
                                       set([](MapDepthParams& p) { p.surface = StoredSurface::dual; }),
                                       set([](MapDepthParams& p) { p.polygon_offset_factor = -1.0; }),
                                       set([](MapDepthParams& p) { p.caster_offset.texels = 1.5; })}) {
    grid.map_depth = params;
    for (const Light& light : lights_) expect_agreement(light, grid);
  }
  for (const auto& [far, comparison] :
       {std::pair{0.0, DepthComparison::less_equal}, std::pair{200.0, DepthComparison::less}}) {
    grid.map_depth = set([far = far, comparison = comparison](MapDepthParams& p) {
      p.encoding = DepthEncoding::perspective;
      p.near_depth = 0.01;
      p.far_depth = far;
      p.receiver_precision = ReceiverPrecision::single;
      p.comparison = comparison;
    });
    expect_agreement(lights_[1], grid);
  }
  grid.map_depth = set([](MapDepthParams& p) { p.point_map = PointMap::paraboloid; });
  expect_agreement(lights_[2], grid);
}

TEST_F(BiasResponseGl, Blended_and_stable_cascades_agree_too_however_they_are_selected) {
  const std::vector<NamedFilter> all = usual_filters();
  BiasGrid grid{{{0.0f, 0.05f, 0.3f}, {0.0f, 1.5f}}, {96}, {all[0], all[2]}, {0.0, 0.7}};
  grid.judged_filters = 1;
  grid.cascades = 4;
  grid.fit.blend = 0.4;
  for (const CascadeSelection selection : {CascadeSelection::map, CascadeSelection::depth}) {
    for (const CascadeFit fit : {CascadeFit::tight, CascadeFit::stable}) {
      grid.fit.selection = selection;
      grid.fit.cascade_fit = fit;
      grid.fit.fit = fit == CascadeFit::stable ? MapFit::view : MapFit::scene;
      grid.fit.pancaking = fit == CascadeFit::stable;
      EXPECT_GT(expect_agreement(lights_[0], grid), 2u);
    }
  }
}

TEST_F(BiasResponseGl, The_largest_filter_agrees_too) {
  NamedFilter tent{"29×29 tent of linear taps", {}};
  tent.params.pcf.filter = ShadowFilter::tent;
  tent.params.pcf.size = FilterKernel::largest_size;
  tent.params.pcf.taps = FilterTaps::linear;
  view_.width = 48;
  view_.height = 27;
  expect_agreement(lights_[2], {{{0.02f, 0.3f}, {0.0f, 1.5f}}, {96}, {tent}});
}

}  // namespace
}  // namespace umbrameter::test
