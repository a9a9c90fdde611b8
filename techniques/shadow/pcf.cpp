#include "techniques/shadow/pcf.h"

#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

// A disk whose radius PCSS or DPCF finds.
Parameters read_by_found_disk(PcfParams& params) {
  return select(describe(params), {"shadow.filter", "shadow.filter-samples", "shadow.filter-rotation"});
}

}  // namespace

Pcf Pcf::make(const ShadowParams& params, double) { return {make_filter(params.pcf)}; }

Parameters Pcf::reads(ShadowParams& params) {
  return concatenate({read_parameters(params.map_depth), describe(params.bias), read_parameters(params.pcf)});
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
