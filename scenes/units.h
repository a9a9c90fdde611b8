// Whether a scene's size is credible in metres, and which unit would make it so. It only judges; scene.unit scales.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace umbrameter {

/// A unit that the numbers of a file may be in.
struct UnitCandidate {
  std::string_view unit;      ///< as --scene.unit takes it: "mm", "cm", "m", "km", "inch" or "foot"
  double metres = 1.0;        ///< length of the unit
  double longest_side = 0.0;  ///< of the scene's bounds if its numbers are in this unit, metres
};

enum class SizeVerdict { credible, doubtful, implausible };

struct UnitGuess {
  SizeVerdict verdict = SizeVerdict::credible;
  double longest_side = 0.0;              ///< of the bounds, metres
  double metres = 1.0;                    ///< of the unit that they were read with
  std::string reason;                     ///< why not credible, one clause; empty when it is
  std::vector<UnitCandidate> candidates;  ///< the likeliest first; empty when credible, or when no unit helps
  double power_of_ten = 1.0;              ///< length of a unit, metres, that would bring the longest side near 20 m
};

/// Judges bounds by size alone; they are in metres, read with a unit of `metres`. A glTF file counts in metres
/// (glTF 2.0, section 3.4), but many were exported in another unit. Scenes for shadows are rooms, buildings, streets
/// and their surroundings; what is credible is what these can be:
/// - implausible: the longest side is shorter than 1 cm or longer than 20 km;
/// - doubtful, small: shorter than 0.5 m, smaller than furniture. A toy or a fruit in metres is right and gets the
///   remark as well: every length that is given in metres is then likely to be wrong for it;
/// - doubtful, large: longer than 5 km. The texels of a map of 1024 are then 5 m wide, as large as rooms;
/// - doubtful, high: higher (Y) than 200 m, which fewer than 3000 buildings are (Council on Tall Buildings and Urban
/// Habitat), and than
///   a tenth of its longest horizontal side, which hills seldom are;
/// - doubtful, slender: higher than 50 m and than the square root of its footprint's area, as towers are, and animals,
///   people and furniture in centimetres;
/// - doubtful, a thing: longer than 100 m, and not `is_surrounding`: what is seen from outside is a thing, and those
/// that one models are shorter (the longest aircraft, the An-225, had 84 m). A ship or a bridge in metres is right and
/// gets the remark as well;
/// - credible: all else. A chair of 90 cm in inches is among it: no size gives it away.
/// Candidates are the units in which none of this holds; of a thing millimetres and centimetres as well where they make
/// it longer than 1 cm. The usual metric ones come first, then by how near (by ratio) they bring the longest side to
/// 20 m, the size of a building. Empty bounds are credible.
UnitGuess guess_units(const Bounds& bounds, double metres = 1.0, bool is_surrounding = true);

/// Whether a camera or a lamp of the scene stands within its bounds, as in rooms, streets and land: the one thing in a
/// glTF file, besides its size, that tells these from single things.
bool is_surrounding(const Scene& scene);

/// One line that says how long the scene is, why that is doubtful and what to set; empty where it is credible.
std::string size_remark(const UnitGuess& guess);

}  // namespace umbrameter
