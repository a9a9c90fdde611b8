// The truth.* parameters, which control the reference.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoWeight : int { cosine, uniform };

/// The points that determine a pixel's rays: Owen-scrambled Sobol points, or independent random ones for comparison.
enum class Sampler : int { owen, random };

/// How much a hit occludes, as a function of its distance: see falloff_weight().
enum class AoFalloff : int { none, linear, quadratic, ssao, sao, hbao, gtao };

/// The axis of the hemisphere. Directions below the triangle's plane are blocked, at distance 0.
enum class AoNormal : int { geometric, shading };

/// Layers besides accessibility. They need the nearest hit, which is slower than any hit.
enum class AoLayers : int { none, bent_normal, hit_distance, all };

/// The measure of an area light whose visible share is its visibility. `area`: its area; for a sphere, that of the disk
/// that the surfel sees; for a distant light, that of its disk in the plane perpendicular to its axis. `solid_angle`:
/// the solid angle that it spans at the surfel.
enum class LightSampling : int { area, solid_angle };

/// What the reference of a shadow is. `light`: at the pixel's centre, the visible share of an area light, and 0 or 1 of
/// a light without extent. `point`: at the pixel's centre, 0 or 1, as if no light had extent. `pixel`: the mean over
/// the pixel's footprint, and over an area light.
enum class ShadowReference : int { point, pixel, light };

/// The truth.* parameters.
struct TruthParams {
  int spp = 256;
  AoWeight ao_weight = AoWeight::cosine;
  Length ao_distance{0.0, LengthUnit::automatic};
  Sampler sampler = Sampler::owen;
  double tolerance = 0.0;
  int min_spp = 128;
  int max_spp = 16384;
  AoFalloff ao_falloff = AoFalloff::none;
  AoNormal ao_normal = AoNormal::geometric;
  AoLayers ao_layers = AoLayers::none;
  LightSampling light_sampling = LightSampling::area;
  ShadowReference shadow = ShadowReference::light;
};
Parameters describe(TruthParams& params);

/// Throws Error (usage) when parameters contradict one another.
void check(const TruthParams& params);

/// How much a hit at this distance occludes, 0 to 1. `distance` and `limit`, the distance limit, are in metres.
///   none, linear: 1, 1 − x with x = distance / limit
///   quadratic, hbao: 1 − x² (Bavoil and Sainz, Image-Space Horizon-Based Ambient Occlusion, 2008)
///   sao: (1 − x²)³ (McGuire, Mara and Luebke, Scalable Ambient Obscurance, 2012)
///   gtao: 1 up to x = 0.385, from there linearly to 0 (Jimenez et al., Practical Real-Time Strategies for Accurate
///     Indirect Occlusion, 2016, as set in Intel's XeGTAO)
///   ssao: smoothstep of limit / distance, 1 up to the limit and fading beyond it without end (the range check of
///     hemisphere SSAO)
double falloff_weight(AoFalloff falloff, double distance, double limit);

/// Whether the distance limit is a number of metres above 0. An automatic limit does not count: the caller must replace
/// it by that of the technique first.
bool has_distance_limit(const TruthParams& params);

/// Distance beyond which no hit counts, metres; infinite without a limit.
double reach_of(const TruthParams& params);

}  // namespace umbrameter
