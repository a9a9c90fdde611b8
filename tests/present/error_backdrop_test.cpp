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

}  // namespace
}  // namespace umbrameter
