// The march of screen-space shadows through the camera's depth buffer. The shaders compile this text as GLSL, and
// screen_space.h compiles it as C++ with GLM. docs/techniques/screen-space.md describes it.

struct MarchSettings {
  float reach;      // length of the ray, metres
  int steps;
  float thickness;  // of every surface along the camera's axis, metres
  float bias;       // share of the depth by which a surface must lie in front of the ray
  int is_jittered;
  int uses_plane;   // 1: only what lies in front of the receiver's plane blocks
};

/// From the surfel to the end of its ray. x and y: pixels from the image's lower left corner. z is linear in them: the
/// inverse of the depth along the camera's axis or, for an orthographic camera, that depth.
struct March {
  vec3 start;
  vec3 end;
  float jitter;  // above 0, at most 1
};

/// World position to pixels and depth along the camera's axis, metres.
SHARED dvec3 on_screen(dmat4 view_from_world, dmat4 clip_from_world, ivec2 size, dvec3 world) {
  dvec4 clip = clip_from_world * dvec4(world.x, world.y, world.z, 1);
  dvec4 view = view_from_world * dvec4(world.x, world.y, world.z, 1);
  return dvec3((clip.x / clip.w + 1) / 2 * double(size.x), (clip.y / clip.w + 1) / 2 * double(size.y),
               -view.z);
}

/// Length of a ray that does not leave the space in front of a perspective camera: it ends where the depth has fallen to
/// a sixteenth. `approach` is the depth that the ray loses per metre.
SHARED double length_before_camera(double reach, double depth, double approach) {
  double at_most = 15 * depth / 16;
  return reach * approach > at_most ? at_most / approach : reach;
}

/// Interleaved gradient noise, 0 to 1 (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare,
/// SIGGRAPH 2014).
SHARED float gradient_noise(ivec2 pixel) {
  return fract(52.9829189f * fract(0.06711056f * float(pixel.x) + 0.00583715f * float(pixel.y)));
}

/// The ray from a surfel to `end`; `pixel` is the surfel's, row 0 the bottom row.
SHARED March make_march(dvec3 start, dvec3 end, int is_orthographic, ivec2 pixel, MarchSettings settings) {
  March march;
  march.start = vec3(start);
  march.end = vec3(end);
  if (is_orthographic == 0) {
    march.start.z = 1.0f / march.start.z;
    march.end.z = 1.0f / march.end.z;
  }
  march.jitter = settings.is_jittered != 0 ? 1.0f - gradient_noise(pixel) : 1.0f;
  return march;
}

/// The i-th of the samples, which are evenly spaced on the screen: pixels and depth along the camera's axis, metres.
SHARED vec3 march_sample(March march, int i, int is_orthographic, MarchSettings settings) {
  float part = (float(i) + march.jitter) / float(settings.steps);
  vec3 at = march.start + part * (march.end - march.start);
  if (is_orthographic == 0) at.z = 1.0f / at.z;
  return at;
}

/// Whether a surface `above` the receiver's plane, metres, can block a ray that leaves it at this depth. What the plane
/// itself shows in other pixels cannot; without this test their depth, of the pixel's centre instead of the sample,
/// blocks rays wherever the camera sees the plane at a grazing angle.
SHARED bool is_before_plane(float above, float depth, MarchSettings settings) {
  return settings.uses_plane == 0 || above > settings.bias * depth;
}

/// Whether a surface at the depth `stored` blocks a ray at `depth`.
SHARED bool blocks_march(float depth, float stored, MarchSettings settings) {
  float behind = depth - stored;
  return behind > settings.bias * depth && behind < settings.thickness;
}
