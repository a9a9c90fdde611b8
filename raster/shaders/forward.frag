// Shades a fragment by every light of the pass, if it is the surfel of its pixel.
#include "shading.glsl"
#include "lights.glsl"
#include "material.glsl"
layout(location = 0) flat in uint instance;
layout(location = 1) in vec2 surface_texcoord;
layout(location = 0) out vec4 radiance;
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D shading_normal;
uniform sampler2DArray visibilities;
uniform sampler2D ao;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(ids, pixel, 0).rg != uvec2(instance, uint(gl_PrimitiveID))) discard;
  SurfaceMaterial material = surface_material_at(surface_texcoord, base_color_at(surface_texcoord, true).rgb);
  SurfacePoint surface;
  // Position and normal of the surfel, because drivers interpolate differently on triangles thinner than a pixel.
  surface.position = texelFetch(position_depth, pixel, 0).xyz;
  surface.normal = texelFetch(shading_normal, pixel, 0).xyz;
  surface.to_viewer = direction_to_viewer(surface.position);
  surface.diffuse = material.base_color * (1.0 - material.metallic);
  surface.specular = material.specular;
  surface.shininess = shininess_of(material.roughness);
  vec3 sum = texelFetch(ao, pixel, 0).r * reflect_ambient(surface, ambient);
  for (int i = 0; i < light_count; ++i) {
    Reflection reflection = reflect_light(surface, lights[i], model);
    sum += texelFetch(visibilities, ivec3(pixel, i), 0).r * (reflection.diffuse + reflection.specular);
  }
  radiance = vec4(sum, 1);
}
