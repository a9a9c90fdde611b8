// How a compact G-buffer stores normals, depth and shininess. Shared by shaders and C++, as light_model.glsl is.
#ifndef SHARED
#define SHARED
#endif

SHARED float sign_or_one(float x) { return x < 0.0f ? -1.0f : 1.0f; }

/// A unit vector as a point of the square [−1, 1]² (Cigolle et al., Survey of Efficient Representations for Independent
/// Unit Vectors, JCGT 3(2), 2014).
SHARED vec2 octahedral_from_unit(vec3 n) {
  vec2 p = vec2(n.x, n.y) / (abs(n.x) + abs(n.y) + abs(n.z));
  if (n.z >= 0.0f) return p;
  return vec2((1.0f - abs(p.y)) * sign_or_one(p.x), (1.0f - abs(p.x)) * sign_or_one(p.y));
}

SHARED vec3 unit_from_octahedral(vec2 p) {
  vec3 n = vec3(p.x, p.y, 1.0f - abs(p.x) - abs(p.y));
  if (n.z < 0.0f) {
    float x = n.x;
    n.x = (1.0f - abs(n.y)) * sign_or_one(x);
    n.y = (1.0f - abs(x)) * sign_or_one(n.y);
  }
  return normalize(n);
}

/// What a normalised integer of this many steps stores of a number from 0 to 1.
SHARED float quantized(float x, float steps) { return floor(min(max(x, 0.0f), 1.0f) * steps + 0.5f) / steps; }

/// Shininess from 1 to 2048 as a number from 0 to 1: a step of 8 bits is 3 %.
SHARED float encoded_shininess(float shininess) { return log2(shininess) / 11.0f; }
SHARED float decoded_shininess(float code) { return exp2(11.0f * code); }
