// Ambient-occlusion error against a sampled reference, with the interval that the sampling leaves.
#pragma once

#include <vector>

#include "compare/sampled_error.h"
#include "compare/table.h"
#include "core/gbuffer.h"
#include "core/image.h"

namespace umbrameter {

/// Over all surfels; accessibility, 1 is open.
using AoStatistics = SampledError;

AoStatistics analyze_ao(const Image<float>& raster, const SampledImage& truth, const GBuffer& gbuffer);

/// The statistics as one row, in the order of ao_columns(): the measured columns of an AO sweep.
std::vector<Column> ao_columns();
std::vector<Value> to_row(const AoStatistics& statistics);

}  // namespace umbrameter
