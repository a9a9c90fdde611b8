#include <gtest/gtest.h>

#include "present/presentation_parts.h"

namespace umbrameter {
namespace {

std::string caption_of(bool is_hard) {
  SceneFacts scene;
  scene.titles = scene.layers = {"sun"};
  ShadowMeasurement shadow;
  shadow.light = 0;
  ShadowShape& shape = shadow.shape.emplace();
  EdgeDistances distances;
  distances.texels = distances.pixels = distances.metres = Spread{};
  shape.error.all = distances;
  shape.error.parts.assign(is_hard ? cause_count : 2, distances);
  if (is_hard) shape.error.components.emplace();
  Presentation presentation;
  present_shape(presentation, scene, shadow);
  return head_of(presentation.figures.at(0)).caption;
}

// Against a reference with a penumbra no cause is known.
TEST(ShadowShapeReport, The_caption_of_distances_speaks_of_causes_only_where_there_are_some) {
  EXPECT_NE(caption_of(true).find("each cause's error"), std::string::npos);
  const std::string soft = caption_of(false);
  for (const char* word : {"cause's", "acne", "Aliasing"}) EXPECT_EQ(soft.find(word), std::string::npos) << soft;
  EXPECT_NE(soft.find("too dark"), std::string::npos) << soft;
}

}  // namespace
}  // namespace umbrameter
