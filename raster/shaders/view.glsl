// The camera, in double precision. raster/gbuffer/view_block.cpp fills it.
layout(std140) uniform View {
  dmat4 clip_from_world;
  dmat4 view_from_world;
  dvec4 eye;               // world
  dvec4 ray_origin[3];     // relative to the eye; [0] + x·[1] + y·[2] at normalised device coordinates (x, y)
  dvec4 ray_direction[3];  // likewise
  dvec4 axis;              // viewing direction, unit
  mat4 clip_from_view;
  ivec2 size;
  int is_orthographic;
};
