// Images of any supported format as linear colour: EXR, PNG, Radiance HDR, PFM.
#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

struct ColorImage {
  Image<vec3> linear;       ///< linear RGB; a single channel in all three
  bool is_display = false;  ///< the file stores sRGB code values (PNG); otherwise linear values without a limit
  bool is_scalar = false;   ///< one channel
};

/// The format follows from the file's first bytes. `layer` selects a layer of an EXR file: "truth_ao" for truth_ao.Y or
/// truth_ao.R/G/B, "truth_ao.Y" for that channel; empty for R, G, B without a layer, or the file's only layer.
/// PNG files are read to 8 bits a channel and laid over white. Throws Error (unreadable_input) naming the path; for a
/// layer that does not exist Error (usage) that lists the layers.
ColorImage read_color_image(const std::filesystem::path& path, const std::string& layer = {});

}  // namespace umbrameter
