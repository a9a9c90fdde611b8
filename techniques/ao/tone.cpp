#include "techniques/ao/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace umbrameter {

Parameters describe(AoToneParams& params) {
  static constexpr std::array<std::string_view, 2> sources{"constant", "surface"};
  return Description("ao")
      .field("intensity", params.intensity,
             {.unit = "1", .meaning = "factor on the occlusion, after the blur", .min = 0.0})
      .field("power", params.power,
             {.unit = "1", .meaning = "exponent of the result, after blur and intensity", .min = 0.01, .max = 100.0})
      .field("multi-bounce", params.multi_bounce,
             {.unit = {}, .meaning = "brighten by the light of further bounces, after the blur and before intensity"})
      .field("multi-bounce-albedo", params.albedo,
             {.unit = "1", .meaning = "multi-bounce: albedo of all surfaces", .min = 0.0, .max = 1.0})
      .choice(
          "multi-bounce-albedo-source", params.albedo_source, sources,
          {.unit = {},
           .meaning = "multi-bounce: one albedo for all surfaces, or the luminance of each surfel's diffuse albedo"})
      .take();
}

float with_bounces(float ao, double albedo) {
  const auto rho = static_cast<float>(albedo);
  const float a = 2.0404f * rho - 0.3324f;
  const float b = -4.7951f * rho + 0.6417f;
  const float c = 2.7552f * rho + 0.6903f;
  return std::clamp(((a * ao + b) * ao + c) * ao, ao, 1.0f);
}

float with_tone(float ao, const AoToneParams& params) {
  if (params.multi_bounce) ao = with_bounces(ao, params.albedo);
  if (params.intensity != 1.0) ao = std::max(0.0f, 1.0f - static_cast<float>(params.intensity) * (1.0f - ao));
  return params.power == 1.0 ? ao : std::pow(ao, static_cast<float>(params.power));
}

AoToneParams at_surface(AoToneParams params, const vec3& base_color, float metallic) {
  if (!reads_surface(params)) return params;
  const double luminance = glm::dot(dvec3(0.2126, 0.7152, 0.0722), dvec3(base_color));
  params.albedo = std::clamp(luminance * (1.0 - static_cast<double>(metallic)), 0.0, 1.0);
  return params;
}

AoToneParams at_surface(const AoToneParams& params, const GBuffer& gbuffer, std::size_t pixel) {
  return at_surface(params, gbuffer.albedo[pixel], gbuffer.metallic[pixel]);
}

}  // namespace umbrameter
