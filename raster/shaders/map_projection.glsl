// Where a vertex falls on a view of an orthographic or paraboloid map.
uniform int map_view;

/// gl_Position of a position in light space; sets gl_ClipDistance[0] of a paraboloid's vertex.
vec4 on_map(dvec3 p) {
  dvec4 view = map_views[map_view];
#if MAP_KIND == MAP_PARABOLOID
  // W. Heidrich and H.-P. Seidel, View-independent Environment Maps, Graphics Hardware 1998; for shadows S. Brabec,
  // T. Annen and H.-P. Seidel, Shadow Mapping for Hemispherical and Omnidirectional Light Sources, CGI 2002. Vertices are
  // projected, and the rasteriser joins them by straight lines, where the projection of an edge is bent.
  if (map_view == 1) p = dvec3(-p.x, p.y, -p.z);
  double radius = length(p);
  gl_ClipDistance[0] = float(-p.z);
  // Behind the hemisphere the projection runs to infinity.
  p.xy /= max(radius - p.z, 1e-3lf * radius + 1e-9lf * far_depth);
  p.z = -radius;
#endif
#if DEPTH_MAPPING == DEPTH_REVERSED_LINEAR
  double depth = (far_depth + p.z) / far_depth;
#else
  double depth = -p.z / far_depth;
#endif
  dvec2 place = dvec2((p.x - view.x) / view.z, (p.y - view.y) / view.z);
  if (is_stable != 0) {
    // The rasteriser rounds positions to this grid; rounding to single precision before that would depend on the view.
    double steps = 128.0lf * double(resolution);
    place = floor(place * steps + 0.5lf) / steps;
  }
  return vec4(vec3(place, depth), 1.0);
}
