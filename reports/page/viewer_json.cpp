#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "reports/figures/color_table.h"
#include "reports/files/markup.h"
#include "reports/page/plane.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// Larger images lose every second row and column, unless all pixels were asked for.
constexpr std::size_t most_pixels_in_full = 640 * 360;

constexpr const char* kind_names[] = {"share", "error", "number", "category", "color", "vector"};
constexpr const char* role_names[] = {"reference", "technique", "error", "cause", "other"};

std::string table_text(ColorMap map) {
  std::string bytes;
  for (const glm::u8vec3& color : color_table(map)) {
    for (int c = 0; c < 3; ++c) bytes += static_cast<char>(color[c]);
  }
  return to_base64(bytes);
}

// Of the finite values.
std::pair<double, double> range_of(const Image<float>& image) {
  std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (const float value : image.pixels) {
    if (!std::isfinite(value)) continue;
    range = {std::min<double>(range.first, value), std::max<double>(range.second, value)};
  }
  return range.first <= range.second ? range : std::pair(0.0, 1.0);
}

Json layer_json(const ViewerLayer& layer, int stride) {
  Json json = {{"name", layer.name},
               {"title", layer.title},
               {"group", layer.group},
               {"role", role_names[static_cast<std::size_t>(layer.role)]},
               {"kind", kind_names[static_cast<std::size_t>(layer.kind)]},
               {"unit", layer.unit}};
  std::pair<double, double> range(0.0, 1.0);
  if (layer.kind == ViewerKind::number) range = range_of(layer.planes.front());
  if (layer.kind == ViewerKind::error || layer.kind == ViewerKind::vector) range = {-layer.reach, layer.reach};
  json["range"] = {range.first, range.second};
  json["categories"] = Json::array();
  for (const CategoryColor& each : layer.categories) {
    json["categories"].push_back({{"name", each.name}, {"color", {each.color.x, each.color.y, each.color.z}}});
  }
  json["planes"] = Json::array();
  for (const Image<float>& plane : layer.planes) json["planes"].push_back(plane_json(plane, stride));
  return json;
}

Json bias_json(const ViewerBias& bias, int stride) {
  Json json = {{"group", bias.group},           {"missing", bias.missing}, {"unit", bias.unit},
               {"mean_texel", bias.mean_texel}, {"used", bias.used},       {"axis", bias.axis},
               {"shares", Json::array()}};
  for (const auto& [acne, false_occlusion, peter_panning, leak] : bias.shares) {
    json["shares"].push_back({acne, false_occlusion, peter_panning, leak});
  }
  if (bias.missing.empty()) {
    json["bin"] = plane_json(bias.bin, stride);
    json["cause"] = plane_json(bias.cause, stride);
  }
  return json;
}

Json parts_json(const ViewerParts& parts, int stride) {
  if (parts.names.empty()) return {};
  return {{"names", parts.names}, {"plane", plane_json(parts.index, stride)}};
}

}  // namespace

Json viewer_json(const ViewerData& data) {
  const std::size_t pixels = static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height);
  const int stride = data.full || pixels <= most_pixels_in_full ? 1 : 2;
  Json json = {{"title", data.title},
               {"width", data.width},
               {"height", data.height},
               {"stride", stride},
               {"maps", {{"sequential", table_text(ColorMap::visibility)}, {"diverging", table_text(ColorMap::error)}}},
               {"layers", Json::array()},
               {"biases", Json::array()},
               {"objects", parts_json(data.objects, stride)},
               {"materials", parts_json(data.materials, stride)}};
  std::vector<Json> layers(data.layers.size());
  parallel_for(layers.size(), [&](std::size_t i) { layers[i] = layer_json(data.layers[i], stride); });
  for (Json& layer : layers) json["layers"].push_back(std::move(layer));
  for (const ViewerBias& bias : data.biases) json["biases"].push_back(bias_json(bias, stride));
  return json;
}

}  // namespace umbrameter
