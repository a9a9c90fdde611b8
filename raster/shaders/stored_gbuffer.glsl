// Reads the deferred path's G-buffer, which store_gbuffer.frag writes.
#include "shading.glsl"
#include "gbuffer_encoding.glsl"
uniform sampler2D stored_depth;
uniform sampler2D stored_normal;
uniform sampler2D stored_diffuse;
uniform sampler2D stored_specular;
uniform sampler2D stored_position;

vec3 decoded_normal(vec4 stored) {
#if SHADING_NORMAL_FORMAT == SHADING_NORMAL_FORMAT_RG16
  return unit_from_octahedral(stored.xy * 2.0 - 1.0);
#elif SHADING_NORMAL_FORMAT == SHADING_NORMAL_FORMAT_RGB8
  return normalize(stored.xyz * 2.0 - 1.0);
#elif SHADING_NORMAL_FORMAT == SHADING_NORMAL_FORMAT_RGB16F
  return normalize(stored.xyz);
#else
  return stored.xyz;
#endif
}

vec3 position_at(ivec2 pixel) {
#if SHADING_POSITION == SHADING_POSITION_STORED
  return texelFetch(stored_position, pixel, 0).xyz;
#else
  vec2 ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
  vec4 world = world_from_clip * vec4(ndc, texelFetch(stored_depth, pixel, 0).r, 1.0);
  return world.xyz / world.w;
#endif
}

SurfacePoint surface_at(ivec2 pixel) {
  SurfacePoint surface;
  vec4 reflectance = texelFetch(stored_specular, pixel, 0);
  surface.position = position_at(pixel);
  surface.normal = decoded_normal(texelFetch(stored_normal, pixel, 0));
  surface.to_viewer = direction_to_viewer(surface.position);
  surface.diffuse = texelFetch(stored_diffuse, pixel, 0).rgb;
  surface.specular = reflectance.rgb;
#if SHADING_COLOR_FORMAT == SHADING_COLOR_FORMAT_RGBA8
  surface.shininess = decoded_shininess(reflectance.a);
#else
  surface.shininess = reflectance.a;
#endif
  return surface;
}
