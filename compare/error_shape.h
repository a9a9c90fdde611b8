// The shape of a light's shadow error: its distance from the shadow edges, and its connected regions. This
// distinguishes jagged edges from areas of acne, which a mean does not.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "compare/components.h"
#include "compare/shadow_edges.h"
#include "compare/visibility.h"

namespace umbrameter {

/// Weighted quantiles.
struct Spread {
  double median = 0.0;
  double upper = 0.0;  ///< 95 % of the weight is at most this
  double largest = 0.0;
};

/// Distances at which EdgeDistances::within gives the share of the error, texels.
inline constexpr std::array<double, 10> edge_reaches = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};
inline constexpr std::size_t one_texel = 2;   ///< index of 1 texel in edge_reaches
inline constexpr std::size_t two_texels = 3;  ///< index of 2 texels in edge_reaches
inline constexpr double edge_band_texels = edge_reaches[two_texels];
inline constexpr double edge_band_px = 0.5;  ///< from the middle of an edge to the centres of its two pixels

/// How far a part of the error lies from the shadow edges.
struct EdgeDistances {
  double weight = 0.0;  ///< of the part, pixels
  // All three distances are empty if there is no error or no edge.
  std::optional<Spread> pixels;
  /// Perpendicular to the light's direction, in map texels at the edge: the size of the map's stair steps.
  std::optional<Spread> texels;
  std::optional<Spread> metres;  ///< in the world
  /// Share of the part's weight within each distance of edge_reaches.
  std::array<double, edge_reaches.size()> within{};
  /// Share of the part's weight at an edge: at most edge_band_texels from it, or in a pixel beside it, whose distance
  /// is half a pixel at least however far that is in texels. 0 if there is no edge.
  double at_edge = 0.0;
};

/// Names of the parts of a soft shadow's error, by sign. The parts of a hard shadow's error have cause_names.
inline constexpr std::array<std::string_view, 2> soft_part_names = {"too_dark", "too_bright"};

struct ErrorShape {
  std::uint64_t edges = 0;  ///< pairs of neighbouring pixels of which only one is lit in the hard shadow
  EdgeDistances all;
  std::vector<EdgeDistances> parts;  ///< in the order of the part names
  /// Components of all wrong pixels, and of each class. Only for a hard shadow, whose pixels are either right or wrong.
  std::optional<ComponentStatistics> components;
  std::array<ComponentStatistics, cause_count> class_components{};
  /// Only for an area light: share of the error that is not penumbra_error(), the error outside the penumbra.
  std::optional<double> outside_penumbra;
};

/// Input of analyze_error_shape(); all images have the same size.
struct ShapeInput {
  const GBuffer& gbuffer;
  const Image<float>& truth;  ///< 1 lit, 0 blocked; in between if it is sampled
  const CountedPixels& counted;
  const Light& light;
  const MapLayout& layout;
  /// Unbiased estimate of the variance of `truth`; null or empty if it is exact.
  const Image<float>* truth_variance = nullptr;
  /// The hard shadow, 1 or 0, whose edges are the shadow edges; null if `truth` is that. Edges of a sampled truth would
  /// depend on the number of rays.
  const Image<float>* hard_truth = nullptr;
};

/// The shape by cause of the wrong taps. Distances are to the edge that is nearest in the image.
ErrorShape analyze_error_shape(const ShapeInput& input, const WrongTaps& wrong);

/// The shape by sign of raster − truth, for a technique without taps or a fractional reference.
ErrorShape analyze_error_shape(const ShapeInput& input, const Image<float>& raster);

}  // namespace umbrameter
