// Hemisphere SSAO.
#include "ssao_sample.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(r32f) writeonly uniform image2D ao_image;
uniform float bias;
uniform float share;  // of one sample; a product rounds alike on every device, a quotient need not

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, ao_image_size(size)))) return;
  precise float ao = 1.0;
  if (texelFetch(ids, surfel_pixel(pixel, size), 0).r != NO_ID) {
    SsaoSurfel surfel = ssao_surfel(pixel);
    precise float occlusion = 0.0;
    for (int i = 0; i < samples; ++i) {
      SsaoSample at = ssao_sample(surfel, i);
      if (at.is_in_front && occludes(at, bias)) occlusion += occlusion_weight(surfel, at);
    }
    ao = max(1.0 - occlusion * share, 0.0);
  }
  imageStore(ao_image, pixel, vec4(ao));
}
