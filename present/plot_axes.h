// How the axes of a sweep become those of its figures: labels with units, and as many values as a reader can tell
// apart.
#pragma once

#include <string>
#include <vector>

#include "experiments/settings/sweep.h"

namespace umbrameter {

/// "shadow.constant-bias" in metres is "constant bias [m]".
std::string label_of(const SweepAxis& axis);

/// Whether a figure shows the axis on a logarithmic scale: the range was given so, or its positive values are a
/// resolution or in equal ratios.
bool is_logarithmic(const SweepAxis& axis);

/// As many significant digits as tell the value from its neighbours on the axis, ascending, and no fewer than 3. What
/// is derived from a value of the axis has no more.
int digits_of_step(const std::vector<double>& axis, double value);

/// Those, or as many as the value itself was given with, up to 6: 0.05625 has 4.
int digits_on_axis(const std::vector<double>& axis, double value);

/// Every so many of `count` indices, the last one too.
struct Thinned {
  std::vector<std::size_t> indices;
  std::size_t step = 1;
};
Thinned thin(std::size_t count, std::size_t most);

/// What a caption says of it; empty where nothing was left out.
std::string thinning_text(const Thinned& thinned, const std::string& key);

}  // namespace umbrameter
