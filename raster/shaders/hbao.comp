#include "ao_surfel.glsl"
#include "hbao.glsl"
layout(std140) uniform Settings { HbaoSettings settings; };
#include "ao_method.glsl"
