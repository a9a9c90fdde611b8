// Screen-space shadows: marches from each surfel through the depths of the G-buffer towards the light.
#include "screen_space.glsl"
#include "surfel_lookup.glsl"
#include "view.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(r32f) writeonly uniform image2D visibility_image;
uniform float reach;
uniform int steps;
uniform float thickness;
uniform float screen_bias;
uniform int is_jittered;
uniform int uses_plane;

bool is_blocked(ivec2 pixel) {
  MarchSettings settings = MarchSettings(reach, steps, thickness, screen_bias, is_jittered, uses_plane);
  dvec3 position = dvec3(texelFetch(position_depth, pixel, 0).xyz);
  dvec3 normal = dvec3(texelFetch(geometric_normal, pixel, 0).xyz);
  dvec3 towards = light_in_world.xyz;
  double ray = double(settings.reach);
  if (light_in_world.w != 0.0lf) {
    towards -= position;
    double distance_to_light = length_of(towards);
    towards /= distance_to_light;
    ray = min(ray, distance_to_light);
  }
  dvec3 start = on_screen(view_from_world, clip_from_world, size, position);
  double approach = transform_vector(view_from_world, towards).z;
  if (is_orthographic == 0) ray = length_before_camera(ray, start.z, approach);
  dvec3 end = on_screen(view_from_world, clip_from_world, size, position + ray * towards);
  March march = make_march(start, end, is_orthographic, pixel, settings);
  for (int i = 0; i < settings.steps; ++i) {
    vec3 at = march_sample(march, i, is_orthographic, settings);
    ivec2 seen = ivec2(floor(at.xy));
    if (any(lessThan(seen, ivec2(0))) || any(greaterThanEqual(seen, size))) return false;
    if (seen == pixel || texelFetch(ids, seen, 0).r == NO_ID) continue;
    vec4 surface = texelFetch(position_depth, seen, 0);
    float above = float(dot_of(normal, dvec3(surface.xyz) - position));
    if (blocks_march(at.z, surface.w, settings) && is_before_plane(above, at.z, settings)) return true;
  }
  return false;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, size))) return;
  float visibility = 1.0;
  if (texelFetch(ids, pixel, 0).r != NO_ID) {
    visibility = look_up(pixel).faces_light && !is_blocked(pixel) ? 1.0 : 0.0;
  }
  imageStore(visibility_image, pixel, vec4(visibility));
}
