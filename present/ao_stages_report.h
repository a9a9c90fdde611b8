// Presents the error of ambient occlusion by stage.
#pragma once

#include "present/presentation.h"

namespace umbrameter {

/// The measurement must have stages.
Presentation present_ao_stages(const AoMeasurement& ao);

/// What the stage changes in each pixel.
ImageFigure ao_stage_figure(AoStage stage, const Image<float>& change);

/// The stages' signed means as a sum.
WaterfallFigure ao_stages_waterfall(const AoStageStatistics& statistics);

}  // namespace umbrameter
