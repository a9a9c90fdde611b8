// Which triangle a pixel centre sees, and its colour. The rest follows from the ids, exactly: gbuffer_resolve.comp.
#include "base_color.glsl"
layout(location = 0) flat in uint instance;
layout(location = 1) in vec2 surface_texcoord;
layout(location = 0) out uvec2 ids;
layout(location = 1) out vec4 albedo;
#if ALPHA_MASK
layout(location = UNIFORM_ALPHA_CUTOFF) uniform float alpha_cutoff;
#endif

void main() {
  vec4 color = base_color_at(surface_texcoord, true);
#if ALPHA_MASK
  if (!(color.a >= alpha_cutoff)) discard;
#endif
  ids = uvec2(instance, uint(gl_PrimitiveID));
  albedo = vec4(clamp(color.rgb, 0.0, 1.0), 0.0);
}
