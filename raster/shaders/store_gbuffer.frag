// Stores surfels in the formats of the deferred path's G-buffer. The background keeps its cleared value, 0.
#include "view.glsl"
#include "gbuffer_encoding.glsl"
#include "light_model.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D geometric_normal;
uniform sampler2D shading_normal;
uniform sampler2D albedo;
uniform sampler2D specular;
layout(location = 0) out vec4 stored_normal;
layout(location = 1) out vec4 stored_geometric_normal;
layout(location = 2) out vec4 stored_diffuse;
layout(location = 3) out vec4 stored_specular;
#if SHADING_POSITION == SHADING_POSITION_STORED
layout(location = 4) out vec4 stored_position;
#endif

vec4 encoded_normal(vec3 n) {
#if SHADING_NORMAL_FORMAT == SHADING_NORMAL_FORMAT_RG16
  return vec4(octahedral_from_unit(n) * 0.5 + 0.5, 0, 0);
#elif SHADING_NORMAL_FORMAT == SHADING_NORMAL_FORMAT_RGB8
  return vec4(n * 0.5 + 0.5, 0);
#else
  return vec4(n, 0);
#endif
}

// The depth buffer holds floats, so this rounds to the steps of fixed-point formats.
double stored_depth(vec3 position) {
  dvec4 clip = clip_from_world * dvec4(dvec3(position), 1.0lf);
  double depth = clamp(clip.z / clip.w, 0.0lf, 1.0lf);
#if SHADING_DEPTH_FORMAT == SHADING_DEPTH_FORMAT_DEPTH24
  depth = floor(depth * 16777215.0lf + 0.5lf) / 16777215.0lf;
#elif SHADING_DEPTH_FORMAT == SHADING_DEPTH_FORMAT_DEPTH16
  depth = floor(depth * 65535.0lf + 0.5lf) / 65535.0lf;
#endif
  return depth;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(ids, pixel, 0).r == NO_ID) discard;
  vec3 position = texelFetch(position_depth, pixel, 0).xyz;
  vec4 base_color = texelFetch(albedo, pixel, 0);  // w: metallic
  vec4 reflectance = texelFetch(specular, pixel, 0);  // w: roughness
  float shininess = shininess_of(reflectance.w);
  stored_normal = encoded_normal(texelFetch(shading_normal, pixel, 0).xyz);
  stored_geometric_normal = encoded_normal(texelFetch(geometric_normal, pixel, 0).xyz);
  stored_diffuse = vec4(base_color.rgb * (1.0 - base_color.w), 0);
#if SHADING_COLOR_FORMAT == SHADING_COLOR_FORMAT_RGBA8
  stored_specular = vec4(reflectance.rgb, encoded_shininess(shininess));
#else
  stored_specular = vec4(reflectance.rgb, shininess);
#endif
#if SHADING_POSITION == SHADING_POSITION_STORED
  stored_position = vec4(position, 0);
#endif
  gl_FragDepth = float(stored_depth(position));
}
