// Finds recommended biases in the rows of a sweep: the bias with the least error, the least bias without acne, and the
// Pareto front of acne against peter-panning with its knee. Takes rows one by one in any order and keeps only its
// results; reads no files.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace umbrameter {

/// The error at one combination of biases, all else equal. Shares of the counted pixels, 0 to 1.
struct BiasCell {
  double constant = 0.0;  ///< metres
  double slope = 0.0;     ///< texels
  double mae = 0.0;
  double acne = 0.0;
  double false_occlusion = 0.0;
  double peter_panning = 0.0;
  double leak = 0.0;
};

/// The largest share of the counted pixels that counts as little acne.
inline constexpr double little_acne_share = 0.001;

/// Recommended constant biases at one slope-scaled bias.
struct BiasLine {
  double slope = 0.0;                           ///< texels
  std::optional<BiasCell> least_error{};        ///< least error; among equals the least constant bias
  std::optional<BiasCell> acne_free{};          ///< least constant bias without acne
  std::optional<BiasCell> best_without_acne{};  ///< least error among the cells without acne
  std::optional<BiasCell> little_acne{};        ///< least constant bias with acne of at most little_acne_share
};

/// Adds a cell with the line's slope-scaled bias. The order of cells does not matter.
void add(BiasLine& line, const BiasCell& cell);

/// The cells that no other cell beats: every cell with less acne has more peter-panning, and the reverse. Among cells
/// with equal acne and peter-panning, keeps the one with the least constant bias, then the least slope-scaled bias.
struct ParetoFront {
  /// If a front exceeds this size, every second cell between its ends is dropped.
  static constexpr std::size_t max_cells = 4096;
  std::map<double, BiasCell> by_acne{};
  bool thinned = false;
};
void add(ParetoFront& front, const BiasCell& cell);

/// The cell farthest below the chord between the front's ends, with both axes scaled to the front's extent. There, less
/// of one quantity begins to cost more of the other. Empty if the front has fewer than three cells or no cell below the
/// chord. Satopää et al., Finding a "Kneedle" in a Haystack, ICDCS Workshops 2011, section III.
std::optional<BiasCell> knee(const ParetoFront& front);

/// Results over all biases at one combination of the other parameters.
struct BiasOptima {
  double mean_texel = 0.0;  ///< metres
  std::vector<BiasLine> lines{};
  ParetoFront front{};
};

/// The cell with the least error in all lines; among equals the least constant bias, then the least slope-scaled bias.
/// Empty if there are no lines.
std::optional<BiasCell> least_error(const BiasOptima& optima);

/// The cell with the least error among those without acne, in all lines.
std::optional<BiasCell> best_without_acne(const BiasOptima& optima);

/// The line whose slope-scaled bias is nearest to 0. There must be at least one line.
const BiasLine& flattest(const BiasOptima& optima);

}  // namespace umbrameter
