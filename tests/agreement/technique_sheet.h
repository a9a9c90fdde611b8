// One labelled picture of the errors of many techniques on one scene.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace umbrameter {

struct TechniqueCell {
  std::string label;
  Image<float> visibility;
};

/// An SVG of all cells in rows. Light grey is lit in the reference and dark grey blocked; over it stand the errors in
/// the colours of the error maps: blue too dark, red too bright. truth: the reference's visibility, below 0 where
/// nothing is compared.
std::string technique_sheet(const Image<float>& truth, const std::vector<TechniqueCell>& cells);

}  // namespace umbrameter
