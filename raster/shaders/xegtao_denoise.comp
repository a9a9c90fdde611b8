// One pass of the spatial denoiser of Intel's XeGTAO: the 3×3 pixels about each, weighted by how far their depths are
// connected. docs/ambient-occlusion/blur.md has the formulas. Background does not contribute, and stays 1.
#include "ao_resolution.glsl"
layout(local_size_x = GROUP_SIZE, local_size_y = GROUP_SIZE) in;
uniform sampler2D linear_depth;
uniform sampler2D source;
layout(r32f) writeonly uniform image2D blurred;
uniform float center_weight;

const float background = 1e30;

ivec2 inside(ivec2 pixel) { return clamp(pixel, ivec2(0), textureSize(source, 0) - 1); }

float depth_at(ivec2 pixel) {
  ivec2 surfel = surfel_pixel(inside(pixel), textureSize(linear_depth, 0));
  return min(texelFetch(linear_depth, surfel, 0).r, background);
}

// From 1 on one surface to 0 across a depth edge, as the pixel sees its neighbour: by the depth step or, on a slope, by
// half the second difference, whichever is smaller.
float one_sided(ivec2 pixel, ivec2 to_neighbour) {
  float depth = depth_at(pixel);
  float step = depth_at(pixel + to_neighbour) - depth;
  float bend = 0.5 * (step + depth_at(pixel - to_neighbour) - depth);
  return clamp(1.25 - min(abs(step), abs(bend)) / (0.011 * depth), 0.0, 1.0);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, textureSize(source, 0)))) return;
  if (depth_at(pixel) >= background) {
    imageStore(blurred, pixel, vec4(1.0));
    return;
  }
  const ivec2 sides[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1));
  float connections[4];
  float total = 0.0;
  for (int i = 0; i < 4; ++i) {
    connections[i] = one_sided(pixel, sides[i]) * one_sided(pixel + sides[i], -sides[i]);
    total += connections[i];
  }
  // A pixel that is cut off on three or four sides takes a little from all, against flicker.
  float leak = 0.5 / 1.5 * clamp(1.5 - total, 0.0, 1.0);
  float sum = center_weight * texelFetch(source, pixel, 0).r;
  float weights = center_weight;
  for (int i = 0; i < 4; ++i) connections[i] = min(connections[i] + leak, 1.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 side = pixel + sides[i];
    ivec2 next = pixel + sides[(i + 1) % 4];
    ivec2 diagonal = side + sides[(i + 1) % 4];
    if (depth_at(side) < background) {
      sum += connections[i] * texelFetch(source, inside(side), 0).r;
      weights += connections[i];
    }
    if (depth_at(diagonal) < background) {
      // Around the corner on either way.
      float weight = 0.425 * (connections[i] * one_sided(side, sides[(i + 1) % 4]) +
                              connections[(i + 1) % 4] * one_sided(next, sides[i]));
      sum += weight * texelFetch(source, inside(diagonal), 0).r;
      weights += weight;
    }
  }
  imageStore(blurred, pixel, vec4(sum / weights));
}
