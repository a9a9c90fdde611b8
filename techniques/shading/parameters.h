// Parameters of shading (shading.*): the light model, the path that evaluates it, and the formats of the G-buffer.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class ShadingPath : int { forward, deferred };
enum class SpecularModel : int { phong, blinn_phong };
/// energy: physical units; a surface reflects at most the light it receives. none: the classic formula without π.
enum class ShadingNormalization : int { energy, none };
enum class Attenuation : int { inverse_square, polynomial };
enum class SpotFalloff : int { smooth, linear };
/// Which faces of a light volume are drawn: front faces in front of the surface, or back faces behind it.
enum class VolumeFaces : int { front, back };
enum class NormalFormat : int { rgb32f, rgb16f, rg16, rgb8 };
enum class DepthFormat : int { depth32f, depth24, depth16 };
enum class PositionSource : int { depth, stored };
enum class ColorFormat : int { rgba8, rgba32f };

struct ShadingParams {
  ShadingPath path = ShadingPath::forward;
  SpecularModel specular = SpecularModel::blinn_phong;
  ShadingNormalization normalization = ShadingNormalization::energy;
  double ambient = 0.1;
  double exposure = 1.0;
  Attenuation attenuation = Attenuation::inverse_square;
  double constant = 1.0;
  double linear = 0.0;
  double quadratic = 1.0;
  SpotFalloff spot_falloff = SpotFalloff::smooth;
  VolumeFaces volume_faces = VolumeFaces::back;
  NormalFormat normal_format = NormalFormat::rgb8;
  DepthFormat depth_format = DepthFormat::depth32f;
  PositionSource position = PositionSource::depth;
  ColorFormat color_format = ColorFormat::rgba8;
};
Parameters describe(ShadingParams& params);

/// The parameters that decide what the G-buffer of the deferred path stores.
Parameters gbuffer_parameters(ShadingParams& params);

}  // namespace umbrameter
