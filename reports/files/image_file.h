// Images of any supported format as linear colour. The formats are one table in image_file.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

struct ColorImage {
  Image<vec3> linear;  ///< linear RGB; a single channel in all three
  bool is_display =
      false;               ///< the file stores code values for a display (PNG); otherwise linear values without a limit
  bool is_scalar = false;  ///< one channel
  bool has_other_layers = false;  ///< R, G and B were taken although the EXR file holds further layers
  /// What the file's values mean: "linear", "sRGB", "sRGB, assumed" where it does not say, "gamma 2.2".
  std::string encoding = "linear";
};

/// "EXR, PNG, Radiance HDR or PFM", with that word before the last.
std::string image_format_names(std::string_view word = "or");

struct ImageFormat;

/// A file whose size in pixels is known, and whose pixels are not decoded yet, so that images that do not fit together
/// take no memory.
class ImageFile {
 public:
  /// The format follows from the file's first bytes. Throws Error (unreadable_input) naming the path, also for more
  /// than 16384 x 16384 pixels and for a size that its bytes cannot hold.
  explicit ImageFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// `layer` selects a layer of an EXR file: "truth_ao" for truth_ao.Y or truth_ao.R/G/B, "truth_ao.Y" for that
  /// channel; empty for R, G, B without a layer, or the file's only layer. PNG files are laid over white. Throws as the
  /// constructor does; for a layer that does not exist Error (usage) that lists the layers.
  ColorImage decode(const std::string& layer = {}) const;

 private:
  std::filesystem::path path_;
  std::string bytes_;
  const ImageFormat* format_ = nullptr;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace umbrameter
