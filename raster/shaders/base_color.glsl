// Base colour and alpha from mip level 0. Bilinear filtering is done here in full precision, because hardware filters
// with 8-bit weights and the alpha test must agree with the ray tracer's.
uniform vec4 base_color_factor;
uniform ivec2 wrap;  // enum Wrap: repeat, mirrored repeat, clamp to edge
uniform int has_texture;
uniform sampler2D base_color_texture;

int wrap_texel(int i, int n, int mode) {
  if (mode == 2) return clamp(i, 0, n - 1);
  if (mode == 1) {
    int j = i < 0 ? -1 - i : (i >= 2 * n ? i - 2 * n : i);
    return j >= n ? 2 * n - 1 - j : j;
  }
  return i < 0 ? i + n : (i >= n ? i - n : i);
}

// Wraps a coordinate to the first period, so that texel indices are at most one texel outside it.
float wrap_coordinate(float u, int mode) {
  if (mode == 2) return clamp(u, -1.0, 2.0);
  if (mode == 1) return u - 2.0 * floor(0.5 * u);
  return u - floor(u);
}

// The sRGB transfer function of IEC 61966-2-1.
vec3 linear_from_srgb(vec3 c) {
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

vec4 base_color_texel(ivec2 texel, bool decode) {
  vec4 value = texelFetch(base_color_texture, texel, 0);
  return decode ? vec4(linear_from_srgb(value.rgb), value.a) : value;
}

vec4 base_color_at(vec2 texcoord, bool decode) {
  if (has_texture == 0) return base_color_factor;
  ivec2 n = textureSize(base_color_texture, 0);
  vec2 p = vec2(wrap_coordinate(texcoord.x, wrap.x), wrap_coordinate(texcoord.y, wrap.y)) * vec2(n) - 0.5;
  ivec2 first = ivec2(floor(p));
  vec2 f = p - vec2(first);
  int x0 = wrap_texel(first.x, n.x, wrap.x);
  int x1 = wrap_texel(first.x + 1, n.x, wrap.x);
  int y0 = wrap_texel(first.y, n.y, wrap.y);
  int y1 = wrap_texel(first.y + 1, n.y, wrap.y);
  vec4 top = mix(base_color_texel(ivec2(x0, y0), decode), base_color_texel(ivec2(x1, y0), decode), f.x);
  vec4 bottom = mix(base_color_texel(ivec2(x0, y1), decode), base_color_texel(ivec2(x1, y1), decode), f.x);
  return base_color_factor * mix(top, bottom, f.y);
}
