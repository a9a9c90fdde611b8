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
#include "experiments/stages.h"

namespace umbrameter {

/// A metric in its own unit or in another one.
struct MetricColumn {
  const Metric* metric = nullptr;
  std::string name;  ///< "edge-roughness", "edge-roughness-texels"
  std::string unit;
  std::size_t other_unit = 0;  ///< 0: its own; else 1 + index into Metric::other_units

  std::string meaning() const;  ///< with the direction: "...; 0 is equal"
};

struct MetricScore {
  MetricColumn column;
  double score = 0.0;
};

/// The columns of a metric: one for each unit, the other units only of shadows, whose light and map are known.
std::vector<MetricColumn> columns_of(const Metric& metric, bool is_shadow);

/// The columns of the metrics that run.metrics names, each once and without those that `described` has, such as mae.
/// Throws Error (usage) for an unknown name.
std::vector<MetricColumn> metric_columns(const RunParams& run, bool is_shadow, const Statistics& described = {});

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

/// The images of a measured quantity. They refer to results of `stages` and must be used before it runs further stages.
ComparedImages compared_visibility(Stages& stages, const Experiment& experiment, std::uint32_t light,
                                   Image<float> drawn);
ComparedImages compared_ao(Stages& stages, const Experiment& experiment, Image<float> drawn);
ComparedImages compared_image(Stages& stages, const Experiment& experiment, ColorImages images);

/// Measures each metric once.
std::vector<MetricScore> score(std::span<const MetricColumn> columns, const ComparedImages& images);

}  // namespace umbrameter
