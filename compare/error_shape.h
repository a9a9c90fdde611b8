// The shape of a light's shadow error: how far from the reference's edges it lies, and in how many pieces. Tells
// jagged edges from fields of acne, which a mean cannot.
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

/// Quantiles by weight.
struct Spread {
  double median = 0.0;
  double upper = 0.0;  ///< 95 % of the weight is at most this
  double largest = 0.0;
};

/// Distances at which the share of the error is told, texels.
inline constexpr std::array<double, 10> edge_reaches = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};
inline constexpr std::size_t one_texel = 2;   ///< its place in edge_reaches
inline constexpr std::size_t two_texels = 3;  ///< its place in edge_reaches

/// How far a part of the error lies from the reference's edges.
struct EdgeDistances {
  double weight = 0.0;  ///< of the part, pixels
  std::optional<Spread> pixels;
  /// Across the light's way, in texels of the map at the edge: what the map's own steps are measured in.
  std::optional<Spread> texels;
  std::optional<Spread> metres;  ///< in the world. All three empty without error or without an edge
  /// Of the part's weight the share within edge_reaches.
  std::array<double, edge_reaches.size()> within{};
};

/// Names of a soft shadow's parts, in order: the signs of its error. A hard one's are cause_names.
inline constexpr std::array<std::string_view, 2> soft_part_names = {"too_dark", "too_bright"};

struct ErrorShape {
  std::uint64_t edges = 0;  ///< pairs of neighbouring pixels between which the reference changes
  EdgeDistances all;
  std::vector<EdgeDistances> parts;  ///< in the order of the part names
  /// Wrong pixels and those of each class; of a hard shadow alone, whose pixels are right or wrong.
  std::optional<ComponentStatistics> components;
  std::array<ComponentStatistics, cause_count> class_components{};
  /// Of an area light: share of its error where the truth is 0 or 1.
  std::optional<double> outside_penumbra;
};

/// What the shape is measured on; images of one size.
struct ShapeInput {
  const GBuffer& gbuffer;
  const Image<float>& truth;  ///< 1 lit, 0 blocked; lit from ½ on
  const CountedPixels& counted;
  const Light& light;
  const MapLayout& frame;
};

/// By the causes of the wrong taps. Distances are to the edge that is nearest in the image.
ErrorShape analyze_error_shape(const ShapeInput& input, const WrongTaps& wrong);

/// By the sign of raster − truth, for a reference that is a share: its edge is where it passes ½.
ErrorShape analyze_error_shape(const ShapeInput& input, const Image<float>& raster);

}  // namespace umbrameter
