// Edges whose displacement, roughness and penumbra are known, to a hundredth of a pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "compare/metrics/edge_points.h"
#include "core/math.h"

namespace umbrameter {
namespace {

constexpr int image_side = 80;
constexpr int many = 10;

// Each pixel is the mean of a function at this many places along each of its sides. x and y from the image's centre,
// px, y down.
Image<float> drawn(const std::function<double(double x, double y)>& lit, int samples = many) {
  Image<float> image(image_side, image_side);
  for (int y = 0; y < image_side; ++y) {
    for (int x = 0; x < image_side; ++x) {
      double sum = 0.0;
      for (int s = 0; s < samples * samples; ++s) {
        const int row = s / samples;
        sum += lit(x + (s % samples + 0.5) / samples - image_side / 2.0, y + (row + 0.5) / samples - image_side / 2.0);
      }
      image.at(x, y) = static_cast<float>(sum / (samples * samples));
    }
  }
  return image;
}

double ramp(double beyond, double width) { return std::clamp(0.5 + beyond / width, 0.0, 1.0); }

// Lit beyond a straight edge through the centre whose normal has this angle; moved by `bend` of the place along it, and
// a linear ramp of `width`.
Image<float> edge(double angle, const std::function<double(double)>& bend, double width = 0.0) {
  return drawn([&](double x, double y) {
    const double across = x * std::cos(angle) + y * std::sin(angle);
    const double along = y * std::cos(angle) - x * std::sin(angle);
    // A hard edge is as soft as a sample, so that it is not seen where the samples are.
    return ramp(across - bend(along), width == 0.0 ? 1.0 / many : width);
  });
}

Image<float> straight(double angle, double moved, double width = 0.0) {
  return edge(
      angle, [=](double) { return moved; }, width);
}

bool inside(std::size_t pixel) {
  const int x = static_cast<int>(pixel) % image_side - image_side / 2;
  const int y = static_cast<int>(pixel) / image_side - image_side / 2;
  return x * x + y * y < 36 * 36;
}

double score(const Metric& metric, const Image<float>& test, const Image<float>& reference) {
  return metric.measure({test, reference, inside}).score;
}

const double angles[] = {0.0, 0.1, pi / 4, 1.0, pi / 2, 2.3, 4.0};

TEST(Edges, A_displacement_is_found_at_any_angle) {
  for (const double angle : angles) {
    const Image<float> reference = straight(angle, 0.13);
    for (const double moved : {-2.4, 0.0, 0.37, 3.3}) {
      const Image<float> test = straight(angle, 0.13 + moved);
      EXPECT_NEAR(score(edge_displacement_metric, test, reference), moved, 0.01) << angle;
      EXPECT_NEAR(score(edge_roughness_metric, test, reference), 0.0, 0.01) << angle << " " << moved;
    }
  }
}

// The extent along the edge of the points that are found, px: from half a point before the first to half a point after
// the last.
struct Extent {
  double begin = 0.0;
  double length = 0.0;
};
Extent extent_of(const Image<float>& test, const Image<float>& reference, double angle) {
  double least = 1e9;
  double most = -1e9;
  for (const EdgePoint& point : find_edge_points({test, reference, inside})) {
    if (!point.is_found) continue;
    const int row = static_cast<int>(point.pixel) / image_side;
    const double x = static_cast<int>(point.pixel) % image_side + 0.5 - image_side / 2.0;
    const double y = row + 0.5 - image_side / 2.0;
    const double along = y * std::cos(angle) - x * std::sin(angle);
    least = std::min(least, along);
    most = std::max(most, along);
  }
  // One point in each row or column.
  const double spacing = 1.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
  return {least - 0.5 * spacing, most - least + spacing};
}

// Of a whole number of waves, because the part of one has another mean and another RMS. The mean over a pixel's length
// leaves sin(πl)/(πl) of a wave of l per pixel.
TEST(Edges, A_roughness_is_found_at_any_angle) {
  for (const double angle : angles) {
    const Image<float> reference = straight(angle, 0.0);
    const Extent extent = extent_of(straight(angle, 1.3), reference, angle);
    for (const double waves : {3.0, 6.0}) {
      const double wavelength = extent.length / waves;
      for (const double amplitude : {0.2, 0.8}) {
        const auto wave = [&](double along) {
          return 0.5 + amplitude * std::sin(2.0 * pi * (along - extent.begin) / wavelength);
        };
        const Image<float> test = edge(angle, wave);
        const double left = std::sin(pi / wavelength) / (pi / wavelength);
        EXPECT_NEAR(score(edge_roughness_metric, test, reference), left * amplitude / std::sqrt(2.0), 0.01)
            << angle << " " << wavelength << " " << amplitude;
        // At 45° rows and columns find points, whose ends lie at different parts of a wave.
        EXPECT_NEAR(score(edge_displacement_metric, test, reference), 0.5, 0.025) << angle;
      }
    }
  }
}

TEST(Edges, The_width_of_a_penumbra_is_found_at_any_angle) {
  for (const double angle : angles) {
    for (const double width : {3.0, 3.5, 4.0, 6.5, 12.0}) {
      const Image<float> reference = straight(angle, 0.2, 5.0);
      const Image<float> test = straight(angle, 0.5, width);
      EXPECT_NEAR(score(edge_width_metric, test, reference), width - 5.0, 0.01) << angle << " " << width;
      EXPECT_NEAR(score(edge_displacement_metric, test, reference), 0.3, 0.01) << angle;
    }
  }
}

// With one sample at the centre of each pixel, no pixel mixes the ramp with what is beside it.
TEST(Edges, The_width_of_a_penumbra_without_antialiasing_is_found_from_two_pixels_on) {
  for (const double angle : angles) {
    const auto sampled = [&](double width) {
      return drawn([&](double x, double y) { return ramp(x * std::cos(angle) + y * std::sin(angle) - 0.2, width); }, 1);
    };
    for (const double width : {2.0, 2.5, 3.0, 3.7, 8.0}) {
      EXPECT_NEAR(score(edge_width_metric, sampled(width), sampled(5.0)), width - 5.0, 0.01) << angle << " " << width;
    }
  }
}

TEST(Edges, Details_tell_how_many_edges_were_found) {
  const Image<float> reference = straight(0.3, 0.0);
  const MetricResult lost =
      edge_displacement_metric.measure({Image<float>(image_side, image_side, 1.0f), reference, inside});
  EXPECT_TRUE(std::isnan(lost.score)) << "no shadow at all is no edge in another place";
  EXPECT_GT(lost.details[0].second, 60.0);
  EXPECT_EQ(lost.details[1].second, 0.0);
  const MetricResult found = edge_displacement_metric.measure({reference, reference, inside});
  EXPECT_EQ(found.score, 0.0);
  EXPECT_GT(found.details[1].second, 0.9);
}

// With a pixel of 0.02 m and half a texel.
TEST(Edges, Lengths_have_other_units_where_the_scale_is_known) {
  const EdgeScale scale = [](std::size_t, const dvec2&) { return LengthFactors{0.5, 0.02}; };
  const Image<float> reference = straight(0.4, 0.0, 5.0);
  const Image<float> test = edge(
      0.4, [](double along) { return 0.7 + 0.5 * std::sin(along / 3.0); }, 8.0);
  for (const Metric* metric : {&edge_displacement_metric, &edge_roughness_metric, &edge_width_metric}) {
    const MetricResult result = metric->measure({test, reference, inside, scale});
    ASSERT_EQ(result.in_other_units.size(), metric->other_units.size());
    EXPECT_NEAR(result.in_other_units[0], 0.5 * result.score, 1e-6) << metric->name;
    EXPECT_NEAR(result.in_other_units[1], 0.02 * result.score, 1e-6) << metric->name;
    EXPECT_GT(result.score, 0.2) << metric->name;
    EXPECT_TRUE(metric->measure({test, reference, inside}).in_other_units.empty());
  }
}

// The tangent of an edge whose normal is at this angle, y down.
TEST(Edges, Points_know_the_direction_of_their_edge) {
  for (const double angle : angles) {
    const Image<float> reference = straight(angle, 0.2, 4.0);
    std::size_t found = 0;
    for (const EdgePoint& point : find_edge_points({reference, reference, inside})) {
      if (!point.is_found) continue;
      ++found;
      EXPECT_NEAR(glm::dot(point.tangent, dvec2(std::cos(angle), std::sin(angle))), 0.0, 0.02) << angle;
      EXPECT_NEAR(glm::length(point.tangent), 1.0, 1e-9);
    }
    EXPECT_GT(found, 30u);
  }
}

TEST(Edges, The_share_of_found_edges_is_a_score) {
  const Image<float> reference = straight(0.3, 0.0);
  EXPECT_EQ(score(edges_found_metric, reference, reference), 1.0);
  // Half of the edge leads to a penumbra that never ends: that part is not clear enough to be found in anything.
  Image<float> unclear = reference;
  for (std::size_t i = 0; i < unclear.size() / 2; ++i) unclear[i] = std::min(unclear[i], 0.8f);
  EXPECT_EQ(score(edges_found_metric, unclear, unclear), 1.0);
  EXPECT_EQ(score(edges_found_metric, reference, unclear), 1.0);
  EXPECT_EQ(score(edges_found_metric, Image<float>(image_side, image_side, 1.0f), reference), 0.0);
}

}  // namespace
}  // namespace umbrameter
