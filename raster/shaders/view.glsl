// The camera, in double precision, as raster/gbuffer/view_block.h fills it.
layout(std140, binding = BLOCK_VIEW) uniform View {
  dmat4 clip_from_world;
  dmat4 view_from_world;
  dvec4 eye;               // world
  dvec4 ray_origin[3];     // relative to the eye: base, per unit of x and of y in normalised device coordinates
  dvec4 ray_direction[3];  // the same
  dvec4 axis;              // unit, the way that the camera looks
  mat4 clip_from_view;
  ivec2 size;
  int is_orthographic;
};
