// Adds one light to the light buffer, over its volume or over the whole image.
#include "stored_gbuffer.glsl"
#include "lights.glsl"
// Fragments that fail the depth test are not counted.
layout(early_fragment_tests) in;
uniform usampler2D ids;
uniform sampler2D visibility;
uniform int light;
#if COUNTS_FRAGMENTS
// Two numbers per light: fragments shaded; of these, in vain.
layout(std430) restrict buffer Counters { uint counters[]; };
#endif
layout(location = 0) out vec4 radiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  radiance = vec4(0);
  bool is_surface = texelFetch(ids, pixel, 0).r != NO_ID;
  SurfacePoint surface = surface_at(pixel);
#if COUNTS_FRAGMENTS
  atomicAdd(counters[2 * light], 1u);
  if (!is_surface || !is_in_volume(surface.position, lights[light])) atomicAdd(counters[2 * light + 1], 1u);
#endif
  if (!is_surface) return;
  Reflection reflection = reflect_light(surface, lights[light], model);
  radiance = vec4(texelFetch(visibility, pixel, 0).r * (reflection.diffuse + reflection.specular), 1);
}
