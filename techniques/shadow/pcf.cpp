#include "techniques/shadow/pcf.h"

#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

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

}  // namespace

Pcf Pcf::make(const ShadowParams& params, double) { return {make_filter(params.pcf)}; }

Parameters Pcf::reads(ShadowParams& params) {
  return concatenate({read_parameters(params.map_depth), describe(params.bias), read_by_kernel(params.pcf)});
}

Pcss Pcss::make(const ShadowParams& params, double light_extent) {
  return {make_pcss_filter(params.pcf, params.pcss, light_extent)};
}

Parameters Pcss::reads(ShadowParams& params) {
  return concatenate({read_parameters(params.map_depth), describe(params.bias), read_by_found_disk(params.pcf),
                      describe(params.pcss)});
}

Dpcf Dpcf::make(const ShadowParams& params, double light_extent) {
  return {make_dpcf_filter(params.pcf, params.pcss, light_extent)};
}

Parameters Dpcf::reads(ShadowParams& params) {
  return concatenate({read_parameters(params.map_depth), describe(params.bias), read_by_found_disk(params.pcf),
                      select(describe(params.pcss), {"shadow.pcss-light-scale", "shadow.pcss-max-radius"})});
}

}  // namespace umbrameter
