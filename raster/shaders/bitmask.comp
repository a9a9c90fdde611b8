#include "ao_surfel.glsl"
#include "gtao.glsl"
#include "bitmask.glsl"
layout(std140) uniform Settings { BitmaskSettings settings; };
#include "ao_method.glsl"
