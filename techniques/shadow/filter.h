// PCF kernels: which texels a filter reads and what each weighs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/math.h"
#include "techniques/shadow/parameters.h"

namespace umbrameter {

/// Percentage-closer soft shadows (R. Fernando, SIGGRAPH Sketches 2005): the radius of the filter's disk is that of the
/// penumbra, extent · (z − z_B) / z_B for a light at a place and extent · (z − z_B) for a directional one, where z is
/// the receiver's depth and z_B the mean depth of the blockers among the taps of a search; not below min_radius, which
/// it is without blockers, nor above max_radius.
struct BlockerSearch {
  std::vector<vec2> points;  ///< within the unit disk
  float extent = 0.0f;       ///< of the light: its radius in metres; directional: tangent of its angular radius
  float max_radius = 0.0f;   ///< texels
  float min_radius = 0.0f;   ///< texels
  bool is_in_cone = false;   ///< a blocker counts only inside the cone from the receiver to the light
};

/// Contact-hardening PCF (K. Myers, Shadow of Cold War; DPCF in Filament): one disk as wide as the light, extent for a
/// light at a place and extent · z for a directional one, whose taps also yield the mean depth of the blockers. The
/// share of blocked taps is hardened() with the softness penumbra / disk, both radii.
struct ContactHardening {
  float extent = 0.0f;      ///< as BlockerSearch::extent
  float max_radius = 0.0f;  ///< texels
};

/// Positions and weights of a filter's taps. Grid: the weights are the outer product of `kernel` with itself, centred
/// on the receiver's texel (even sizes: on the nearest texel corner); with linear_taps it is convolved with the
/// bilinear weights, which adds a row and a column. Area tent: a tent that is centred on the receiver itself; each
/// texel weighs as much as the tent has area above it. Disk: the texels at `points`, rotated per pixel by one of
/// `rotations`; each has weight 1.
struct FilterKernel {
  /// The position of a bilinear tap is rounded to 1/256 texel, as in graphics hardware (eight bits).
  static constexpr std::uint32_t texel_parts = 256;
  /// Maximum taps along a side of a grid. With the next odd size, the weights of a tent with linear taps overflow 32
  /// bits.
  static constexpr int largest_size = 29;

  /// Sum of an area tent's weights along a side.
  static constexpr std::uint32_t area_sum = 1024;
  /// Maximum side of an area tent. With the next size, integers of 32 bits overflow in shadow_filter.glsl.
  static constexpr int largest_area_size = 7;

  std::vector<std::uint32_t> kernel;  ///< of a grid: weights along one side; of an area tent only their number counts
  bool linear_taps = false;
  /// With linear taps the sums of the weights from the left are divided by this and rounded.
  std::uint32_t divisor = 1;
  bool is_area_tent = false;    ///< linear_taps is true too
  std::vector<vec2> points;     ///< of a disk: within the unit disk; empty for a grid
  std::vector<vec2> rotations;  ///< of a disk: cosine and sine
  DiskRotation rotation = DiskRotation::random;
  float radius = 0.0f;                          ///< of a disk, texels
  std::optional<BlockerSearch> search{};        ///< PCSS: it finds the radius of the disk
  std::optional<ContactHardening> hardening{};  ///< DPCF

  bool is_grid() const { return points.empty(); }
  /// Texels along a side of a grid.
  int side() const { return static_cast<int>(kernel.size()) + (linear_taps ? 1 : 0); }
  int tap_count() const { return is_grid() ? side() * side() : static_cast<int>(points.size()); }
  std::uint32_t weight_sum() const {
    if (!is_grid()) return static_cast<std::uint32_t>(points.size());
    if (is_area_tent) return area_sum * area_sum;
    std::uint32_t sum = 0;
    for (const std::uint32_t weight : kernel) sum += weight;
    if (linear_taps) sum = sum * texel_parts / divisor;
    return sum * sum;
  }
};

/// Weight sum of a tent, the kernel with the largest one. Along a side it is ((n + 1)/2)².
constexpr std::uint64_t largest_weight_sum(std::uint64_t size) {
  const std::uint64_t side = (size + 1) / 2 * ((size + 1) / 2) * FilterKernel::texel_parts;
  return side * side;
}
static_assert(largest_weight_sum(FilterKernel::largest_size) < std::uint64_t{1} << 32);

/// Box: equal weights. Tent: 1 2 … 2 1. Gaussian: exp(−x²/2σ²) at the texels' centres, σ = (size + 1) / 6 texels; sums
/// of weights from the left are rounded to 2⁻¹⁵. Bilinear: one linear tap, like `sampler2DShadow` with a linear filter.
/// Poisson: best-candidate samples (D. Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991).
/// Optimized: the kernels of linear taps in The Witness (I. Castaño, Shadow Mapping Summary, 2013). Area tent: Unity's
/// tent filters. Throws Error (usage) for a size that the kernel does not have.
FilterKernel make_filter(const PcfParams& params);

/// The parameters that the kernel reads.
Parameters read_parameters(PcfParams& params);

/// The disk of PCSS for a light of this extent: see BlockerSearch.
FilterKernel make_pcss_filter(const PcfParams& params, const PcssParams& pcss, double extent);
/// The disk of DPCF for a light of this extent: see ContactHardening.
FilterKernel make_dpcf_filter(const PcfParams& params, const PcssParams& pcss, double extent);

/// Of a grid: the sums of the first 0, 1, … n weights of the kernel.
std::vector<std::uint32_t> running_sums(const std::vector<std::uint32_t>& kernel);

}  // namespace umbrameter
