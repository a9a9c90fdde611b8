#include "ao_surfel.glsl"
#include "alchemy.glsl"
layout(std140) uniform Settings { AlchemySettings settings; };
#include "ao_method.glsl"
