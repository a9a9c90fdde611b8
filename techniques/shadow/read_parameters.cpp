#include "techniques/shadow/read_parameters.h"

#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include "core/parameter_selection.h"

namespace umbrameter {
namespace {

// A map is fitted to a directional light only; others ignore all of it.
Parameters read_by_fit(MapFitParams& params, int cascades) {
  const Parameters all = describe(params);
  Parameters read = select(all, {"shadow.fit", "shadow.pancaking"});
  const auto add = [&](std::initializer_list<std::string_view> keys) {
    read = concatenate({std::move(read), select(all, keys)});
  };
  if (params.pancaking) add({"shadow.near-offset"});
  if (params.fit == MapFit::bounds) add({"shadow.fit-x", "shadow.fit-y", "shadow.fit-z", "shadow.fit-size"});
  if (cascades > 1) add({"shadow.split-lambda", "shadow.cascade-blend"});
  if (cascades > 1 || params.fit != MapFit::scene) add({"shadow.cascade-fit"});
  if (cascades > 1 || params.fit == MapFit::view) {
    add({"shadow.split-range", "shadow.cascade-selection"});
    if (params.split_range == SplitRange::camera) add({"shadow.max-distance"});
  }
  return read;
}

// Some depends on the kind of light as well.
Parameters read_by_map(MapDepthParams& params) {
  Parameters read = describe(params);
  std::erase_if(read, [&](const Parameter& each) {
    return (each.key == "shadow.depth-near" && params.encoding == DepthEncoding::linear) ||
           (each.key == "shadow.dual-offset" && params.surface != StoredSurface::dual);
  });
  return read;
}

Parameters read_by_kernel(PcfParams& params) {
  const Parameters all = describe(params);
  switch (params.filter) {
    case ShadowFilter::nearest:
    case ShadowFilter::bilinear:
      return select(all, {"shadow.filter"});
    case ShadowFilter::box:
    case ShadowFilter::tent:
    case ShadowFilter::gaussian:
      return select(all, {"shadow.filter", "shadow.filter-size", "shadow.filter-taps"});
    case ShadowFilter::optimized:
    case ShadowFilter::area_tent:
      return select(all, {"shadow.filter", "shadow.filter-size"});
    case ShadowFilter::poisson:
    case ShadowFilter::vogel:
      break;
  }
  return select(all, {"shadow.filter", "shadow.filter-samples", "shadow.filter-radius", "shadow.filter-rotation"});
}

// A disk whose radius PCSS or DPCF finds.
Parameters read_by_found_disk(PcfParams& params) {
  return select(describe(params), {"shadow.filter", "shadow.filter-samples", "shadow.filter-rotation"});
}

// The constant of prefiltered.glsl for a technique that looks up a filtered map.
std::optional<int> filtered_map_of(ShadowTechniqueName technique) {
  switch (technique) {
    case ShadowTechniqueName::esm:
      return shared::ESM;
    case ShadowTechniqueName::vsm:
      return shared::VSM;
    case ShadowTechniqueName::evsm2:
      return shared::EVSM2;
    case ShadowTechniqueName::evsm4:
      return shared::EVSM4;
    case ShadowTechniqueName::msm:
      return shared::MSM;
    case ShadowTechniqueName::csm:
      return shared::CSM;
    default:
      return std::nullopt;
  }
}

Parameters read_by_filter(int technique, EsmParams& esm, MomentMapParams& map) {
  const Parameters all = describe(map);
  const Parameters of_all = select(all, {"shadow.blur-kernel", "shadow.moment-samples", "shadow.moment-mipmaps"});
  if (technique == shared::ESM) return concatenate({describe(esm), of_all});
  const Parameters of_moments = concatenate({of_all, select(all, {"shadow.moment-blur", "shadow.moment-format"})});
  switch (technique) {
    case shared::EVSM2:
      return concatenate({of_moments, select(all, {"shadow.evsm-positive-exponent"})});
    case shared::EVSM4:
      return concatenate({of_moments, select(all, {"shadow.evsm-positive-exponent", "shadow.evsm-negative-exponent"})});
    case shared::CSM:
      return concatenate({of_moments, select(all, {"shadow.csm-terms"})});
    default:
      return of_moments;
  }
}

// What the look-up reads as uniforms, so that one pass over the pixels can vary it.
Parameters lookup_uniforms(int technique, MomentLookupParams& lookup) {
  const Parameters all = describe(lookup);
  switch (technique) {
    case shared::VSM:
    case shared::EVSM2:
    case shared::EVSM4:
      return select(all, {"shadow.min-variance", "shadow.bleeding-reduction"});
    case shared::MSM:
      return select(all, {"shadow.msm-moment-bias", "shadow.bleeding-reduction"});
    case shared::CSM:
      return select(all, {"shadow.csm-ringing-reduction", "shadow.csm-contrast"});
    default:
      return {};
  }
}

// What a technique that reads a map reads besides that map.
Parameters read_by_lookup(ShadowParams& params) {
  const Parameters bias = describe(params.bias);
  if (const std::optional<int> filtered = filtered_map_of(params.technique)) {
    return concatenate(
        {select(bias, {"shadow.constant-bias", "shadow.slope-bias", "shadow.normal-offset"}),
         read_by_filter(*filtered, params.esm, params.moment_map), lookup_uniforms(*filtered, params.moment_lookup),
         *filtered == shared::MSM ? select(describe(params.moment_lookup), {"shadow.msm-bound"}) : Parameters{}});
  }
  switch (params.technique) {
    case ShadowTechniqueName::pcss:
      return concatenate({bias, read_by_found_disk(params.pcf), describe(params.pcss)});
    case ShadowTechniqueName::dpcf:
      return concatenate({bias, read_by_found_disk(params.pcf),
                          select(describe(params.pcss), {"shadow.pcss-light-scale", "shadow.pcss-max-radius"})});
    default:
      return concatenate({bias, read_by_kernel(params.pcf)});
  }
}

}  // namespace

Parameters read_parameters(ShadowParams& params) {
  const Parameters switches = concatenate({{require(describe(params), "shadow.technique")},
                                           select(describe(params.screen_space), {"shadow.contact-shadows"})});
  Parameters read = concatenate({switches, describe(params.map), read_by_fit(params.fit, params.map.cascades)});
  const bool is_march = params.technique == ShadowTechniqueName::screen_space;
  if (is_march || params.screen_space.is_combined) {
    read =
        concatenate({std::move(read), select(describe(params.screen_space),
                                             {"shadow.screen-length", "shadow.screen-steps", "shadow.screen-thickness",
                                              "shadow.screen-bias", "shadow.screen-jitter", "shadow.screen-plane"})});
  }
  // Which kind of map a point light has decides which of its pixels are counted.
  if (is_march) return concatenate({std::move(read), select(describe(params.map_depth), {"shadow.point-map"})});
  return concatenate({std::move(read), read_by_map(params.map_depth), read_by_lookup(params)});
}

Parameters lookup_parameters(ShadowParams& params) {
  const std::optional<int> filtered = filtered_map_of(params.technique);
  if (!filtered || params.screen_space.is_combined) return {};
  return concatenate({select(describe(params.bias), {"shadow.constant-bias", "shadow.slope-bias"}),
                      lookup_uniforms(*filtered, params.moment_lookup)});
}

}  // namespace umbrameter
