// What the reference is set to: the truth.* parameters.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoWeight : int { cosine, uniform };

/// Where a pixel's rays go: Owen-scrambled Sobol points, or independent random ones for comparison.
enum class Sampler : int { owen, random };

/// How much a hit occludes by its distance; falloff_weight() holds the formulas.
enum class AoFalloff : int { none, linear, quadratic, ssao, sao, hbao, gtao };

/// What the hemisphere stands on. Directions below the triangle's plane are blocked, at distance 0.
enum class AoNormal : int { geometric, shading };

/// Which layers are traced besides accessibility. They need the nearest hit, which is slower than any hit.
enum class AoLayers : int { none, bent_normal, hit_distance, all };

/// What of a light with extent visibility is the share of. `area`: of its area; of a sphere, of the disk that it shows
/// the surfel; of a distant light, of its disk in the plane across its axis. `solid_angle`: of the solid angle that it
/// spans at the surfel.
enum class LightSampling : int { area, solid_angle };

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
};
Parameters describe(TruthParams& params);

/// Throws Error (usage) when parameters contradict one another.
void check(const TruthParams& params);

/// Share, 0 to 1, by which a hit at that distance occludes; limit is the distance limit, both in metres.
///   none, linear: 1, 1 − x with x = distance / limit
///   quadratic, hbao: 1 − x² (Bavoil and Sainz, Image-Space Horizon-Based Ambient Occlusion, 2008)
///   sao: (1 − x²)³ (McGuire, Mara and Luebke, Scalable Ambient Obscurance, 2012)
///   gtao: 1 up to x = 0.385, from there linearly to 0 (Jimenez et al., Practical Real-Time Strategies for Accurate
///     Indirect Occlusion, 2016, as set in Intel's XeGTAO)
///   ssao: smoothstep of limit / distance, 1 up to the limit and fading beyond it without end (the range check of
///     hemisphere SSAO)
double falloff_weight(AoFalloff falloff, double distance, double limit);

/// Whether the distance limit is a number of metres above 0. An automatic one limits nothing: who knows the technique
/// puts in that technique's own.
bool has_distance_limit(const TruthParams& params);

/// Distance beyond which no hit counts, metres; infinite without a limit.
double reach_of(const TruthParams& params);

}  // namespace umbrameter
