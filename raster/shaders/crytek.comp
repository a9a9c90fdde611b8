#include "ao_surfel.glsl"
#include "crytek.glsl"
layout(std140) uniform Settings { CrytekSettings settings; };
#include "ao_method.glsl"
