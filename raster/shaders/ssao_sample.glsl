// A sample of hemisphere SSAO (J. de Vries, Learn OpenGL, "SSAO"; after Mittring, Finding Next Gen: CryEngine 2, 2007),
// in metres. docs/ambient-occlusion/ssao.md lists the differences from the source.
#include "view.glsl"
#include "ao_resolution.glsl"
uniform usampler2D ids;
uniform sampler2D position_depth;
uniform sampler2D linear_depth;
uniform sampler2D geometric_normal;
// A uniform block: on llvmpipe, reading the kernel from a storage buffer makes the pass 2.5 times as slow.
layout(std140) uniform Kernel { vec4 kernel[MAX_SAMPLES]; };
layout(std430) readonly buffer Rotations { vec4 rotations[]; };
uniform int samples;
uniform int noise_size;
uniform float radius;

// A unit vector perpendicular to the normal, used if the rotation vector is parallel to the normal.
vec3 any_tangent(vec3 n) {
  return normalize(abs(n.x) > 0.5 ? cross(n, vec3(0, 1, 0)) : cross(n, vec3(1, 0, 0)));
}

struct SsaoSurfel {
  vec3 position;
  mat3 view_from_tangent;
};

// Of a pixel of the AO image.
SsaoSurfel ssao_surfel(ivec2 pixel) {
  ivec2 at = surfel_pixel(pixel, size);
  SsaoSurfel surfel;
  surfel.position = vec3(view_from_world * dvec4(dvec3(texelFetch(position_depth, at, 0).xyz), 1.0lf));
  vec3 normal = normalize(vec3(dmat3(view_from_world) * dvec3(texelFetch(geometric_normal, at, 0).xyz)));
  // The noise is tiled from the top left corner of the image; row 0 of the texture is the bottom row.
  ivec2 tile = ivec2(pixel.x, ao_image_size(size).y - 1 - pixel.y) % noise_size;
  vec3 rotation = rotations[tile.y * noise_size + tile.x].xyz;
  vec3 across = rotation - normal * dot(rotation, normal);
  vec3 tangent = dot(across, across) > 1e-12 ? normalize(across) : any_tangent(normal);
  surfel.view_from_tangent = mat3(tangent, cross(normal, tangent), normal);
  return surfel;
}

struct SsaoSample {
  bool is_in_front;  // of the camera
  float point_z;     // of the sample's point
  float seen_z;      // of the surface that its pixel sees
};

SsaoSample ssao_sample(SsaoSurfel surfel, int i) {
  vec3 point = surfel.position + radius * (surfel.view_from_tangent * kernel[i].xyz);
  vec4 clip = clip_from_view * vec4(point, 1.0);
  ivec2 seen = clamp(ivec2(floor((clip.xy / clip.w * 0.5 + 0.5) * vec2(size))), ivec2(0), size - 1);
  return SsaoSample(clip.w > 0.0, point.z, -texelFetch(linear_depth, seen, 0).r);
}

// Rounding does not decide otherwise at a larger bias.
bool occludes(SsaoSample at, float bias) {
  precise float nearest = at.point_z + bias;
  return at.seen_z >= nearest;
}

float occlusion_weight(SsaoSurfel surfel, SsaoSample at) {
#if AO_RANGE_CHECK
  return smoothstep(0.0, 1.0, radius / max(abs(surfel.position.z - at.seen_z), 1e-20));
#else
  return 1.0;
#endif
}
