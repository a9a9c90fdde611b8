// How a compact G-buffer stores normals and shininess. Compiled as GLSL and as C++, like light_model.glsl.

SHARED float sign_or_one(float x) { return x < 0.0f ? -1.0f : 1.0f; }

/// Maps a unit vector to a point of the square [−1, 1]² (Cigolle et al., Survey of Efficient Representations for
/// Independent Unit Vectors, JCGT 3(2), 2014).
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

/// Shininess from 1 to 2048 as a number from 0 to 1. In 8 bits, one step changes the shininess by 3 %.
SHARED float encoded_shininess(float shininess) { return log2(shininess) / 11.0f; }
SHARED float decoded_shininess(float code) { return exp2(11.0f * code); }
