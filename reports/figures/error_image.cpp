#include "reports/figures/error_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "reports/figures/figure_parts.h"

namespace umbrameter {
namespace {

constexpr int region_share = 8;  // of the image's sides, for the region of most error
constexpr int least_region = 8;  // [px]

// sRGB bytes. The error scale is white, byte 245, in its middle and has byte 215 at 0.3 of its reach: CIE L* 86.
constexpr double darkest_grey = 215.0;
constexpr double lightest_grey = 245.0;

template <class Value, class IsWrong>
Image<Value> enlarge(const Image<Value>& image, int dot, const IsWrong& is_wrong) {
  const int reach = dot / 2;
  if (reach < 1) return image;
  Image<Value> result = image;
  Image<int> nearest(image.width, image.height, std::numeric_limits<int>::max());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!is_wrong(image.at(x, y))) continue;
      for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u) {
          const int distance = (u - x) * (u - x) + (v - y) * (v - y);
          if (distance >= nearest.at(u, v) || is_wrong(image.at(u, v))) continue;
          nearest.at(u, v) = distance;
          result.at(u, v) = image.at(x, y);
        }
      }
    }
  }
  return result;
}

double reach_of(const ColorScale& scale) { return std::max(std::abs(scale.first), std::abs(scale.last)); }

// Of a pixel, 0 to 1.
double error_of(const ImageFigure& figure, std::size_t i) {
  const double error = std::abs(figure.values[i]) / reach_of(figure.scale);
  return std::isnan(error) ? 0.0 : std::min(1.0, error);
}

// The first region, row by row, of the largest sum; nothing without errors.
std::optional<Inset> region_of_most(const Image<double>& errors) {
  const int width = std::min(errors.width, std::max(least_region, errors.width / region_share));
  const int height = std::min(errors.height, std::max(least_region, errors.height / region_share));
  // sums(x, y) is that of all pixels above and left of the corner (x, y).
  Image<double> sums(errors.width + 1, errors.height + 1);
  for (int y = 0; y < errors.height; ++y) {
    double row = 0.0;
    for (int x = 0; x < errors.width; ++x) {
      row += errors.at(x, y);
      sums.at(x + 1, y + 1) = sums.at(x + 1, y) + row;
    }
  }
  std::optional<Inset> best;
  double most = 0.0;
  for (int y = 0; y + height <= errors.height; ++y) {
    for (int x = 0; x + width <= errors.width; ++x) {
      const double sum =
          sums.at(x + width, y + height) - sums.at(x, y + height) - sums.at(x + width, y) + sums.at(x, y);
      // Differences of rounding do not move the region.
      if (sum <= most * (1.0 + 1e-9) || sum <= 1e-9) continue;
      most = sum;
      best = Inset{x, y, width, height};
    }
  }
  return best;
}

const ErrorImage* find(const ErrorImages& errors, const ImageFigure& figure) {
  const auto found = errors.find(figure.stem);
  return found == errors.end() ? nullptr : &found->second;
}

// Error maps tell how wrong a pixel is, causes only that it is.
bool measures_errors(const ErrorImage* error, const ImageFigure& figure) {
  return error != nullptr && error->shows_errors && !error->part.empty() && !figure.values.empty();
}

}  // namespace

Image<float> enlarge_errors(const Image<float>& values, const ColorScale& scale, int dot) {
  const double least = wrong_share * reach_of(scale);
  return enlarge(values, dot, [&](float value) { return std::abs(value) >= least; });
}

Image<std::uint8_t> enlarge_errors(const Image<std::uint8_t>& category, const std::vector<bool>& is_wrong, int dot) {
  return enlarge(category, dot, [&](std::uint8_t each) { return each < is_wrong.size() && is_wrong[each]; });
}

bool has_single_errors(const ImageFigure& figure, const ErrorImage& error) {
  if (!error.shows_errors) return false;
  if (figure.values.empty()) return true;
  const auto right = std::ranges::count_if(figure.values.pixels, [](float value) { return !(std::abs(value) > 0.0f); });
  return 2 * static_cast<std::size_t>(right) >= figure.values.size();
}

Image<glm::u8vec3> colorize_over(const Image<float>& values, const ColorScale& scale,
                                 const Image<std::uint8_t>& backdrop) {
  Image<glm::u8vec3> colors = colorize(values, scale);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double share = std::min(1.0, std::abs(values[i]) / reach_of(scale));
    if (std::isnan(share)) continue;
    // The middle of the scale becomes the picture itself.
    const double factor = glm::mix(std::min(1.0, backdrop[i] / lightest_grey), 1.0, share);
    for (int c = 0; c < 3; ++c) colors[i][c] = static_cast<std::uint8_t>(std::lround(factor * colors[i][c]));
  }
  return colors;
}

std::uint8_t backdrop_grey(double luminance) {
  if (!(luminance >= 0.0)) return 255;
  const double shown = std::pow(std::min(1.0, luminance), 1.0 / 2.4);
  return static_cast<std::uint8_t>(std::lround(glm::mix(darkest_grey, lightest_grey, shown)));
}

void add_worst_insets(const std::vector<Figure>& figures, ErrorImages& errors) {
  std::map<std::string, Image<double>> sums;
  std::vector<const ImageFigure*> images;
  for (const Figure& figure : figures) {
    if (const auto* image = std::get_if<ImageFigure>(&figure)) images.push_back(image);
  }
  for (const ImageFigure* image : images) {
    const ImageFigure& figure = *image;
    const ErrorImage* error = find(errors, figure);
    if (!measures_errors(error, figure)) continue;
    Image<double>& sum = sums[error->part];
    if (sum.empty()) sum = Image<double>(figure.values.width, figure.values.height);
    if (image_size(figure) != ivec2(sum.width, sum.height)) continue;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += error_of(figure, i);
  }
  for (const auto& [part, sum] : sums) {
    const std::optional<Inset> region = region_of_most(sum);
    if (!region) continue;
    for (const ImageFigure* image : images) {
      const auto error = errors.find(image->stem);
      if (error == errors.end() || error->second.part != part) continue;
      if (image_size(*image) == ivec2(sum.width, sum.height)) error->second.insets.push_back(*region);
    }
  }
}

void complete_error_images(std::vector<Figure>& figures, ErrorImages& errors, const FigureStyle& style) {
  const auto is_worst = [](const Inset& inset) { return inset.width == 0; };
  const std::vector<Inset>& asked = style.insets;
  if (std::ranges::any_of(asked, is_worst)) add_worst_insets(figures, errors);
  const bool has_regions = !std::ranges::all_of(asked, is_worst);
  for (Figure& each : figures) {
    auto* const image = std::get_if<ImageFigure>(&each);
    const ErrorImage* error = image != nullptr ? find(errors, *image) : nullptr;
    if (error == nullptr) continue;
    ImageFigure& figure = *image;
    const auto add = [&](const std::string& text) { figure.caption += (figure.caption.empty() ? "" : " ") + text; };
    if (error->shows_errors && !error->backdrop.empty()) add("Behind it, in light grey, the shaded scene.");
    if (const int dot = error_dot(figure, *error, style); dot > 1) {
      add(fmt::format("Wrong pixels{} are enlarged to {} × {} pixels{}.",
                      figure.values.empty() ? "" : ", those beyond half of the scale,", dot, dot,
                      error->insets.empty() && !has_regions ? "" : " outside of the insets"));
    }
    if (!error->insets.empty()) {
      const Inset& region = error->insets.back();
      add(fmt::format("Inset: the region of most error, {}×{} pixels at ({}, {}).", region.width, region.height,
                      region.x, region.y));
    }
  }
}

}  // namespace umbrameter
