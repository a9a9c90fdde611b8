// images.exr: which layer holds what.
#pragma once

#include "experiments/measure.h"
#include "reports/files/exr.h"

namespace umbrameter {

/// The picture that goes with a measurement: raster's answers where there are any, the truth's otherwise.
/// Linear, 1 is about white.
Image<vec3> picture_of(const Stages& stages, const Measurement& measurement);

/// Layer names: truth_visibility_<light>.Y, raster_visibility_<light>.Y, error_visibility_<light>.Y; of a light without
/// extent class_<light>.Y (numbers of PixelClass), of one with truth_visibility_standard_error_<light>.Y; truth_ao.Y,
/// truth_ao_standard_error.Y, truth_ao_samples.Y (rays), raster_ao.Y, error_ao.Y, where truth.ao-layers asks for them
/// truth_bent_normal.X/Y/Z (unit, world) and truth_ao_hit_distance.Y (metres, infinite where no ray hits),
/// gbuffer_position.X/Y/Z (world, metres; NaN on background), gbuffer_normal.X/Y/Z (geometric, world), root R G B A and
/// Z (metres along the camera's axis).
LayeredImage layers_of(const Stages& stages, const Measurement& measurement);

}  // namespace umbrameter
