// Bilinear filtering of mip level 0 in full precision, because hardware filters with 8-bit weights and the results must
// agree with the ray tracer's. Wrap modes are those of enum Wrap: repeat, mirrored repeat, clamp to edge.
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

vec4 texel_at(sampler2D image, ivec2 texel, bool is_srgb) {
  vec4 value = texelFetch(image, texel, 0);
  return is_srgb ? vec4(linear_from_srgb(value.rgb), value.a) : value;
}

vec4 sample_bilinear(sampler2D image, ivec2 wrap, vec2 texcoord, bool is_srgb) {
  ivec2 n = textureSize(image, 0);
  vec2 p = vec2(wrap_coordinate(texcoord.x, wrap.x), wrap_coordinate(texcoord.y, wrap.y)) * vec2(n) - 0.5;
  ivec2 first = ivec2(floor(p));
  vec2 f = p - vec2(first);
  int x0 = wrap_texel(first.x, n.x, wrap.x);
  int x1 = wrap_texel(first.x + 1, n.x, wrap.x);
  int y0 = wrap_texel(first.y, n.y, wrap.y);
  int y1 = wrap_texel(first.y + 1, n.y, wrap.y);
  vec4 top = mix(texel_at(image, ivec2(x0, y0), is_srgb), texel_at(image, ivec2(x1, y0), is_srgb), f.x);
  vec4 bottom = mix(texel_at(image, ivec2(x0, y1), is_srgb), texel_at(image, ivec2(x1, y1), is_srgb), f.x);
  return mix(top, bottom, f.y);
}
