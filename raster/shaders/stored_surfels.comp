// Decodes the surfels of the deferred G-buffer, for the passes that read surfels: visibility and AO.
#include "stored_gbuffer.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform usampler2D ids;
uniform sampler2D stored_geometric_normal;
layout(rgba32f) writeonly uniform image2D position_depth;
layout(rgba32f) writeonly uniform image2D geometric_normal;
layout(rgba32f) writeonly uniform image2D shading_normal;
layout(rgba32f) writeonly uniform image2D decoded_albedo;
layout(rgba32f) writeonly uniform image2D decoded_specular;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  bool is_surface = texelFetch(ids, pixel, 0).r != NO_ID;
  SurfacePoint surface = surface_at(pixel);
  float depth = float(dot(dvec3(surface.position) - eye.xyz, axis.xyz));
  imageStore(position_depth, pixel, is_surface ? vec4(surface.position, depth) : vec4(0));
  imageStore(geometric_normal, pixel,
             is_surface ? vec4(decoded_normal(texelFetch(stored_geometric_normal, pixel, 0)), 0) : vec4(0));
  imageStore(shading_normal, pixel, is_surface ? vec4(surface.normal, 0) : vec4(0));
  // The G-buffer holds the diffuse reflectance only, which is the base colour of a dielectric.
  imageStore(decoded_albedo, pixel, is_surface ? vec4(surface.diffuse, 0) : vec4(0));
  imageStore(decoded_specular, pixel,
             is_surface ? vec4(surface.specular, roughness_of(surface.shininess)) : vec4(0));
}
