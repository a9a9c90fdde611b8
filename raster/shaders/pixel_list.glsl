// A list of pixels, in any order, and the range of it that one dispatch processes. Passes use a list because software
// rasterisers also execute branches that are not taken. They process it in ranges because a desktop's watchdog kills a
// dispatch that runs for seconds.
uniform uint first_pixel;
uniform uint end_pixel;
layout(std430) restrict buffer PixelList {
  uint pixel_count;
  uint pixels[];  // x, and y in the upper half
};

void append(ivec2 pixel) { pixels[atomicAdd(pixel_count, 1u)] = uint(pixel.x) | uint(pixel.y) << 16u; }

ivec2 listed_pixel(uint index) { return ivec2(pixels[index] & 0xffffu, pixels[index] >> 16u); }
