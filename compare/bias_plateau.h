// The rule by which every command recommends a constant bias: from the error at many biases to a range of good ones and
// one of them, or to the reason why none can be recommended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compare/bias_curves.h"

namespace umbrameter {

/// How much more error than the least, relative to it, a bias of the plateau may have.
inline constexpr double plateau_tolerance = 0.05;

/// 5 % above `least`, which may be below 0 where it is a cost.
double plateau_limit(double least);

/// Indices of a connected range, both ends included.
struct ConnectedRange {
  std::size_t first = 0;
  std::size_t last = 0;
};
/// The longest run of values around index `inside` of which none is above `limit`; NaN is above every limit.
ConnectedRange connected_range(std::span<const double> values, std::size_t inside, double limit);

/// So many wrong pixels more are chance. Rule of three: where none of N pixels is wrong, a share of 3/N of such pixels
/// may be, with a probability of 5 %; where some are, more.
inline constexpr double chance_pixels = 3.0;

/// Errors up to it are as good as the least.
struct PlateauLimit {
  double error = 0.0;
  bool is_by_pixels = false;  ///< chance_pixels are more than plateau_tolerance
};
/// `pixels` are the counted pixels of errors that are shares of them; 0: the errors are no such shares. `floor` is an
/// error that none is below, if not the least, in its place in the relative limit.
PlateauLimit limit_of_plateau(double least, std::uint64_t pixels, std::optional<double> floor = {});

/// The plateau of an error curve: the connected range of biases around the one of least error (of equals the smallest)
/// whose error is at most 5 % above the least, relative to it, or chance_pixels, whichever is more. The
/// reference is binary, so that the curve is exact and the range needs no interval.
///
/// Recommended is the smallest bias of the plateau whose acne is at most little_acne_share; if none has so little, the
/// bias of least error. The smallest, because a larger bias detaches shadows from their casters, which this view may
/// show on few pixels only.
struct BiasPlateau {
  BiasCell least;
  BiasCell first;  ///< the smallest bias of the range
  BiasCell last;   ///< the largest
  BiasCell recommended;
  bool open_below = false;    ///< the range reaches the smallest bias that was measured: it may go on below
  bool open_above = false;    ///< the same at the largest
  double limit = 0.0;         ///< errors in the range are at most this
  bool is_by_pixels = false;  ///< the limit is that of chance_pixels

  bool has_little_acne() const { return recommended.acne <= little_acne_share; }
};

/// The cells are in strictly ascending order of the constant bias. `floor` is an error that no bias is below, at most
/// the least of the cells; it takes the place of the least error in the limit, so that the recommended bias has at most
/// 5 % more error than any bias, measured or not. `pixels` are the counted pixels of errors that are shares of them; 0:
/// the errors are no such shares. Empty without cells.
std::optional<BiasPlateau> plateau_of(std::span<const BiasCell> cells, std::optional<double> floor = {},
                                      std::uint64_t pixels = 0);

/// With the bias no tap turns from lit to blocked. So acne and false occlusion fall with it, A(b), and peter-panning
/// and leak grow, P(b). Between two measured biases b < c no bias has an error below A(c) + P(b); below the first none
/// has less than A(first), above the last none less than P(last). The least of these bounds and of the measured errors.
double least_possible_error(std::span<const BiasCell> cells);

/// The indices i for which a bias between cells i and i + 1 may have an error below `error`, by the same bound.
std::vector<std::size_t> intervals_below(std::span<const BiasCell> cells, double error);

/// With fewer pixels no bias is recommended: one of them is more than 1 % of them all.
inline constexpr std::uint64_t enough_pixels = 100;

/// What the counted pixels of a light show about its bias.
struct BiasEvidence {
  std::uint64_t pixels = 0;
  std::uint64_t lit = 0;      ///< of them in the reference
  std::uint64_t blocked = 0;  ///< of them in the reference
  bool has_floor = true;
  /// Whether most of the shadows fall on other objects than those that cast them.
  bool is_on_others = true;

  /// Whether the shadows fall on something from which a large bias would detach them.
  bool has_receiver() const { return has_floor || is_on_others; }
};

/// Why no bias can be recommended.
enum class NoBias : int { few_pixels, nothing_lit, nothing_blocked, no_receiver, unbounded };

/// Empty if the plateau's bias can be recommended. It cannot where too few pixels are counted, lit or blocked, and
/// where has_receiver() is false. Nor where the range has no end: it is open above, or open below and its smallest bias
/// is the recommended one.
std::optional<NoBias> reason_against(const BiasPlateau& plateau, const BiasEvidence& evidence);
/// The same for a plateau along an axis that a user gave: a range that reaches its end may end beyond it.
std::optional<NoBias> reason_against_on_axis(const BiasPlateau& plateau, const BiasEvidence& evidence);

}  // namespace umbrameter
