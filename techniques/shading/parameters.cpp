#include "techniques/shading/parameters.h"

#include <array>
#include <string_view>

namespace umbrameter {
namespace {

using std::string_view;
constexpr std::array<string_view, 2> path_names{"forward", "deferred"};
constexpr std::array<string_view, 2> specular_names{"phong", "blinn-phong"};
constexpr std::array<string_view, 2> normalization_names{"energy", "none"};
constexpr std::array<string_view, 2> attenuation_names{"inverse-square", "polynomial"};
constexpr std::array<string_view, 2> spot_names{"smooth", "linear"};
constexpr std::array<string_view, 2> faces_names{"front", "back"};
constexpr std::array<string_view, 4> normal_names{"rgb32f", "rgb16f", "rg16", "rgb8"};
constexpr std::array<string_view, 3> depth_names{"depth32f", "depth24", "depth16"};
constexpr std::array<string_view, 2> position_names{"depth", "stored"};
constexpr std::array<string_view, 2> color_names{"rgba8", "rgba32f"};

}  // namespace

Parameters describe(ShadingParams& p) {
  return concatenate(
      {Description("shading")
           .choice("path", p.path, path_names, {.unit = {}, .meaning = "how the image is shaded", .basic = true})
           .choice("specular", p.specular, specular_names,
                   {.unit = {}, .meaning = "specular term", .aliases = {{"blinn", "blinn-phong"}}})
           .choice("normalization", p.normalization, normalization_names,
                   {.unit = {}, .meaning = "scale reflection so that it conserves energy, or the classic formula"})
           .field("ambient", p.ambient,
                  {.unit = "1", .meaning = "ambient light, reflected by every surface and scaled by AO", .min = 0.0})
           .field("exposure", p.exposure, {.unit = "1", .meaning = "factor on the linear image", .min = 1e-12})
           .choice("attenuation", p.attenuation, attenuation_names,
                   {.unit = {}, .meaning = "1/d² with the range window of KHR_lights_punctual, or 1/(c + l·d + q·d²)"})
           .field("constant", p.constant, {.unit = "1", .meaning = "c of the polynomial attenuation", .min = 0.0})
           .field("linear", p.linear, {.unit = "1/m", .meaning = "l of the polynomial attenuation", .min = 0.0})
           .field("quadratic", p.quadratic, {.unit = "1/m²", .meaning = "q of the polynomial attenuation", .min = 0.0})
           .choice(
               "spot-falloff", p.spot_falloff, spot_names,
               {.unit = {}, .meaning = "smooth as in KHR_lights_punctual, or linear in the angle from axis to edge"})
           .choice("volume-faces", p.volume_faces, faces_names,
                   {.unit = {}, .meaning = "faces of a light volume that the deferred path draws"})
           .take(),
       gbuffer_parameters(p)});
}

Parameters gbuffer_parameters(ShadingParams& p) {
  return Description("shading")
      .choice("normal-format", p.normal_format, normal_names,
              {.unit = {}, .meaning = "normals of the deferred G-buffer; rg16 is octahedral"})
      .choice("depth-format", p.depth_format, depth_names, {.unit = {}, .meaning = "depth of the deferred G-buffer"})
      .choice("position", p.position, position_names,
              {.unit = {}, .meaning = "positions rebuilt from depth, or stored as 32-bit floats"})
      .choice("color-format", p.color_format, color_names,
              {.unit = {}, .meaning = "diffuse and specular colour and shininess of the deferred G-buffer"})
      .take();
}

}  // namespace umbrameter
