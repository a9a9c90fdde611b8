// One axis of the box blur of exp(c·z) over a shadow map. Coordinates are clamped to the edge: the blur does not cross
// from one view to another. With WARP the source is the map's depth, otherwise the result of the other axis.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2DArray source;
layout(r32f) writeonly uniform image2DArray blurred;
uniform float exponent;
uniform int taps;
uniform ivec2 axis;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  ivec2 last = textureSize(source, 0).xy - 1;
  if (any(greaterThan(texel.xy, last))) return;
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(texel.xy + (i - taps / 2) * axis, ivec2(0), last);
    float value = texelFetch(source, ivec3(at, texel.z), 0).r;
#if WARP
    value = exp(exponent * value);
#endif
    sum += value;
  }
  imageStore(blurred, texel, vec4(sum / float(taps)));
}
