#include "ao_surfel.glsl"
#include "marched.glsl"
layout(std140) uniform Settings { MarchedSettings settings; };
#include "ao_method.glsl"
