// The filters over shadow-map taps: which texels a filter reads and what each weighs.
#pragma once

#include <string>

#include "core/shadow_taps.h"
#include "raster/parameters.h"

namespace umbrameter {

/// Box: equal weights. Tent: 1 2 … 2 1. Gaussian: standard deviation (filter_size + 1) / 6 texels, weights rounded to
/// 1/128 along each side. Bilinear: one linear tap, what `sampler2DShadow` with a linear filter computes. Poisson: best
/// candidates (D. Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991).
FilterKernel make_filter(const ShadowParams& params);

/// The kernel as shaders/shadow_filter.glsl reads it. The radius is not part of it.
std::string filter_defines(const FilterKernel& filter);

}  // namespace umbrameter
