#include "ao_surfel.glsl"
#include "gtao.glsl"
layout(std140) uniform Settings { GtaoSettings settings; };
#include "ao_method.glsl"
