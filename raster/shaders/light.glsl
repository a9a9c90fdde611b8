// The light and its map. raster/shadow/light_block.cpp fills it; techniques/shadow/map_layout.h defines the terms.
layout(std140) uniform LightBlock {
  dmat4 light_from_world;
  dvec4 light_in_world;            // directional: unit vector to the light, w = 0; else its position, w = 1
  dvec4 face_basis[18];            // cube face i, in light space: [3i] right, [3i + 1] up, [3i + 2] forward
  dvec4 map_views[MAX_MAP_VIEWS];  // x, y: centre in light space, metres; z: half extent, metres or tangent;
                                   // w: largest view depth, metres
  vec4 receiver_z;  // with ROUNDS_RECEIVERS: ClipRows of techniques/shadow/map_depth.h
  vec4 receiver_w;
  vec4 bias_factors[MAX_MAP_VIEWS / 4];  // of the constant bias, of each view
  dvec4 view_depth_plane;          // view depth = xyz · position in light space + w, metres
  dvec2 warp_center;  // with MAP_WARPED: MapWarp of techniques/shadow/map_warp.h
  dvec2 warp_scale;
  dvec2 warp_shift;
  double fade_start;  // metres of view depth
  double warp_middle_depth;  // metres
  double far_depth;
  double nearest_view_depth;  // metres
  double cascade_blend;       // share of a cascade's extent
  double encoded_near;        // of the depth that the map stores, metres; 0: it is linear
  double offset_metres;       // of the normal offset, besides normal_offset
  int resolution;
  float constant_bias;  // in bias_unit
  float slope_bias;
  float normal_offset;  // texels
  float filter_radius;  // texels
  int tap_count;        // taps of the filter; a uniform, so that compilers do not unroll loops over taps
  int bias_unit;        // of constant biases, including those of axes: one of BIAS_IN_…
  int view_count;
  float cone_bias;       // bias per distance of a tap's texel centre from the receiver
  float search_extent;   // PCSS and DPCF: radius of the light in metres, or tangent of its angular radius
  float max_radius;      // PCSS and DPCF: texels
  float min_radius;      // PCSS: texels
  int search_count;      // PCSS: taps of the blocker search
  int search_in_cone;    // PCSS: 1 if only blockers inside the cone from the receiver to the light count
  int selects_by_depth;  // how a cascade is selected; 1: by view depth, 0: the first that contains the position
  int uses_neighbour;    // 1: looks up the view beside the selected one
  int is_stable;         // 1: vertices are drawn at whole 1/256 texels
  int offset_profile;    // one of OFFSET_…
  int offset_is_across;  // 1: only the part of the normal offset across the light
  int offset_is_of_front;  // 1: where a back face is seen, that of its front
  double warp_depth_scale;
  double encoded_far;  // far_end_of() of techniques/shadow/map_layout.h
  int tie_shift;       // with ROUNDS_RECEIVERS: that of passing_depth() in map_depth.glsl
  int unused;
};
