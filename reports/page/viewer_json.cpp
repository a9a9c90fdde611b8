#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.h"
#include "core/parallel.h"
#include "reports/figures/color_table.h"
#include "reports/files/markup.h"
#include "reports/page/cells.h"
#include "reports/page/plane.h"
#include "reports/page/script_text.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// Larger images lose every second row and column, unless all pixels were asked for.
constexpr std::size_t most_pixels_in_full = std::size_t{1920} * 1080;

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

// The index of an item; equal ones have the same.
std::size_t place_of(ViewerPack& pack, const Json& item) {
  std::string text = script_text(item);
  const auto known = std::ranges::find(pack.items, text);
  const std::ptrdiff_t place = known - pack.items.begin();
  if (known == pack.items.end()) pack.items.push_back(std::move(text));
  return static_cast<std::size_t>(place);
}

// The share of this role in the layer's group, if the layer is an error.
const ViewerLayer* share_of(const ViewerData& data, const ViewerLayer& error, ViewerRole role) {
  if (error.role != ViewerRole::error) return nullptr;
  const auto found = std::ranges::find_if(data.layers, [&](const ViewerLayer& each) {
    return each.group == error.group && each.role == role && each.kind == ViewerKind::share;
  });
  return found != data.layers.end() ? &*found : nullptr;
}

std::vector<Json> layer_planes(const ViewerData& data, const ViewerLayer& layer, int stride) {
  const ViewerLayer* const reference = share_of(data, layer, ViewerRole::reference);
  const ViewerLayer* const technique = share_of(data, layer, ViewerRole::technique);
  if (reference != nullptr && technique != nullptr) {
    if (data.rounded) return {};
    return {difference_json(layer.planes[0], technique->planes[0], reference->planes[0], stride)};
  }
  // The reference is the same in most cells: in full it is stored once.
  const bool is_picture = layer.kind == ViewerKind::color && layer.role == ViewerRole::other;
  const bool is_rounded = (data.rounded || is_picture) && layer.role != ViewerRole::reference;
  const PlaneDigits digits = !is_rounded                       ? PlaneDigits::half
                             : layer.kind == ViewerKind::share ? PlaneDigits::byte
                                                               : PlaneDigits::few;
  return planes_json(layer.planes, stride, digits);
}

Json layer_json(const ViewerLayer& layer) {
  Json json = {{"name", layer.name},
               {"title", layer.title},
               {"group", layer.group},
               {"role", role_names[static_cast<std::size_t>(layer.role)]},
               {"kind", kind_names[static_cast<std::size_t>(layer.kind)]},
               {"unit", layer.unit},
               {"reach", layer.reach}};
  std::pair<double, double> range(0.0, 1.0);
  if (layer.kind == ViewerKind::number) range = range_of(layer.planes.front());
  if (layer.kind == ViewerKind::error || layer.kind == ViewerKind::vector) range = {-layer.reach, layer.reach};
  json["range"] = {range.first, range.second};
  json["categories"] = Json::array();
  for (const CategoryColor& each : layer.categories) {
    json["categories"].push_back({{"name", each.name}, {"color", {each.color.x, each.color.y, each.color.z}}});
  }
  json["planes"] = Json::array();
  return json;
}

Json bias_json(ViewerPack& pack, const ViewerBias& bias, int stride) {
  Json json = {{"group", bias.group},
               {"missing", bias.missing},
               {"unit", bias.unit},
               {"unit_length", bias.unit_length},
               {"mean_texel", bias.mean_texel},
               {"texels_differ", bias.texels_differ},
               {"used", bias.used},
               {"axis", bias.axis},
               {"shares", Json::array()}};
  for (const auto& [acne, false_occlusion, peter_panning, leak] : bias.shares) {
    json["shares"].push_back(
        {eight_digits(acne), eight_digits(false_occlusion), eight_digits(peter_panning), eight_digits(leak)});
  }
  if (bias.missing.empty()) {
    json["bin"] = place_of(pack, plane_json(bias.bin, bias.cause, stride));
    json["cause"] = place_of(pack, plane_json(bias.cause, stride));
  }
  return json;
}

Json parts_json(ViewerPack& pack, const ViewerParts& parts, int stride) {
  if (parts.names.empty()) return {};
  return place_of(pack, {{"names", parts.names}, {"plane", plane_json(parts.index, stride)}});
}

}  // namespace

void add_set(ViewerPack& pack, const ViewerData& data) {
  const std::size_t pixels = static_cast<std::size_t>(data.width) * static_cast<std::size_t>(data.height);
  const int stride = data.full || pixels <= most_pixels_in_full ? 1 : 2;
  Json json = {{"width", data.width},     {"height", data.height},   {"stride", stride},
               {"rounded", data.rounded}, {"layers", Json::array()}, {"biases", Json::array()}};
  std::vector<std::vector<Json>> planes(data.layers.size());
  parallel_for(planes.size(), [&](std::size_t i) { planes[i] = layer_planes(data, data.layers[i], stride); });
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Json& layer = json["layers"].emplace_back(layer_json(data.layers[i]));
    for (const Json& plane : planes[i]) layer["planes"].push_back(place_of(pack, plane));
  }
  for (const ViewerBias& bias : data.biases) json["biases"].push_back(bias_json(pack, bias, stride));
  json["objects"] = parts_json(pack, data.objects, stride);
  json["materials"] = parts_json(pack, data.materials, stride);
  if (data.cell) {
    json["cell"] = {{"number", data.cell->number}, {"reason", data.cell->reason}, {"bias_axis", data.cell->bias_axis}};
  }
  if (!data.title.empty()) json["title"] = data.title;
  for (const ViewerLayer& layer : data.layers) pack.layers.insert(layer.name);
  pack.sets.push_back(script_text(json));
}

std::string viewer_text(const ViewerPack& pack) {
  const Json maps = {{"sequential", table_text(ColorMap::visibility)}, {"diverging", table_text(ColorMap::error)}};
  return "{\"title\":" + script_text(pack.title) + ",\"maps\":" + script_text(maps) + ",\"sets\":[" +
         joined(pack.sets, ",") + "],\"items\":[" + joined(pack.items, ",") + "]}";
}

}  // namespace umbrameter
