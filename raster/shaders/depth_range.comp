// The nearest and the farthest depth that a map holds. Floats of one sign are in the order of their bits.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2DArray shadow_depth;
layout(std430) restrict buffer Range { uint range[2]; };

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(texel.xy, textureSize(shadow_depth, 0).xy))) return;
  float depth = texelFetch(shadow_depth, texel, 0).r;
  if (!(depth < 1.0)) return;
  atomicMin(range[0], floatBitsToUint(depth));
  atomicMax(range[1], floatBitsToUint(depth));
}
