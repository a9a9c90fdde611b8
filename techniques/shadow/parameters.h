// Parameters of shadow maps, bias and PCF. technique.h combines them into the shadow.* parameters.
#pragma once

#include "core/parameters.h"
#include "techniques/shadow/normal_offset.h"

namespace umbrameter {

enum class ShadowFilter : int { nearest, bilinear, box, tent, gaussian, poisson, vogel, optimized, area_tent };
enum class FilterTaps : int { nearest, linear };
/// Rotation of a disk of taps: one of 64 at random per pixel, none, or interleaved gradient noise.
enum class DiskRotation : int { random, fixed, gradient };

/// The shadow map itself.
struct ShadowMapParams {
  int resolution = 1024;
  int cascades = 1;
};
Parameters describe(ShadowMapParams& params);

/// A tap is lit if and only if constant ≥ β − slope · m, where β = receiver depth − stored depth is the critical bias
/// and m = texel size at the receiver · tan θ; all in metres. A constant bias in texels is multiplied by the texel size
/// at the receiver. One in the map's depth is compared in that depth: metres_per_map_depth() of it at the receiver.
/// With receiver_plane, the receiver depth is that of its plane at the tap's texel centre. The cone bias moves the
/// receiver towards the light by `cone` times the distance from the receiver to the texel's centre.
struct BiasParams {
  Length constant{1.5, LengthUnit::texels};
  double slope = 0.0;
  NormalOffset normal_offset;
  OffsetDirection offset_direction = OffsetDirection::normal;
  OffsetFacing offset_facing = OffsetFacing::viewer;
  OffsetTexel offset_texel = OffsetTexel::receiver;
  bool receiver_plane = false;
  double cone = 0.0;
};
Parameters describe(BiasParams& params);

/// Percentage-closer filtering.
struct PcfParams {
  ShadowFilter filter = ShadowFilter::nearest;
  int size = 3;
  FilterTaps taps = FilterTaps::nearest;
  int samples = 16;
  double radius = 2.0;
  DiskRotation rotation = DiskRotation::random;
};
Parameters describe(PcfParams& params);

/// Percentage-closer soft shadows. Its taps are a disk with the samples and the rotation of PcfParams.
struct PcssParams {
  int blockers = 32;
  double light_scale = 1.0;
  double max_radius = 64.0;
  double min_radius = 0.0;
  bool search_cone = true;
};
Parameters describe(PcssParams& params);

}  // namespace umbrameter
