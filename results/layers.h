// The layers of images.exr.
#pragma once

#include "reports/files/exr.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// Layer names:
/// - for each light truth_visibility_<light>.Y, raster_visibility_<light>.Y, error_visibility_<light>.Y; of a hard
/// shadow
///   with taps also class_<light>.Y (numbers of PixelClass), of others counted_<light>.Y (1 where the pixel counts);
///   with extent also truth_visibility_standard_error_<light>.Y, truth_visibility_variance_<light>.Y (unbiased, for
///   sums over many pixels) and truth_visibility_samples_<light>.Y;
/// - truth_ao.Y, truth_ao_standard_error.Y, truth_ao_variance.Y, truth_ao_samples.Y (rays), raster_ao.Y, error_ao.Y;
/// - with truth.ao-layers also truth_bent_normal.X/Y/Z (unit, world) and truth_ao_hit_distance.Y (metres, infinite if
///   no ray hits);
/// - of an image measurement truth_image.R/G/B and raster_image.R/G/B (linear, without exposure),
///   truth_image_standard_error.Y and error_image.Y (luminance × exposure), cause_image.Y (index into
///   image_cause_names; 4: no visible error), raster_light_buffer.R/G/B and, G-buffer − exact, gbuffer_change_image.Y,
///   gbuffer_change_ao.Y and gbuffer_change_visibility_<light>.Y (deferred path);
/// - gbuffer_position.X/Y/Z (world, metres; NaN on background), gbuffer_normal.X/Y/Z (geometric, world);
/// - in the root layer R, G, B, A (the picture) and Z (metres along the camera's axis).
LayeredImage layers_of(const SceneFacts& scene, const Measurement& measurement);

}  // namespace umbrameter
