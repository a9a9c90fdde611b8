// The light model. The shaders compile this text as GLSL, and light_model.h compiles it as C++ with GLM: there is one
// description, and both sides compute the same operations in the same order. docs/shading.md has the formulas.

/// A surfel, as the light model reads it. Directions are unit vectors.
struct SurfacePoint {
  vec3 position;   // world, metres
  vec3 normal;     // shading normal, world
  vec3 to_viewer;  // world
  vec3 diffuse;    // reflectance, linear
  vec3 specular;   // reflectance at normal incidence, linear
  float shininess;  // exponent of the Blinn-Phong lobe, 1 to 2048
};

/// A light, as the light model reads it.
struct LightSource {
  vec4 position_range;  // xyz: world, metres; w: range, metres; 0 is unlimited
  vec4 axis_kind;       // xyz: direction of travel, unit; w: 0 directional, 1 point, 2 spot
  vec4 color_cone;      // rgb: colour × intensity, in lux if directional, else candela; w: outer cone angle, radians
  vec4 cone;            // x, y: cosines of the inner and outer cone angle
};

/// The choices of shading.* that the light model reads. The numbers are those of the enums in parameters.h.
struct LightModel {
  vec4 attenuation_factors;  // constant, linear (1/m) and quadratic (1/m²) coefficient
  int specular;              // 0 phong, 1 blinn-phong
  int normalization;         // 0 energy, 1 none
  int attenuation;           // 0 inverse-square, 1 polynomial
  int spot_falloff;          // 0 smooth, 1 linear
};

/// Reflected light, by term.
struct Reflection {
  vec3 diffuse;
  vec3 specular;
};

/// base^exponent for a base from 0 to 1. The relative error is about 1e-6; that of pow() is 1e-4 in some drivers.
/// Uses ln m = 2 artanh((m − 1) / (m + 1)) for the mantissa m, and the Taylor series of 2^f.
SHARED float power(float base, float exponent) {
  if (base <= 0.0f) return 0.0f;
  int two_exponent = 0;
  float mantissa = frexp(base, two_exponent);
  if (mantissa < 0.70710678f) {
    mantissa = mantissa * 2.0f;
    two_exponent = two_exponent - 1;
  }
  float s = (mantissa - 1.0f) / (mantissa + 1.0f);
  float s2 = s * s;
  float logarithm = 2.0f * s * (1.0f + s2 * (1.0f / 3.0f + s2 * (0.2f + s2 * (1.0f / 7.0f + s2 * (1.0f / 9.0f)))));
  float log2_power = exponent * (float(two_exponent) + logarithm * 1.44269504f);
  if (log2_power < -126.0f) return 0.0f;
  float whole = floor(log2_power);
  float f = (log2_power - whole) * 0.69314718f;
  float fraction =
      1.0f +
      f * (1.0f + f * (0.5f + f * (1.0f / 6.0f +
                                   f * (1.0f / 24.0f + f * (1.0f / 120.0f + f * (1.0f / 720.0f + f * (1.0f / 5040.0f)))))));
  return ldexp(fraction, int(whole));
}

/// acos(x), radians, with an error below 2e-8 (Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.46).
SHARED float arc_cosine(float x) {
  float a = min(abs(x), 1.0f);
  float series =
      1.5707963050f +
      a * (-0.2145988016f +
           a * (0.0889789874f +
                a * (-0.0501743046f +
                     a * (0.0308918810f + a * (-0.0170881256f + a * (0.0066700901f + a * -0.0012624911f))))));
  float angle = sqrt(1.0f - a) * series;
  return x < 0.0f ? 3.14159265f - angle : angle;
}

/// The factor on the light's intensity at this distance: 1/m² for inverse-square, 0 beyond the range.
SHARED float attenuation_at(float distance, float range, LightModel model) {
  if (range > 0.0f && distance >= range) return 0.0f;
  if (model.attenuation == 1) {
    return 1.0f / (model.attenuation_factors.x + distance * (model.attenuation_factors.y +
                                                             distance * model.attenuation_factors.z));
  }
  float window = 1.0f;
  if (range > 0.0f) {
    float share = distance / range;
    window = 1.0f - share * share * share * share;
  }
  return window / max(distance * distance, 1.0e-12f);
}

/// The factor on a spot light's intensity, 0 to 1, in a direction with this cosine to its axis.
SHARED float spot_factor(float cosine, LightSource light, LightModel model) {
  if (cosine <= light.cone.y) return 0.0f;
  if (model.spot_falloff == 1) return max(1.0f - arc_cosine(cosine) / light.color_cone.w, 0.0f);
  float edge = min((cosine - light.cone.y) / max(light.cone.x - light.cone.y, 0.001f), 1.0f);
  return edge * edge;
}

/// Whether the position lies in the volume of a light with a range: in its sphere and, for a spot light, in its cone.
SHARED bool is_in_volume(vec3 position, LightSource light) {
  // In one order of operations, so that all shaders that ask give one answer.
  PRECISE vec3 offset = position - vec3(light.position_range);
  PRECISE float square = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
  float distance = sqrt(square);
  if (distance >= light.position_range.w) return false;
  PRECISE float along =
      offset.x * light.axis_kind.x + offset.y * light.axis_kind.y + offset.z * light.axis_kind.z;
  PRECISE float edge = light.cone.y * distance;
  return light.axis_kind.w < 1.5f || along > edge;
}

/// The factor with which a lobe of this exponent reflects all light at normal incidence, and less elsewhere. Phong:
/// (n + 2) / 2π (Lafortune and Willems 1994). Blinn-Phong: (n + 2)(n + 4) / 8π(2^(−n/2) + n) (Giesen, Phong Normalization
/// Factor Derivation, 2009).
SHARED float lobe_scale(float exponent, int specular) {
  if (specular == 0) return (exponent + 2.0f) * 0.15915494309f;
  return (exponent + 2.0f) * (exponent + 4.0f) * 0.03978873577f / (power(0.5f, 0.5f * exponent) + exponent);
}

/// The light that the surfel reflects to the viewer if nothing blocks it: incoming light, cosine and reflectance.
SHARED Reflection reflect_light(SurfacePoint surface, LightSource light, LightModel model) {
  Reflection reflection;
  reflection.diffuse = vec3(0.0f);
  reflection.specular = vec3(0.0f);
  vec3 to_light = -vec3(light.axis_kind);
  float strength = 1.0f;
  if (light.axis_kind.w > 0.5f) {
    vec3 offset = vec3(light.position_range) - surface.position;
    float distance = length(offset);
    if (distance <= 0.0f) return reflection;
    to_light = offset / distance;
    strength = attenuation_at(distance, light.position_range.w, model);
    if (light.axis_kind.w > 1.5f) {
      strength = strength * spot_factor(-dot(to_light, vec3(light.axis_kind)), light, model);
    }
  }
  float cosine = dot(surface.normal, to_light);
  if (cosine <= 0.0f || strength <= 0.0f) return reflection;
  vec3 incoming = strength * vec3(light.color_cone);
  float lobe_cosine = 0.0f;
  float exponent = surface.shininess;
  if (model.specular == 1) {
    vec3 sum = to_light + surface.to_viewer;
    float size = length(sum);
    if (size > 0.0f) lobe_cosine = dot(surface.normal, sum) / size;
  } else {
    // With a quarter of the exponent, a Phong lobe is about as wide as the Blinn-Phong lobe.
    exponent = max(0.25f * surface.shininess, 1.0f);
    lobe_cosine = 2.0f * cosine * dot(surface.normal, surface.to_viewer) - dot(to_light, surface.to_viewer);
  }
  float lobe = power(min(max(lobe_cosine, 0.0f), 1.0f), exponent);
  if (model.normalization == 0) {
    float scale = lobe_scale(exponent, model.specular);
    reflection.diffuse = surface.diffuse * incoming * (cosine * 0.31830988618f);
    reflection.specular = surface.specular * incoming * (cosine * scale * lobe);
  } else {
    reflection.diffuse = surface.diffuse * incoming * cosine;
    reflection.specular = surface.specular * incoming * lobe;
  }
  return reflection;
}

/// The reflected part of ambient light, which arrives equally from every direction.
SHARED vec3 reflect_ambient(SurfacePoint surface, float ambient) {
  return (surface.diffuse + surface.specular) * ambient;
}

/// The exponent of the Blinn-Phong lobe that is as wide as a GGX lobe with α = roughness²: 2/α² − 2, from 1 to 2048
/// (Walter et al., Microfacet Models for Refraction, 2007; Karis, Specular BRDF Reference, 2013).
SHARED float shininess_of(float roughness) {
  float alpha = max(roughness * roughness, 0.001f);
  return min(max(2.0f / (alpha * alpha) - 2.0f, 1.0f), 2048.0f);
}

/// The inverse of shininess_of().
SHARED float roughness_of(float shininess) { return sqrt(sqrt(2.0f / (shininess + 2.0f))); }
