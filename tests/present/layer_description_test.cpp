#include "results/layer_description.h"

#include <gtest/gtest.h>

#include <set>

namespace umbrameter {
namespace {

TEST(LayerDescriptions, Are_in_the_order_of_the_layers_and_have_different_names) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < layer_descriptions().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(layer_descriptions()[i].layer), i);
    EXPECT_TRUE(names.insert(layer_descriptions()[i].name).second) << layer_descriptions()[i].name;
    EXPECT_FALSE(layer_descriptions()[i].title.empty());
  }
  EXPECT_EQ(layer_descriptions().back().layer, Layer::depth) << "one for each";
}

TEST(LayerDescriptions, Are_found_by_the_names_in_the_file) {
  for (const LayerDescription& each : layer_descriptions()) {
    const std::string light = each.subject == LayerSubject::light ? "sun_2" : "";
    const std::optional<NamedLayer> found = find_layer(layer_name(each.layer, light));
    ASSERT_TRUE(found) << each.name;
    EXPECT_EQ(found->description->layer, each.layer) << each.name;
    EXPECT_EQ(found->light, light);
  }
  EXPECT_FALSE(find_layer("somebody_elses"));
  EXPECT_FALSE(find_layer("truth_visibility_")) << "of no light";
}

TEST(LayerDescriptions, Give_errors_a_scale_about_zero) {
  const ColorScale error = color_scale(Layer::error_ao);
  EXPECT_EQ(error.first, -0.5);
  EXPECT_EQ(error.last, 0.5);
  EXPECT_EQ(color_scale(Layer::truth_ao).first, 0.0);
}

TEST(LayerDescriptions, Name_both_ends_of_a_share) {
  for (const Layer layer : {Layer::truth_visibility, Layer::raster_visibility, Layer::truth_ao, Layer::raster_ao}) {
    const std::string label = color_scale(layer).label;
    EXPECT_NE(label.find("0 "), std::string::npos) << label;
    EXPECT_NE(label.find("1 "), std::string::npos) << label;
  }
}

}  // namespace
}  // namespace umbrameter
