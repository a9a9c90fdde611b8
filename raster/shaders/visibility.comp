// What the shadow map says of each surfel; with a truth, the share of wrong taps by cause.
#include "light_map.glsl"
#if HAS_TRUTH
#include "own_surface.glsl"
#endif
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
layout(binding = TEXTURE_IDS) uniform usampler2D ids;
layout(binding = TEXTURE_POSITION_DEPTH) uniform sampler2D position_depth;
layout(binding = TEXTURE_GEOMETRIC_NORMAL) uniform sampler2D geometric_normal;
layout(binding = IMAGE_VISIBILITY, r32f) writeonly uniform image2D visibility_image;
#if HAS_TRUTH
layout(binding = TEXTURE_TRUTH) uniform sampler2D truth_image;
layout(binding = IMAGE_CLASSES, rgba32f) writeonly uniform image2D classes_image;
const int acne = 0;
const int false_occlusion = 1;
const int peter_panning = 2;
const int leak = 3;
#endif

#if SHADOW_FILTER == SHADOW_FILTER_BOX
const int taps = SHADOW_FILTER_SIZE;
#else
const int taps = 1;
#endif
const int reach = (taps - 1) / 2;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(ids, 0)))) return;
  uvec2 id = texelFetch(ids, pixel, 0).rg;
  float visibility = 1.0;
  vec4 classes = vec4(0);
  if (id.x != NO_ID) {
    dvec3 position = dvec3(texelFetch(position_depth, pixel, 0).xyz);
    dvec3 normal = dvec3(texelFetch(geometric_normal, pixel, 0).xyz);
    dvec3 to_light = light_in_world.w == 0.0lf ? light_in_world.xyz : light_in_world.xyz - position;
    precise double cosine = normal.x * to_light.x + normal.y * to_light.y + normal.z * to_light.z;
    visibility = 0.0;
    if (cosine > 0.0lf) {
      Receiver receiver = project_to_map(position);
      float slope = texel_at(receiver) * float(length(cross(normal, to_light)) / cosine);
#if HAS_TRUTH
      bool is_truly_lit = texelFetch(truth_image, pixel, 0).r >= 0.5;
      ivec4 wrong = ivec4(0);
#endif
      int lit = 0;
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          Tap tap = fetch_tap(receiver, ivec2(x, y));
          bool says_lit = is_lit(tap.critical_bias, slope);
          if (says_lit) ++lit;
#if HAS_TRUTH
          if (says_lit == is_truly_lit) continue;
          bool is_in_front = false;
          if (says_lit ? tap.critical_bias > 0.0 : true) {
            is_in_front = !is_own(receiver, id, tap.texel, texelFetch(shadow_ids, tap.texel, 0).rg);
          }
          wrong[says_lit ? (is_in_front ? peter_panning : leak) : (is_in_front ? false_occlusion : acne)] += 1;
#endif
        }
      }
      visibility = float(lit) / float(taps * taps);
#if HAS_TRUTH
      classes = vec4(wrong) / float(taps * taps);
#endif
    }
  }
  imageStore(visibility_image, pixel, vec4(visibility));
#if HAS_TRUTH
  imageStore(classes_image, pixel, classes);
#endif
}
