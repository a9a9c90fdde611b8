// A list of pixels, in any order, and the work groups that a pass over it needs. A list, because software rasterisers
// execute what a branch skips.
layout(std430, binding = BUFFER_PIXELS) restrict buffer PixelList {
  uvec3 group_count;  // what glDispatchComputeIndirect reads
  uint pixel_count;
  uint pixels[];  // x, and y in the upper half
};

void append(ivec2 pixel) {
  uint index = atomicAdd(pixel_count, 1u);
  atomicMax(group_count.x, index / LIST_GROUP_SIZE + 1u);
  pixels[index] = uint(pixel.x) | uint(pixel.y) << 16u;
}

ivec2 listed_pixel(uint index) { return ivec2(pixels[index] & 0xffffu, pixels[index] >> 16u); }
