// Pixels that have wrong taps, in any order, and the work groups that classify.comp needs for them. A list, because
// software rasterisers execute what a branch skips.
layout(std430, binding = BUFFER_WRONG) restrict buffer WrongPixels {
  uvec3 group_count;  // what glDispatchComputeIndirect reads
  uint wrong_count;
  uint wrong_pixels[];  // x, and y in the upper half
};
