// Whether a scene's size is credible in metres, and which unit would make it so. Tells; never changes anything.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/bounds.h"

namespace umbrameter {

/// A unit that the numbers of a file may be in.
struct UnitCandidate {
  std::string_view unit;      ///< "mm", "cm", "in", "ft" or "km"
  double metres = 1.0;        ///< length of the unit
  double longest_side = 0.0;  ///< of the scene's bounds if its numbers are in this unit, metres
};

enum class SizeVerdict { credible, doubtful, implausible };

struct UnitGuess {
  SizeVerdict verdict = SizeVerdict::credible;
  double longest_side = 0.0;              ///< of the bounds, in metres as glTF has it
  std::string reason;                     ///< why not credible, one clause; empty when it is
  std::vector<UnitCandidate> candidates;  ///< the likeliest first; empty when credible, or when no unit helps
};

/// Judges bounds by size alone. A glTF file counts in metres (glTF 2.0, section 3.4), but many were exported in another
/// unit. The rule:
/// - implausible: the longest side is shorter than 0.05 m or longer than 20 km;
/// - doubtful: the scene is higher (Y) than 1000 m and than a quarter of its width. The tallest building has 830 m, and
///   mountains stand on ground that is wider than four times their relief;
/// - credible: all else. A hall of 30 m in centimetres is caught by its height, a chair of 90 cm in inches is not: no
///   size gives it away.
/// Candidates are the units in which neither clause holds, ordered by how near (by ratio) they bring the longest side
/// to 20 m, the size of a building. Empty bounds are credible.
UnitGuess guess_units(const Bounds& bounds);

}  // namespace umbrameter
