// Presents the error of ambient occlusion by stage.
#pragma once

#include "present/presentation.h"

namespace umbrameter {

/// The measurement must have stages.
Presentation present_ao_stages(const LayeredImage& layers, const AoMeasurement& ao);

/// What each stage changes in each pixel.
void add_ao_stage_figures(Presentation& presentation, const LayeredImage& layers);

/// The stages' signed means as a sum.
WaterfallFigure ao_stages_waterfall(const AoStageStatistics& statistics);

}  // namespace umbrameter
