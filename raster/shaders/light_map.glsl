// Projects world positions to the light's map, fetches taps and compares depths.
#include "arithmetic.glsl"
#include "light.glsl"
#include "map_depth.glsl"
#include "map_warp.glsl"
uniform sampler2DArray shadow_depth;
uniform usampler2DArray shadow_ids;

// A stored depth of 1 means that the light hits nothing there, because every surface is nearer than far_depth.
const float empty_depth = 1.0;
const float no_blocker = uintBitsToFloat(0xff800000u);  // minus infinity: lit at every bias

// Whether the map surrounds the light.
#define IS_OMNIDIRECTIONAL (MAP_KIND == MAP_CUBE || MAP_KIND == MAP_PARABOLOID)

struct Receiver {
  dvec3 in_light;     // light space, metres
  double depth;       // metres; see MapLayout in techniques/shadow/map_layout.h
  double axis_depth;  // metres along the axis of the map or face; paraboloid: plus the radial distance
  dvec2 texels;       // projected position in texels, clamped to the map extended by two texels on each side
  ivec2 texel;        // the texel that contains it
  int view;
  bool is_inside;
#if RECEIVER_PLANE
  dvec3 plane;  // geometric normal in light space, towards the light
#endif
};

struct Tap {
  ivec3 texel;  // x, y, face
  bool has_blocker;
  float critical_bias;  // metres at the receiver; the tap is lit if and only if the bias is at least this
};

// The view of a cube or paraboloid map that sees a direction.
int face_of(dvec3 direction) {
#if MAP_KIND == MAP_PARABOLOID
  return direction.z > 0.0lf ? 1 : 0;
#endif
  dvec3 d = abs(direction);
  if (d.x >= d.y && d.x >= d.z) return direction.x >= 0.0lf ? 0 : 1;
  if (d.y >= d.z) return direction.y >= 0.0lf ? 2 : 3;
  return direction.z >= 0.0lf ? 4 : 5;
}

// In the frame of the view; z: what the position on the map is divided by, metres.
dvec3 on_face(int face, dvec3 p) {
#if MAP_KIND == MAP_PARABOLOID
  double side = face == 0 ? 1.0lf : -1.0lf;
  precise dvec3 q = dvec3(side * p.x, p.y, length_of(p) - side * p.z);
  return q;
#endif
  return dvec3(dot_of(face_basis[3 * face].xyz, p), dot_of(face_basis[3 * face + 1].xyz, p),
               dot_of(face_basis[3 * face + 2].xyz, p));
}

#if IS_OMNIDIRECTIONAL
// The face across the nearest edge, which is that of the second largest component; of paraboloids the other one.
int neighbour_face_of(dvec3 direction) {
#if MAP_KIND == MAP_PARABOLOID
  return 1 - face_of(direction);
#endif
  // Not by an index: see arithmetic.glsl.
  int largest = face_of(direction) / 2;
  return face_of(dvec3(largest == 0 ? 0.0lf : direction.x, largest == 1 ? 0.0lf : direction.y,
                       largest == 2 ? 0.0lf : direction.z));
}
#elif MAP_KIND == MAP_ORTHOGRAPHIC
double view_depth(dvec3 p) {
  precise double depth = dot_of(view_depth_plane.xyz, p) + view_depth_plane.w;
  return depth;
}

// Whether a position belongs to a cascade other than the last. inset moves the cascade's border inwards by this share
// of its extent.
bool is_in_cascade(int view, dvec3 p, double inset) {
  dvec4 candidate = map_views[view];
  if (selects_by_depth != 0) {
    double nearest = view > 0 ? map_views[view - 1].w : nearest_view_depth;
    precise double farthest = candidate.w - inset * (candidate.w - nearest);
    return view_depth(p) <= farthest;
  }
  // With a margin for the taps of a kernel.
  precise double reach = candidate.z * (1.0lf - 2.0lf * double(MAP_VIEW_MARGIN) / double(resolution)) * (1.0lf - inset);
  return all(lessThanEqual(abs(p.xy - candidate.xy), dvec2(reach)));
}

// view_of() of techniques/shadow/map_layout.h.
int view_of(dvec3 p, double dither) {
  int last = view_count - 1;
  int blended = last;
  int view = 0;
  for (; view < last; ++view) {
    if (!is_in_cascade(view, p, 0.0lf)) continue;
    precise double inset = cascade_blend * dither;
    if (blended != last || is_in_cascade(view, p, inset)) break;
    blended = view;
  }
  bool is_on_last = all(lessThanEqual(abs(p.xy - map_views[last].xy), dvec2(map_views[last].z)));
  if (view == last && blended != last && !is_on_last) view = blended;
  return min(view + uses_neighbour, last);
}
#endif

#if MAP_KIND == MAP_ORTHOGRAPHIC
// is_faded() of techniques/shadow/map_layout.h.
bool is_faded(dvec3 p, double dither) {
  double depth = view_depth(p);
  if (selects_by_depth == 0 || !(depth > fade_start)) return false;
  precise double share = min((depth - fade_start) / (map_views[view_count - 1].w - fade_start), 1.0lf);
  precise double smooth_share = share * share * (3.0lf - 2.0lf * share);
  precise double least = 1.0lf - dither;
  return smooth_share > least;
}
#endif

// dither: threshold of the pixel for blended cascades.
Receiver project_to_map(dvec3 world, double dither) {
  Receiver r;
  dvec3 p = transform_point(light_from_world, world);
  r.in_light = p;
  r.view = 0;
  precise dvec2 projected;
#if MAP_KIND == MAP_ORTHOGRAPHIC
  r.axis_depth = -p.z;
  r.depth = r.axis_depth;
  r.is_inside = selects_by_depth == 0 || view_depth(p) <= map_views[view_count - 1].w;
  r.is_inside = r.is_inside && !is_faded(p, dither);
  r.view = view_of(p, dither);
#if MAP_WARPED
  r.is_inside = r.is_inside && p.y > warp_center.y;
  projected = r.is_inside ? on_warped(p.xy) : dvec2(0.0lf);
#else
  projected = (p.xy - map_views[r.view].xy) / map_views[r.view].z;
#endif
#else
#if IS_OMNIDIRECTIONAL
  r.view = uses_neighbour != 0 ? neighbour_face_of(p) : face_of(p);
  dvec3 q = on_face(r.view, p);
  r.axis_depth = q.z;
  r.depth = length_of(p);
#else
  dvec3 q = dvec3(p.xy, -p.z);
  r.axis_depth = q.z;
#if ROUNDS_RECEIVERS
  r.depth = depth_in_floats(vec3(world), receiver_z, receiver_w, encoded_near, encoded_far);
#else
  r.depth = r.axis_depth;
#endif
#endif
  r.is_inside = r.axis_depth > 0.0lf;
  projected = r.is_inside ? q.xy / (q.z * map_views[0].z) : dvec2(0.0lf);
#endif
  precise dvec2 texels = (projected * 0.5lf + 0.5lf) * double(resolution);
  r.texels = clamp(texels, -2.0lf, double(resolution) + 2.0lf);
  r.texel = ivec2(floor(r.texels));
#if IS_OMNIDIRECTIONAL
  r.texel = clamp(r.texel, ivec2(0), ivec2(resolution - 1));
#endif
  r.is_inside = r.is_inside && all(greaterThanEqual(r.texel, ivec2(0))) && all(lessThan(r.texel, ivec2(resolution)));
  return r;
}

// Position of a texel's centre in light space: metres (orthographic) or tangents (perspective, cube).
dvec2 texel_center(ivec3 texel) {
#if MAP_KIND == MAP_ORTHOGRAPHIC
  dvec4 view = map_views[texel.z];
#else
  dvec4 view = map_views[0];
#endif
#if MAP_WARPED
  precise dvec2 place = (dvec2(texel.xy) + 0.5lf) / double(resolution) * 2.0lf - 1.0lf;
  return from_warped(place);
#endif
  precise dvec2 center = view.xy + ((dvec2(texel.xy) + 0.5lf) / double(resolution) * 2.0lf - 1.0lf) * view.z;
  return center;
}

// The light's ray through the centre of a texel, in light space. The direction is not normalised.
void texel_ray(ivec3 texel, out dvec3 origin, out dvec3 direction) {
  dvec2 c = texel_center(texel);
#if MAP_KIND == MAP_ORTHOGRAPHIC
  origin = dvec3(c, 0.0lf);
  direction = dvec3(0.0lf, 0.0lf, -1.0lf);
#elif MAP_KIND == MAP_PERSPECTIVE
  origin = dvec3(0.0lf);
  direction = dvec3(c, -1.0lf);
#elif MAP_KIND == MAP_PARABOLOID
  origin = dvec3(0.0lf);
  double side = texel.z == 0 ? 1.0lf : -1.0lf;
  precise dvec3 on_paraboloid = dvec3(side * 2.0lf * c.x, 2.0lf * c.y, -side * (1.0lf - (c.x * c.x + c.y * c.y)));
  direction = on_paraboloid;
#else
  origin = dvec3(0.0lf);
  precise dvec3 sum =
      face_basis[3 * texel.z].xyz * c.x + face_basis[3 * texel.z + 1].xyz * c.y + face_basis[3 * texel.z + 2].xyz;
  direction = sum;
#endif
}

// Side length of a texel at the receiver, metres: texel_at() of techniques/shadow/map_layout.h.
float texel_at(Receiver receiver) {
#if MAP_WARPED
  return float(warped_texel(receiver.in_light.xy));
#endif
#if MAP_KIND == MAP_ORTHOGRAPHIC
  double half_extent = map_views[receiver.view].z;
#else
  double half_extent = map_views[0].z;
#endif
  precise double side = 2.0lf * half_extent / double(resolution);
#if MAP_KIND != MAP_ORTHOGRAPHIC
  side *= receiver.axis_depth;
#endif
  return float(side);
}

// Metres per unit of constant bias at a receiver: bias_unit_of() of tests/support/reference/taps.cpp.
float bias_unit_of(Receiver receiver, float texel) {
#if MAP_KIND == MAP_ORTHOGRAPHIC
  precise float factor = bias_factors[receiver.view / 4][receiver.view % 4];
#else
  float factor = 1.0;
#endif
  if (bias_unit == BIAS_IN_TEXELS) return factor * texel;
  if (bias_unit != BIAS_IN_MAP_DEPTH) return factor;
  if (encoded_near == 0.0lf) return factor * float(far_depth);
  precise double metres =
      receiver.depth * receiver.depth * (encoded_far - encoded_near) / (encoded_near * encoded_far);
  return float(metres);
}

// With COMPARES_ENCODED depths are compared as the map stores them, and not in metres. Their difference is then scaled by
// the unit of the bias, so that critical biases stay in metres at the receiver.

// The depth of the surface in a tap's texel, metres.
double blocker_depth(Receiver receiver, float critical_bias) {
#if COMPARES_ENCODED
  precise double depth = receiver.depth * receiver.depth / (receiver.depth + double(critical_bias));
#else
  precise double depth = receiver.depth - double(critical_bias);
#endif
  return depth;
}

// Depth with which a tap compares its texel, metres: that of the receiver or, with receiver_plane, of the receiver's
// plane on the light's ray through the texel's centre (J. Isidoro, Shadow Mapping: GPU-based Tips and Techniques, GDC
// 2006). A ray that does not meet the plane from its front leaves the receiver's depth.
double compared_depth(Receiver receiver, ivec3 texel) {
#if RECEIVER_PLANE
  dvec3 origin;
  dvec3 direction;
  texel_ray(texel, origin, direction);
  double facing = dot_of(receiver.plane, direction);
  if (facing < 0.0lf) {
    precise double along = dot_of(receiver.plane, receiver.in_light - origin) / facing;
#if IS_OMNIDIRECTIONAL
    along *= length_of(direction);
#endif
#if MAP_KIND != MAP_ORTHOGRAPHIC
    if (along <= 0.0lf) return receiver.depth;
#endif
    return along;
  }
#endif
  return receiver.depth;
}

// The tap at an offset, in texels right and up, from the receiver's texel. If the texel lies outside a cube's face, the
// tap is the texel of another face in the same direction.
Tap fetch_tap(Receiver receiver, ivec2 offset) {
  Tap tap;
  tap.texel = ivec3(receiver.texel + offset, receiver.view);
  bool is_on_map = all(greaterThanEqual(tap.texel.xy, ivec2(0))) && all(lessThan(tap.texel.xy, ivec2(resolution)));
#if IS_OMNIDIRECTIONAL
  dvec3 origin;
  dvec3 direction;
#if MAP_KIND == MAP_PARABOLOID
  // Texels outside the circle see the other hemisphere.
  texel_ray(tap.texel, origin, direction);
  is_on_map = is_on_map && face_of(direction) == tap.texel.z;
#endif
  if (!is_on_map) {
    texel_ray(tap.texel, origin, direction);
    int face = face_of(direction);
    dvec3 q = on_face(face, direction);
    precise dvec2 texels = (q.xy / (q.z * map_views[0].z) * 0.5lf + 0.5lf) * double(resolution);
    ivec2 texel = ivec2(floor(texels));
    tap.texel = ivec3(clamp(texel, ivec2(0), ivec2(resolution - 1)), face);
    is_on_map = true;
  }
#endif
  float stored = receiver.is_inside && is_on_map ? texelFetch(shadow_depth, tap.texel, 0).r : empty_depth;
  tap.has_blocker = stored < empty_depth;
  double compared = compared_depth(receiver, tap.texel);
  precise double blocker = double(stored) * far_depth;
#if STORES_OVER_W && !RECEIVER_PLANE
  // The depth that has this texel's number at the receiver's w.
  precise double ratio = (receiver.in_light.y - warp_center.y) / warp_w(double(tap.texel.y) + 0.5lf);
  blocker = warp_middle_depth + (blocker - warp_middle_depth) * ratio;
#endif
#if ROUNDS_RECEIVERS && !RECEIVER_PLANE
  blocker = passing_depth(blocker, tie_shift, encoded_near, encoded_far);
#endif
  precise double above = compared - blocker;
#if COMPARES_ENCODED
  // The difference of the reciprocal depths, times the square of the receiver's.
  precise double scale = receiver.depth * receiver.depth / (max(compared, encoded_near) * max(blocker, encoded_near));
  above *= scale;
#endif
#if CONE_BIAS
  precise dvec2 away = dvec2(receiver.texel + offset) + 0.5lf - receiver.texels;
  precise double squared = away.x * away.x + away.y * away.y;
  precise double moved = double(cone_bias) * sqrt(squared) * double(texel_at(receiver));
  above -= moved;
#endif
  tap.critical_bias = tap.has_blocker ? float(above) : no_blocker;
  return tap;
}

// The smallest constant bias, in metres, at which a tap is lit. slope is texel size · tan θ. NaN if the surface is
// parallel to the light's direction: the tap is blocked at every bias.
float flip_bias(float critical_bias, float slope, float slope_factor) {
  precise float flip = critical_bias - slope_factor * slope;
  return flip;
}

// Whether a tap is lit at a bias. All depth comparisons in the shaders call it. bias_unit: metres per unit of bias.
bool is_lit_at(float bias, float bias_unit, float flip) {
  precise float metres = bias * bias_unit;
  return metres >= flip;
}
