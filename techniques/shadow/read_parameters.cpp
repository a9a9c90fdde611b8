#include "techniques/shadow/read_parameters.h"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "core/parameter_selection.h"

namespace umbrameter {
namespace {

// A map is fitted to a directional light only; others ignore all of it.
Parameters read_by_fit(MapFitParams& params, int cascades) {
  const Parameters all = describe(params);
  Parameters read = select(all, {"shadow.fit", "shadow.pancaking", "shadow.cascade-bias"});
  const auto add = [&](std::initializer_list<std::string_view> keys) {
    read = concatenate({std::move(read), select(all, keys)});
  };
  if (params.pancaking || params.cascade_bias == own_range) add({"shadow.near-offset"});
  if (params.fit == MapFit::bounds) {
    add({"shadow.fit-x", "shadow.fit-y", "shadow.fit-z", "shadow.fit-size", "shadow.fit-depth"});
  }
  if (can_warp(cascades, params)) {
    add({"shadow.warp"});
    if (params.warp != Warp::none) add({"shadow.warp-near", "shadow.warp-far"});
  }
  if (cascades > 1) add({"shadow.split-lambda", "shadow.splits", "shadow.cascade-blend"});
  if (cascades > 1 || params.fit != MapFit::scene) add({"shadow.cascade-fit"});
  if (cascades > 1 || params.fit == MapFit::view) {
    add({"shadow.split-range", "shadow.cascade-selection"});
    const bool is_by_camera = params.split_range == SplitRange::camera;
    if (is_by_camera) add({"shadow.max-distance"});
    if (is_by_camera && params.fit == MapFit::view && params.selection == CascadeSelection::depth) add({"shadow.fade"});
  }
  return read;
}

Parameters read_offset_texel(ShadowParams& params) {
  const bool is_warped = params.fit.warp != Warp::none && can_warp(params.map.cascades, params.fit);
  if (!is_warped || params.bias.normal_offset.texels == 0.0) return {};
  return select(describe(params.bias), {"shadow.normal-offset-texel"});
}

// What a technique reads besides the size of the map and its fit.
template <class T>
Parameters read_by_technique(ShadowParams& params) {
  if constexpr (FiltersMap<T>) {
    return concatenate(
        {read_parameters(params.map_depth),
         select(describe(params.bias),
                {"shadow.constant-bias", "shadow.slope-bias", "shadow.normal-offset", "shadow.normal-offset-metres",
                 "shadow.normal-offset-profile", "shadow.normal-offset-direction", "shadow.normal-offset-facing"}),
         read_offset_texel(params), T::map_parameters(params), T::lookup_parameters(params)});
  } else {
    return T::reads(params);
  }
}

}  // namespace

Parameters read_parameters(ShadowParams& params) {
  Parameters read = concatenate({{require(describe(params), "shadow.technique")},
                                 select(describe(params.screen_space), {"shadow.contact-shadows"}),
                                 describe(params.map),
                                 read_by_fit(params.fit, params.map.cascades)});
  if (params.screen_space.is_combined) read = concatenate({std::move(read), ScreenSpace::reads(params)});
  const Parameters of_technique = ShadowTechniques::apply<Parameters>(
      params.technique, [&]<class T>(std::type_identity<T>) { return read_by_technique<T>(params); });
  return concatenate({std::move(read), of_technique});
}

Parameters lookup_parameters(ShadowParams& params) {
  if (params.screen_space.is_combined) return {};
  return ShadowTechniques::apply<Parameters>(params.technique, [&]<class T>(std::type_identity<T>) -> Parameters {
    if constexpr (FiltersMap<T>) {
      return concatenate(
          {select(describe(params.bias), {"shadow.constant-bias", "shadow.slope-bias"}), T::lookup_parameters(params)});
    }
    return {};
  });
}

}  // namespace umbrameter
