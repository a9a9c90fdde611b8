#include "techniques/shadow/map_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> split_range_names{"seen", "camera"};
constexpr std::array<std::string_view, 3> map_fit_names{"scene", "view", "bounds"};
constexpr std::array<std::string_view, 3> cascade_fit_names{"tight", "stable", "boxes"};
constexpr std::array<std::string_view, 2> cascade_selection_names{"map", "depth"};
constexpr std::array<std::string_view, 2> warp_names{"none", "lispsm"};

// "0.1,0.2,0.5"; nothing if that is no list of numbers.
std::optional<std::vector<double>> numbers_of(const std::string& text) {
  if (text.empty()) return std::vector<double>{};
  std::optional<std::vector<double>> numbers = parsed_list<double>(text, ',');
  if (numbers && !std::ranges::all_of(*numbers, [](double number) { return std::isfinite(number); })) return {};
  return numbers;
}

}  // namespace

Parameters describe(MapFitParams& params) {
  return Description("shadow")
      .field("split-lambda", params.split_lambda,
             {.unit = "1", .meaning = "splits of the cascades: 1 logarithmic, 0 uniform", .min = 0, .max = 1})
      .field(
          "splits", params.splits,
          {.unit = {}, .meaning = "ends of the first cascades as shares of the range, '0.1,0.2,0.5'; empty: by lambda"})
      .field("cascade-bias", params.cascade_bias,
             {.unit = {},
              .meaning = "factors of the constant bias in the cascades, '1,2,4', or own-range: a bias in 'depth' is a "
                         "share of each cascade's own depth range"})
      .choice("split-range", params.split_range, split_range_names,
              {.unit = {},
               .meaning = "depths that the cascades divide: seen: those seen, camera: near plane to max-distance"})
      .field("max-distance", params.max_distance,
             {.unit = "m",
              .meaning = "with split-range camera: farthest depth that the cascades divide",
              .min = 1e-6,
              .max = 1e12})
      .choice("fit", params.fit, map_fit_names,
              {.unit = {}, .meaning = "area of a directional light's map; with cascades, of the last one"})
      .field("fit-x", params.fit_x, {.unit = "m", .meaning = "with fit bounds: centre of the area, in the world"})
      .field("fit-y", params.fit_y, {.unit = "m", .meaning = "with fit bounds: centre of the area, in the world"})
      .field("fit-z", params.fit_z, {.unit = "m", .meaning = "with fit bounds: centre of the area, in the world"})
      .field("fit-size", params.fit_size,
             {.unit = "m",
              .meaning = "with fit bounds: side of the area, perpendicular to the light",
              .min = 1e-6,
              .max = 1e12})
      .field("fit-depth", params.fit_depth,
             {.unit = "m",
              .meaning = "with fit bounds: depth range of the area about its centre; 0: the scene's",
              .min = 0})
      .choice(
          "cascade-fit", params.cascade_fit, cascade_fit_names,
          {.unit = {},
           .meaning = "area of a cascade; tight: around what is seen, stable: around the camera's frustum, moved in "
                      "whole texels, boxes: around the part of it that lies in the bounding boxes of objects"})
      .choice("cascade-selection", params.selection, cascade_selection_names,
              {.unit = {}, .meaning = "cascade of a receiver: the first that contains it, or by its view depth"})
      .field("cascade-blend", params.blend,
             {.unit = "1",
              .meaning = "share of a cascade's extent over which it is blended into the next, by dithering",
              .min = 0,
              .max = 1})
      .field("fade", params.fade,
             {.unit = "1", .meaning = "last share of shadow.max-distance over which shadows fade", .min = 0, .max = 1})
      .choice("warp", params.warp, warp_names,
              {.unit = {}, .meaning = "warp of a single map fitted to the view: none, or light-space perspective"})
      .field("warp-near", params.warp_near,
             {.unit = "m", .meaning = "start of the view depths that the warp serves best", .min = 0})
      .field("warp-far", params.warp_far,
             {.unit = "m", .meaning = "end of the view depths that the warp serves best", .min = 1e-6})
      .field(
          "pancaking", params.pancaking,
          {.unit = "", .meaning = "start a directional light's depth range at the receivers, clamp casters before it"})
      .field("near-offset", params.near_offset,
             {.unit = "m", .meaning = "pancaking: from the start of the depth range to the nearest receiver", .min = 0})
      .take();
}

int fit_margin(int cascades, const MapFitParams& fit) {
  return cascades == 1 && fit.cascade_fit == CascadeFit::boxes ? 1 : map_view_margin;
}

bool can_warp(int cascades, const MapFitParams& fit) {
  return cascades == 1 && fit.fit == MapFit::view && fit.cascade_fit != CascadeFit::stable;
}

void require_sense(const ShadowMapParams& map, const MapFitParams& fit, std::span<const Light> lights) {
  const bool any_directional = std::ranges::any_of(
      lights, [](const Light& light) { return std::holds_alternative<DirectionalLight>(light.shape); });
  if (any_directional && fit.warp != Warp::none && !can_warp(map.cascades, fit)) {
    throw Error(ExitCode::usage, "shadow.warp", "only a single map that is fitted to the view is warped",
                "use --shadow.cascades 1 --shadow.fit view --shadow.cascade-fit tight or boxes");
  }
  if (any_directional) return;
  const auto refuse = [](const std::string& key) {
    throw Error(ExitCode::usage, key, "no measured light is directional, and only directional lights have cascades",
                "leave it out, or select a directional light with --view.light");
  };
  if (map.cascades != 1) refuse("shadow.cascades");
  MapFitParams given = fit;
  MapFitParams usual;
  const Parameters defaults = describe(usual);
  for (const Parameter& parameter : describe(given)) {
    if (parameter.value() != require(defaults, parameter.key).value()) refuse(parameter.key);
  }
}

std::vector<double> parse_splits(const std::string& text, int count) {
  const std::optional<std::vector<double>> shares = numbers_of(text);
  const auto is_rising = [](const std::vector<double>& each) {
    return std::ranges::adjacent_find(each, std::greater_equal<>()) == each.end() &&
           (each.empty() || (each.front() > 0.0 && each.back() < 1.0));
  };
  if (shares && is_rising(*shares) && static_cast<int>(shares->size()) == count - 1) return *shares;
  throw Error(ExitCode::usage, "shadow.splits",
              "'" + text + "' does not divide a range among " + std::to_string(count) + " cascades",
              "expected " + std::to_string(count - 1) + " rising numbers between 0 and 1, such as 0.1,0.2,0.5 for 4");
}

std::vector<double> parse_cascade_bias(const std::string& text, int count) {
  if (text.empty() || text == own_range) return std::vector<double>(static_cast<std::size_t>(count), 1.0);
  const std::optional<std::vector<double>> factors = numbers_of(text);
  const auto is_positive = [](double factor) { return factor > 0.0; };
  if (factors && std::ranges::all_of(*factors, is_positive) && static_cast<int>(factors->size()) == count) {
    return *factors;
  }
  throw Error(ExitCode::usage, "shadow.cascade-bias",
              "'" + text + "' is not a factor above 0 for each of " + std::to_string(count) +
                  (count == 1 ? " cascade" : " cascades"),
              "expected " + std::to_string(count) + (count == 1 ? " number" : " numbers, such as 1,2,4 for 3") +
                  ", or own-range");
}

}  // namespace umbrameter
