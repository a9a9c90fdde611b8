#include <gtest/gtest.h>

#include "compare/visibility.h"
#include "present/presentation_parts.h"

namespace umbrameter {
namespace {

Image<float> row_of(const std::vector<float>& values) {
  Image<float> image(static_cast<int>(values.size()), 1);
  for (std::size_t i = 0; i < values.size(); ++i) image[i] = values[i];
  return image;
}

TEST(ErrorBackdrop, Errors_of_a_shadow_are_hidden_where_pixels_are_not_counted) {
  LayeredImage layers;
  add_layer(layers, "class_spot",
            row_of({static_cast<float>(PixelClass::acne), static_cast<float>(PixelClass::light_leak),
                    static_cast<float>(PixelClass::not_counted)}));
  add_layer(layers, "counted_sun", row_of({1.0f, 0.0f, 1.0f}));
  const auto shown = [&](const char* layer) {
    Image<float> error = row_of({-1.0f, 0.5f, 1.0f});
    hide_uncounted(error, layer, layers);
    return std::vector<float>{error[0], error[1], error[2]};
  };
  EXPECT_EQ(shown("error_visibility_spot"), (std::vector<float>{-1.0f, 0.5f, 0.0f}));
  EXPECT_EQ(shown("error_visibility_sun"), (std::vector<float>{-1.0f, 0.0f, 1.0f}));
  EXPECT_EQ(shown("error_ao"), (std::vector<float>{-1.0f, 0.5f, 1.0f}));
  EXPECT_EQ(shown("raster_visibility_spot"), (std::vector<float>{-1.0f, 0.5f, 1.0f}));
}

// Stems of a tuning's figures begin with the name of the point.
TEST(ErrorBackdrop, Images_of_both_points_of_a_tuning_have_the_scene_behind_them_and_one_inset) {
  const auto point = [](const char* name) {
    TunePointImages images{name, "", {}};
    for (const char* channel : {"R", "G", "B", "A"}) {
      images.measurement.layers.channels.push_back({channel, row_of({1.0f, 0.5f, 0.0f})});
    }
    return images;
  };
  RunResults results;
  results.tune.emplace();
  results.tune->points = {point("best"), point("default")};
  std::vector<Figure> figures;
  for (const char* stem :
       {"best_error_visibility_sun", "best_class_sun", "default_class_sun", "best_truth_ao", "cost_0"}) {
    ImageFigure figure;
    figure.stem = stem;
    figure.values = row_of({0.0f, 1.0f, 0.0f});
    figures.emplace_back(std::move(figure));
  }
  const ErrorImages errors = error_images_of(figures, results);
  for (const char* stem : {"best_error_visibility_sun", "best_class_sun", "default_class_sun"}) {
    ASSERT_TRUE(errors.contains(stem)) << stem;
    EXPECT_TRUE(errors.at(stem).shows_errors) << stem;
    EXPECT_EQ(errors.at(stem).backdrop.width, 3) << stem;
    EXPECT_EQ(errors.at(stem).part, "sun") << stem;
  }
  EXPECT_FALSE(errors.contains("cost_0"));
}

}  // namespace
}  // namespace umbrameter
