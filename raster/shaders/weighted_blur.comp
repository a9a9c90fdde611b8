// One axis of a Gaussian or bilateral blur of ambient occlusion: AoBlurTaps of techniques/ao/blur.h. Background does not
// contribute, and stays 1.
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D geometric_normal;
uniform sampler2D source;
layout(r32f) writeonly uniform image2D blurred;
uniform ivec2 axis;
uniform int first;
uniform int taps;
uniform float deviation;        // of the Gaussian, pixels
uniform float plane_distance;   // metres from the tangent plane at which a weight is 1/e; 0: not weighted
uniform float normal_exponent;  // of the cosine between normals; 0: not weighted

void main() {
  ivec2 size = textureSize(source, 0);
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  if (texelFetch(ids, pixel, 0).r == NO_ID) {
    imageStore(blurred, pixel, vec4(1.0));
    return;
  }
  vec3 position = texelFetch(position_depth, pixel, 0).xyz;
  vec3 normal = texelFetch(geometric_normal, pixel, 0).xyz;
  float sum = 0.0;
  float weights = 0.0;
  for (int i = 0; i < taps; ++i) {
    ivec2 at = clamp(pixel + (first + i) * axis, ivec2(0), size - 1);
    if (texelFetch(ids, at, 0).r == NO_ID) continue;
    float offset = float(first + i) / deviation;
    float weight = exp(-0.5 * offset * offset);
    if (plane_distance > 0.0) {
      float apart = dot(texelFetch(position_depth, at, 0).xyz - position, normal) / plane_distance;
      weight *= exp(-apart * apart);
    }
    if (normal_exponent > 0.0) {
      float cosine = min(max(dot(texelFetch(geometric_normal, at, 0).xyz, normal), 0.0), 1.0);
      weight *= cosine < 1.0 ? pow(cosine, normal_exponent) : 1.0;
    }
    sum += weight * texelFetch(source, at, 0).r;
    weights += weight;
  }
  imageStore(blurred, pixel, vec4(weights > 0.0 ? sum / weights : texelFetch(source, pixel, 0).r));
}
