// Computes the visibility of each surfel from a filtered shadow map, with bilinear interpolation.
#include "prefilter_settings.glsl"
#include "surfel_lookup.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2DArray values;
layout(r32f) writeonly uniform image2D visibility_image;

// Bilinear interpolation in full precision: hardware filters with 8-bit weights.
vec4 values_at(Receiver receiver) {
  vec2 place = vec2(receiver.texels) - 0.5;
  ivec2 base = ivec2(floor(place));
  vec2 part = place - vec2(base);
  ivec2 low = clamp(base, ivec2(0), ivec2(resolution - 1));
  ivec2 high = clamp(base + 1, ivec2(0), ivec2(resolution - 1));
  vec4 bottom = mix(texelFetch(values, ivec3(low, receiver.view), 0),
                    texelFetch(values, ivec3(high.x, low.y, receiver.view), 0), part.x);
  vec4 top = mix(texelFetch(values, ivec3(low.x, high.y, receiver.view), 0),
                 texelFetch(values, ivec3(high, receiver.view), 0), part.x);
  return mix(bottom, top, part.y);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  float visibility = 1.0;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    visibility = 0.0;
    Lookup surfel = look_up(pixel);
    if (surfel.faces_light) {
      visibility = 1.0;
      if (surfel.receiver.is_inside) {
        double bias = double(constant_bias * surfel.bias_unit + slope_bias * surfel.slope);
        float depth = float((surfel.receiver.depth - bias) / far_depth);
        visibility = visibility_from(values_at(surfel.receiver), depth, settings());
      }
    }
  }
  imageStore(visibility_image, pixel, vec4(visibility));
}
