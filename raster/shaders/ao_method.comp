// Runs an AO method of techniques/ao/*.glsl with its settings at every surfel: calls its accessibility(), or its
// bent_normal() if AO_BENT_NORMAL is defined.
#include "view.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D linear_depth;
uniform sampler2D geometric_normal;
#ifdef AO_BENT_NORMAL
layout(rgba32f) writeonly uniform image2D bent_normals;
#else
layout(r32f) writeonly uniform image2D ao_image;
#endif
layout(std430) readonly buffer Noise { vec4 noise[]; };
uniform int noise_size;

float depth_at(ivec2 pixel) { return texelFetch(linear_depth, pixel, 0).r; }
#include "screen.glsl"
float depth_at_level(ivec2 texel, int level) { return texelFetch(linear_depth, texel, level).r; }
#include "depth_pyramid.glsl"
#include TECHNIQUE_TEXT
layout(std430) restrict readonly buffer MethodSettings { METHOD_SETTINGS settings; };
#include "ao_resolution.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

AoSurfel surfel_of(ivec2 pixel, ivec2 image_size) {
  AoSurfel surfel;
  surfel.pixel = surfel_pixel(pixel, size);
  surfel.position = vec3(view_from_world * dvec4(dvec3(texelFetch(position_depth, surfel.pixel, 0).xyz), 1.0lf));
  surfel.normal = normalize(vec3(dmat3(view_from_world) * dvec3(texelFetch(geometric_normal, surfel.pixel, 0).xyz)));
  // The noise is tiled from the top left corner of the image; row 0 of the texture is the bottom row.
  ivec2 tile = ivec2(pixel.x, image_size.y - 1 - pixel.y) % noise_size;
  surfel.noise = noise[tile.y * noise_size + tile.x].xy;
  return surfel;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 image_size = ao_image_size(size);
  if (any(greaterThanEqual(pixel, image_size))) return;
  bool is_surface = texelFetch(ids, surfel_pixel(pixel, size), 0).r != NO_ID;
#ifdef AO_BENT_NORMAL
  vec3 bent = vec3(0.0);
  if (is_surface) bent = bent_normal(surfel_of(pixel, image_size), settings);
  imageStore(bent_normals, pixel, vec4(vec3(transpose(dmat3(view_from_world)) * dvec3(bent)), 0.0));
#else
  float ao = 1.0;
  if (is_surface) ao = accessibility(surfel_of(pixel, image_size), settings);
  imageStore(ao_image, pixel, vec4(ao));
#endif
}
