#include "compare/metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/metrics/color_metric.h"
#include "compare/metrics/color_space.h"
#include "compare/metrics/separable_filter.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

// The paper's constants (table 1 and sections 4.1 to 4.3).
constexpr double color_exponent = 0.7;     // q_c
constexpr double color_knee = 0.4;         // p_c: share of the largest colour difference that maps to color_knee_error
constexpr double color_knee_error = 0.95;  // p_t
constexpr double feature_exponent = 0.5;   // q_f
constexpr double feature_width = 0.082;    // w: width of the feature detector [degrees]

// A term a·√(π/b)·exp(−π²x²/b) of a contrast sensitivity function in space, x in degrees. Luminance and red-green have
// one term, yellow-blue two.
struct SensitivityTerm {
  double a = 0.0;
  double b = 0.0;
};
constexpr SensitivityTerm luminance_term{1.0, 0.0047};
constexpr SensitivityTerm red_green_term{1.0, 0.0053};
constexpr std::array<SensitivityTerm, 2> yellow_blue_terms = {{{34.1, 0.04}, {13.5, 0.025}}};

// Three standard deviations of the widest term, σ = √(b/2π²), for all of them.
int sensitivity_radius(double pixels_per_degree) {
  return static_cast<int>(std::ceil(3.0 * std::sqrt(yellow_blue_terms[0].b / (2.0 * pi * pi)) * pixels_per_degree));
}

// In two dimensions a term is the product of a row and a column of √(a·√(π/b))·exp(−π²x²/b), and the terms of a channel
// sum to 1 over all pixels of the kernel.
std::vector<Kernel> sensitivity_kernels(std::span<const SensitivityTerm> terms, double pixels_per_degree) {
  const int radius = sensitivity_radius(pixels_per_degree);
  const auto weight = [&](const SensitivityTerm& term, int d) {
    const double x = d / pixels_per_degree;
    return std::sqrt(term.a * std::sqrt(pi / term.b)) * std::exp(-pi * pi * x * x / term.b);
  };
  double total = 0.0;
  for (const SensitivityTerm& term : terms) {
    double sum = weight(term, 0);
    for (int d = 1; d <= radius; ++d) sum += 2.0 * weight(term, d);
    total += sum * sum;
  }
  std::vector<Kernel> kernels;
  for (const SensitivityTerm& term : terms) {
    Kernel& kernel = kernels.emplace_back();
    for (int d = 0; d <= radius; ++d) {
      kernel.weights.push_back(static_cast<float>(weight(term, d) / std::sqrt(total)));
    }
  }
  return kernels;
}

// A Gaussian and its first and second derivative. The positive weights of each derivative sum to 1, the negative to −1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree) {
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto gaussian = [&](int d) { return std::exp(-d * d / (2.0 * sigma * sigma)); };
  const auto second = [&](int d) { return (d * d / (sigma * sigma) - 1.0) * gaussian(d); };
  double edge_sum = 0.0;
  double positive = 0.0;
  double negative = -second(0);
  for (int d = 1; d <= radius; ++d) {
    edge_sum += d * gaussian(d);
    (second(d) > 0.0 ? positive : negative) += 2.0 * std::abs(second(d));
  }
  FeatureKernels kernels{gaussian_kernel(sigma, radius), {KernelKind::odd, {0.0f}}, {KernelKind::zero_sum, {0.0f}}};
  for (int d = 1; d <= radius; ++d) {
    kernels.edge.weights.push_back(static_cast<float>(d * gaussian(d) / edge_sum));
    kernels.point.weights.push_back(static_cast<float>(second(d) / (second(d) > 0.0 ? positive : negative)));
  }
  return kernels;
}

// What the two pipelines of the paper make of one image.
struct Perceived {
  std::array<Image<float>, 3> ycxcz;  // blurred as the eye blurs it, per channel
  Image<float> edges_x, edges_y;      // derivatives of the luminance, 0 to 1
  Image<float> points_x, points_y;    // second derivatives
};

Perceived perceive(const Image<vec3>& image, double pixels_per_degree) {
  std::array<Image<float>, 3> planes;
  for (Image<float>& plane : planes) plane = Image<float>(image.width, image.height);
  Image<float> gray(image.width, image.height);
  const auto width = static_cast<std::size_t>(image.width);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const dvec3 color = ycxcz_from_rgb(glm::clamp(dvec3(image[i]), 0.0, 1.0));
      for (std::size_t c = 0; c < 3; ++c) planes[c][i] = static_cast<float>(color[static_cast<int>(c)]);
      gray[i] = static_cast<float>((color.x + 16.0) / 116.0);
    }
  });
  Perceived result;
  const auto one_term = [&](const SensitivityTerm& term) {
    return sensitivity_kernels(std::span(&term, 1), pixels_per_degree).front();
  };
  const Kernel luminance_kernel = one_term(luminance_term);
  const Kernel red_green_kernel = one_term(red_green_term);
  const std::vector<Kernel> yellow_blue = sensitivity_kernels(yellow_blue_terms, pixels_per_degree);
  result.ycxcz[0] = filtered(planes[0], luminance_kernel, luminance_kernel);
  result.ycxcz[1] = filtered(planes[1], red_green_kernel, red_green_kernel);
  result.ycxcz[2] = filtered(planes[2], yellow_blue[0], yellow_blue[0]);
  const Image<float> second = filtered(planes[2], yellow_blue[1], yellow_blue[1]);
  for (std::size_t i = 0; i < second.size(); ++i) result.ycxcz[2][i] += second[i];

  const FeatureKernels feature = feature_kernels(pixels_per_degree);
  result.edges_x = filtered(gray, feature.edge, feature.smooth);
  result.edges_y = filtered(gray, feature.smooth, feature.edge);
  result.points_x = filtered(gray, feature.point, feature.smooth);
  result.points_y = filtered(gray, feature.smooth, feature.point);
  return result;
}

// CIELAB with chroma that fades with lightness (Hunt, Light and dark adaptation and the perception of color, 1952).
dvec3 hunt_adjusted(dvec3 lab) {
  lab.y *= 0.01 * lab.x;
  lab.z *= 0.01 * lab.x;
  return lab;
}

// HyAB: city-block in lightness, Euclidean in chroma (Abasi, Tehran and Fairchild, Distance metrics for very large
// color differences, 2020).
double hyab(const dvec3& a, const dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// The difference of green and blue, the largest within sRGB.
double largest_color_difference() {
  return std::pow(hyab(hunt_adjusted(lab_from_rgb({0.0, 1.0, 0.0})), hunt_adjusted(lab_from_rgb({0.0, 0.0, 1.0}))),
                  color_exponent);
}

dvec3 perceived_color(const Perceived& image, std::size_t i) {
  const dvec3 ycxcz(image.ycxcz[0][i], image.ycxcz[1][i], image.ycxcz[2][i]);
  return hunt_adjusted(lab_from_rgb(glm::clamp(rgb_from_ycxcz(ycxcz), 0.0, 1.0)));
}

// Small differences, up to the knee, take most of the range.
double color_error(const dvec3& test, const dvec3& reference) {
  static const double largest = largest_color_difference();
  constexpr double at_knee = color_knee_error;
  const double knee = color_knee * largest;
  const double difference = std::pow(hyab(test, reference), color_exponent);
  return difference < knee ? at_knee / knee * difference
                           : at_knee + (difference - knee) / (largest - knee) * (1.0 - at_knee);
}

double feature_error(const Perceived& test, const Perceived& reference, std::size_t i) {
  const auto length = [&](const Image<float>& x, const Image<float>& y) {
    return std::hypot(static_cast<double>(x[i]), static_cast<double>(y[i]));
  };
  const double edge = std::abs(length(reference.edges_x, reference.edges_y) - length(test.edges_x, test.edges_y));
  const double point = std::abs(length(reference.points_x, reference.points_y) - length(test.points_x, test.points_y));
  return std::pow(std::max(edge, point) / std::sqrt(2.0), feature_exponent);
}

}  // namespace

Image<float> flip_map(const Image<vec3>& test, const Image<vec3>& reference, double pixels_per_degree) {
  const Perceived seen_test = perceive(test, pixels_per_degree);
  const Perceived seen_reference = perceive(reference, pixels_per_degree);
  Image<float> map(test.width, test.height);
  const auto width = static_cast<std::size_t>(test.width);
  parallel_for(static_cast<std::size_t>(test.height), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const double color = color_error(perceived_color(seen_test, i), perceived_color(seen_reference, i));
      map[i] = static_cast<float>(std::pow(color, 1.0 - feature_error(seen_test, seen_reference, i)));
    }
  });
  return map;
}

const Metric ldr_flip_metric = {
    .name = "ldr-flip",
    .title = "LDR-FLIP",
    .unit = "1",
    .range = "0 to 1, 0 is equal",
    .formula = "mean of ΔE_c^(1 − ΔE_f), ΔE_c the colour difference and ΔE_f the feature difference of a pixel",
    .source = "Andersson et al., FLIP: A Difference Evaluator for Alternating Images, 2020",
    .measure_color = [](const ColorInput& input) {
      const float scale = exposure_factor(input);
      const auto exposed = [&](Image<vec3> image) {
        for (vec3& color : image.pixels) color *= scale;
        return image;
      };
      return mean_of_map(flip_map(exposed(input.test), exposed(input.reference), input.params.pixels_per_degree),
                         input.is_counted);
    }};

}  // namespace umbrameter
