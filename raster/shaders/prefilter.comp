// One axis of the blur of a filtered shadow map. Coordinates are clamped to the edge: the blur does not cross from one
// view to another. With IS_DEPTH the source is a map's depth with SAMPLES × SAMPLES texels to each texel of the result,
// whose values are averaged; otherwise it is the result of the other axis. Each view has GROUPS layers. The technique's
// text is described in techniques/shadow/prefiltered.h.
#include TECHNIQUE_TEXT
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2DArray source;
layout(MAP_FORMAT) writeonly uniform image2DArray blurred;
layout(std430) restrict readonly buffer MapSettings { Settings given; };
layout(std430) restrict readonly buffer BlurWeights { float blur_weights[]; };
uniform int taps;
uniform ivec2 axis;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  ivec2 last = imageSize(blurred).xy - 1;
  if (any(greaterThan(texel.xy, last))) return;
  Settings settings = given;
  CONSTANTS
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(texel.xy + (i - taps / 2) * axis, ivec2(0), last);
#if IS_DEPTH
    vec4 values = vec4(0.0);
    for (int s = 0; s < SAMPLES * SAMPLES; ++s) {
      ivec2 place = SAMPLES * at + ivec2(s % SAMPLES, s / SAMPLES);
      float depth = texelFetch(source, ivec3(place, texel.z / GROUPS), 0).r;
      values += map_values(depth, texel.z % GROUPS, settings);
    }
    values /= float(SAMPLES * SAMPLES);
#else
    vec4 values = texelFetch(source, ivec3(at, texel.z), 0);
#endif
    sum += blur_weights[i] * values;
    weights += blur_weights[i];
  }
  imageStore(blurred, texel, sum / weights);
}
