// What the AO methods read of the screen: positions from depths, and slices. The shaders compile this text as GLSL, and
// screen.h compiles it as members of a C++ struct. Both provide depth_at() (along the camera's axis, metres; infinite on
// background), clip_from_view, size and is_orthographic. Positions and directions are in view space; pixels count from
// the lower left corner.

struct AoSurfel {
  ivec2 pixel;
  vec3 position;
  vec3 normal;
  vec2 noise;  // two numbers from 0 to 1 for the pixel
};

/// The plane through the direction to the viewer and a direction on the screen.
struct AoSlice {
  vec2 step;            // one pixel on the screen
  vec3 towards;         // the same direction, perpendicular to the viewer's, unit
  float normal_angle;   // from the viewer's direction to the normal projected into the plane, positive along `towards`
  float normal_length;  // of the projected normal
};

bool is_in_image(ivec2 pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y;
}

bool has_surface(ivec2 pixel) {
  return is_in_image(pixel) && depth_at(pixel) < 1e30f;
}

/// The point at the centre of a pixel, at that distance along the camera's axis.
vec3 position_at(ivec2 pixel, float distance) {
  float z = -distance;
  float w = clip_from_view[2][3] * z + clip_from_view[3][3];
  float x = (2.0f * (float(pixel.x) + 0.5f) / float(size.x) - 1.0f) * w;
  float y = (2.0f * (float(pixel.y) + 0.5f) / float(size.y) - 1.0f) * w;
  return vec3((x - clip_from_view[2][0] * z - clip_from_view[3][0]) / clip_from_view[0][0],
              (y - clip_from_view[2][1] * z - clip_from_view[3][1]) / clip_from_view[1][1], z);
}

/// The surface at the centre of a pixel.
vec3 seen_position(ivec2 pixel) {
  return position_at(pixel, depth_at(pixel));
}

vec3 direction_to_viewer(vec3 position) {
  return is_orthographic != 0 ? vec3(0.0f, 0.0f, 1.0f) : normalize(-position);
}

/// Of a length across the screen at that depth.
float pixels_per_metre(vec3 position) {
  float w = clip_from_view[2][3] * position.z + clip_from_view[3][3];
  return 0.5f * float(size.x) * clip_from_view[0][0] / w;
}

ivec2 pixel_at(AoSurfel surfel, vec2 offset) {
  return surfel.pixel + ivec2(floor(offset + vec2(0.5f)));
}

/// Azimuths are even in the image or, if is_even_in_angle, about the viewer's direction. In the centre of the image
/// both are the same.
AoSlice make_slice(AoSurfel surfel, vec3 viewer, float azimuth, int is_even_in_angle) {
  AoSlice slice;
  float c = cos(azimuth);
  float s = sin(azimuth);
  vec2 scale = vec2(clip_from_view[0][0] * float(size.x), clip_from_view[1][1] * float(size.y));
  if (is_even_in_angle != 0) {
    vec3 right = normalize(cross(vec3(0.0f, 1.0f, 0.0f), viewer));
    slice.towards = c * right + s * cross(viewer, right);
    // The derivative of the projected position.
    vec4 clip = clip_from_view * vec4(surfel.position, 1.0f);
    vec4 change = clip_from_view * vec4(slice.towards, 0.0f);
    slice.step = normalize(vec2((change.x * clip.w - clip.x * change.w) * float(size.x),
                                (change.y * clip.w - clip.y * change.w) * float(size.y)));
  } else {
    slice.step = vec2(c, s);
    vec3 across = vec3(c / scale.x, s / scale.y, 0.0f);
    slice.towards = normalize(across - viewer * dot(across, viewer));
  }
  float along = dot(surfel.normal, slice.towards);
  float up = dot(surfel.normal, viewer);
  slice.normal_length = sqrt(along * along + up * up);
  slice.normal_angle = atan(along, up);
  return slice;
}
