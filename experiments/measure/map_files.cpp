#include "experiments/measure/map_files.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace umbrameter {
namespace {

// Shortest digits that give the same number.
std::string matrix_text(const dmat4& matrix) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += fmt::format("{}{}", text.empty() ? "" : " ", matrix[column][row]);
    }
  }
  return text;
}

Image<float> in_metres(const Image<float>& stored, double far_depth) {
  Image<float> depth = stored;
  for (float& value : depth.pixels) {
    value = value < 1.0f ? static_cast<float>(static_cast<double>(value) * far_depth)
                         : std::numeric_limits<float>::infinity();
  }
  return depth;
}

// Exact up to 2^24 triangles; −1 where there is none.
Image<float> as_numbers(const Image<std::uint32_t>& ids) {
  Image<float> numbers(ids.width, ids.height);
  for (std::size_t i = 0; i < ids.size(); ++i) numbers[i] = ids[i] == no_id ? -1.0f : static_cast<float>(ids[i]);
  return numbers;
}

// The components as channels X, Y, Z and W.
void add_values(LayeredImage& file, const std::string& layer, const Image<vec4>& values) {
  for (int component = 0; component < 4; ++component) {
    Image<float> channel(values.width, values.height);
    for (std::size_t i = 0; i < values.size(); ++i) channel[i] = values[i][component];
    file.channels.push_back({fmt::format("{}.{}", layer, "XYZW"[component]), std::move(channel)});
  }
}

}  // namespace

std::string map_file_name(const Stages& stages, std::uint32_t light) {
  return "shadow_map_" + stages.layer(light) + ".exr";
}

LayeredImage map_layers(Stages& stages, const Experiment& experiment, std::uint32_t light) {
  static constexpr std::array<std::string_view, 4> kinds{"orthographic", "perspective", "cube", "paraboloid"};
  const MapLayout layout = *stages.layout(experiment, light);
  const ShadowMapImages images = stages.read_map(experiment, light);
  const std::vector<Image<vec4>> filtered = stages.read_filtered_map(experiment, light);
  LayeredImage file;
  for (std::size_t view = 0; view < layout.views.size(); ++view) {
    const std::string name = fmt::format("view{}_", view);
    add_layer(file, name + "depth", in_metres(images.depth[view], layout.far_depth));
    add_layer(file, name + "instance", as_numbers(images.instance[view]));
    add_layer(file, name + "triangle", as_numbers(images.triangle[view]));
    const std::size_t layers = filtered.size() / layout.views.size();
    for (std::size_t layer = 0; layer < layers; ++layer) {
      add_values(file, fmt::format("{}filtered{}", name, layer), filtered[view * layers + layer]);
    }
    file.attributes[name + "center"] = fmt::format("{} {}", layout.views[view].center.x, layout.views[view].center.y);
    file.attributes[name + "half_extent"] = fmt::format("{}", layout.views[view].half_extent);
  }
  if (const auto& warp = layout.warp) {
    file.attributes["warp"] = fmt::format("{} {} {} {} {} {}", warp->center.x, warp->center.y, warp->scale.x,
                                          warp->scale.y, warp->shift.x, warp->shift.y);
  }
  file.attributes["kind"] = kinds[static_cast<std::size_t>(layout.kind)];
  file.attributes["light"] = stages.title(light);
  file.attributes["light_from_world"] = matrix_text(layout.light_from_world);
  file.attributes["far_depth"] = fmt::format("{}", layout.far_depth);
  Experiment described = experiment;
  for (const Parameter& parameter : describe(described.shadow)) {
    file.attributes[parameter.key] = to_string(parameter.value());
  }
  return file;
}

}  // namespace umbrameter
