// The passes of every AO technique: draw() computes its accessibility before the blur, 1 on background, R32F.
#pragma once

#include "raster/ao/method_pass.h"
#include "raster/ao/ssao_pass.h"
