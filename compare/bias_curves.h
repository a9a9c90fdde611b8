// What the rows of a sweep say about the bias: the bias of least error, those without acne, the front of acne against
// peter-panning with its knee. Takes rows one by one in any order and keeps no more than it tells; reads no files.
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

/// Acne that is called nearly none: a share of the counted pixels.
inline constexpr double little_acne_share = 0.001;

/// The constant biases at one slope-scaled bias.
struct BiasLine {
  double slope = 0.0;                           ///< texels
  std::optional<BiasCell> least_error{};        ///< of equals the one of least constant bias
  std::optional<BiasCell> acne_free{};          ///< the least constant bias without a wrong tap of that cause
  std::optional<BiasCell> best_without_acne{};  ///< of those without acne the one of least error
  std::optional<BiasCell> little_acne{};        ///< the least constant bias with acne of at most little_acne_share
};

/// Takes cells of the line's slope-scaled bias in any order.
void add(BiasLine& line, const BiasCell& cell);

/// The cells that no other one beats: none has less of acne or peter-panning without having more of the other. Of
/// cells with both equal the one of least constant bias, then of least slope-scaled bias, stands for all.
struct ParetoFront {
  /// A front that grows beyond loses every second cell between its ends.
  static constexpr std::size_t max_cells = 4096;
  std::map<double, BiasCell> by_acne{};
  bool thinned = false;
};
void add(ParetoFront& front, const BiasCell& cell);

/// The cell farthest below the chord between the front's ends, both axes scaled to the front's extent: where less of
/// one begins to cost more of the other. Nothing for a front of less than three cells or without a cell below the
/// chord. Satopää et al., Finding a "Kneedle" in a Haystack, ICDCS Workshops 2011, section III.
std::optional<BiasCell> knee(const ParetoFront& front);

/// All biases at one combination of the other parameters.
struct BiasReading {
  double mean_texel = 0.0;  ///< metres
  std::vector<BiasLine> lines{};
  ParetoFront front{};
};

/// Over all lines; of equals the one of least constant bias, then of least slope-scaled bias. Nothing without lines.
std::optional<BiasCell> least_error(const BiasReading& reading);

/// The cell without acne that has the least error.
std::optional<BiasCell> best_without_acne(const BiasReading& reading);

/// The line whose slope-scaled bias is nearest to none. At least one line must be there.
const BiasLine& flattest(const BiasReading& reading);

}  // namespace umbrameter
