// For the listed pixels of a look-up with one tap: 1 + the bin in which the tap flips, and the cause of its error:
// TapFlips of techniques/shadow/histogram.h.
#include "cause.glsl"
#include "pixel_list.glsl"
#include "response.glsl"
layout(local_size_x = LIST_GROUP_SIZE) in;
layout(rg32ui) writeonly uniform uimage2D flip_image;

void main() {
  uint index = first_pixel + gl_GlobalInvocationID.x;
  if (index >= end_pixel) return;
  ivec2 pixel = listed_pixel(index);
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  Lookup surfel = look_up(pixel);
  Tap tap = filter_tap(surfel.receiver, make_pattern(surfel, pixel), 0).tap;
  uint bin = bias_bin(flip_bias(tap.critical_bias, surfel.slope, min_slope), surfel.bias_unit);
  int cause = cause_of(tap, is_lit_in_reference(pixel), surfel.receiver, id, fetch_facet(id));
  imageStore(flip_image, pixel, uvec4(bin + 1u, uint(cause), 0u, 0u));
}
