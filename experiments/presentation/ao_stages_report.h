// Presents the error of ambient occlusion by stage.
#pragma once

#include "experiments/presentation/presentation.h"

namespace umbrameter {

/// The measurement must have stages.
Presentation present_ao_stages(const AoMeasurement& ao);

/// The stages' signed means as a sum.
WaterfallFigure ao_stages_waterfall(const AoStageStatistics& statistics);

}  // namespace umbrameter
