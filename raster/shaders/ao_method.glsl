// Runs an AO method: calls its accessibility() with its settings at every surfel.
#include "ao_resolution.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 image_size = ao_image_size(size);
  if (any(greaterThanEqual(pixel, image_size))) return;
  ivec2 at = surfel_pixel(pixel, size);
  float ao = 1.0;
  if (texelFetch(ids, at, 0).r != NO_ID) {
    AoSurfel surfel;
    surfel.pixel = at;
    surfel.position = vec3(view_from_world * dvec4(dvec3(texelFetch(position_depth, at, 0).xyz), 1.0lf));
    surfel.normal = normalize(vec3(dmat3(view_from_world) * dvec3(texelFetch(geometric_normal, at, 0).xyz)));
    // The noise is tiled from the top left corner of the image; row 0 of the texture is the bottom row.
    ivec2 tile = ivec2(pixel.x, image_size.y - 1 - pixel.y) % noise_size;
    surfel.noise = noise[tile.y * noise_size + tile.x].xy;
    ao = accessibility(surfel, settings);
  }
  imageStore(ao_image, pixel, vec4(ao));
}
