// Copies the depth along the camera's axis to a one-channel image, infinite on background. Each AO sample then needs
// only one fetch.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D position_depth;
layout(r32f) writeonly uniform image2D linear_depth;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  bool is_surface = texelFetch(ids, pixel, 0).r != NO_ID;
  float infinity = uintBitsToFloat(0x7f800000u);
  imageStore(linear_depth, pixel, vec4(is_surface ? texelFetch(position_depth, pixel, 0).w : infinity));
}
