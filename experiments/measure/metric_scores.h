// The image metrics that run.metrics names, of any pair of images: shadows, ambient occlusion and shaded images. They
// are computed only when named.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "compare/metrics/color_metric.h"
#include "core/statistics.h"
#include "experiments/stages/stages.h"

namespace umbrameter {

struct ScalarImages {
  Image<float> test, reference;
};
struct ColorImages {
  Image<vec3> test, reference;  ///< linear radiance
  double exposure = 1.0;        ///< factor for the display
};

/// Technique and reference, of the same size, and the pixels that count.
struct ComparedImages {
  std::variant<ScalarImages, ColorImages> images;
  std::function<bool(std::size_t)> is_counted;
  EdgeScale edge_scale{};
};

/// The images of a measured quantity.
ComparedImages compared_visibility(Stages& stages, const Experiment& experiment, std::uint32_t light,
                                   Image<float> drawn);
ComparedImages compared_ao(Stages& stages, const Experiment& experiment, Image<float> drawn);
ComparedImages compared_image(Stages& stages, const Experiment& experiment, ColorImages images);

/// Whether a pixel is left out; empty: none is.
using LeftOut = std::function<bool(std::size_t)>;

/// Measures each metric once.
std::vector<MetricScore> score(std::span<const MetricColumn> columns, const ComparedImages& images,
                               const LeftOut& is_left_out = {});

}  // namespace umbrameter
