// The map of LDR-FLIP: the difference that a viewer notices when two images alternate on a display.
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for Alternating
// Images, Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020; below "the paper".
#pragma once

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// Error of each pixel, 0 to 1. Both images are linear RGB of one size; values are clamped to 0 to 1.
Image<float> flip_map(const Image<vec3>& test, const Image<vec3>& reference, double pixels_per_degree);

}  // namespace umbrameter
