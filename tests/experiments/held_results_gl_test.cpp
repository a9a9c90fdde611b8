// Results of stages outlive what replaces them.
#include <gtest/gtest.h>

#include "raster/rasterizer.h"
#include "tests/experiments/stages_gl.h"

namespace umbrameter {
namespace {

using HeldResultsGl = ContactBoxGl;

TEST_F(HeldResultsGl, Stay_what_they_were_when_the_view_changes) {
  const std::unique_ptr<Stages> stages = make_stages();
  const Experiment first = base({});
  const auto surfels = stages->surfels(first);
  const auto layout = stages->layout(first, 0);
  const auto counted = stages->counted(first, 0);
  const auto truth = stages->truth(first, 0);
  const Surfels surfels_before = *surfels;
  const std::uint64_t pixels_before = counted->totals[0];
  const Image<float> truth_before = truth->visibility;

  const Experiment other = base({"view.size=48x36", "shadow.fit=view"});
  EXPECT_NE(stages->surfels(other)->gbuffer.position.pixels, surfels_before.gbuffer.position.pixels);
  EXPECT_NE(stages->layout(other, 0), layout);
  EXPECT_NE(stages->counted(other, 0), counted);
  EXPECT_NE(stages->truth(other, 0)->visibility.size(), truth_before.size());

  EXPECT_EQ(surfels->gbuffer.position.pixels, surfels_before.gbuffer.position.pixels);
  EXPECT_EQ(surfels->view.width, 64);
  EXPECT_EQ(counted->totals[0], pixels_before);
  EXPECT_EQ(truth->visibility.pixels, truth_before.pixels);
}

TEST_F(HeldResultsGl, A_map_is_drawn_into_the_textures_of_another_only_when_nobody_holds_that) {
  const std::unique_ptr<Stages> stages = make_stages();
  const Experiment first = base({});
  const Experiment nearer = base({"shadow.fit=bounds", "shadow.fit-size=6"});
  auto map = stages->map(first, 0);
  const ShadowMapImages before = read_back(stages->context(), *map);
  EXPECT_NE(stages->read_map(nearer, 0).depth[0].pixels, before.depth[0].pixels);
  EXPECT_EQ(read_back(stages->context(), *map).depth[0].pixels, before.depth[0].pixels);

  map = stages->map(first, 0);
  const unsigned texture = map->depth.name();
  map = nullptr;
  EXPECT_EQ(stages->map(nearer, 0)->depth.name(), texture);
}

TEST_F(HeldResultsGl, Ambient_occlusion_that_is_traced_in_the_background_keeps_its_surfels) {
  const Experiment first = base({"truth.spp=1024"});
  const auto expected = make_stages()->ao_truth(first);
  const std::unique_ptr<Stages> stages = make_stages();
  stages->begin_ao_truth(first);
  stages->surfels(base({"view.size=48x36"}));
  EXPECT_EQ(stages->ao_truth(first)->ao.pixels, expected->ao.pixels);
}

}  // namespace
}  // namespace umbrameter
