// What the page's image viewer shows: the layers of a run, the images of causes at every bias, names of objects and
// materials. The page holds them as JSON, of large images only every second pixel.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/image.h"
#include "reports/figures/figures.h"

namespace umbrameter {

/// How the viewer colours a layer.
enum class ViewerKind {
  share,     ///< 0 to 1, sequential
  error,     ///< signed, diverging about 0
  number,    ///< any range, sequential
  category,  ///< an index into `categories`
  color,     ///< linear R, G, B
  vector,    ///< X, Y, Z
};

/// What a layer is within its group. The viewer compares the reference with the technique; the bias slider redraws
/// technique, error and cause.
enum class ViewerRole { reference, technique, error, cause, other };

struct ViewerLayer {
  std::string name;     ///< as in images.exr: "truth_visibility_sun"
  std::string title;    ///< "Reference"
  std::string group{};  ///< "sun", "ambient occlusion"
  ViewerRole role = ViewerRole::other;
  ViewerKind kind = ViewerKind::number;
  double reach = 1.0;  ///< of an error: the end of its scale
  std::string unit{};
  std::vector<CategoryColor> categories{};
  std::vector<Image<float>> planes{};  ///< one; of colours and vectors three
};

/// One light's error at every constant bias of an axis, and the pixels that are wrong at each of them.
struct ViewerBias {
  std::string group;    ///< that of the light's layers
  std::string missing;  ///< why the images cannot follow the bias; empty if they can
  std::string unit;     ///< of the axis: "m" or "texels"
  double mean_texel = 0.0;
  double used = 0.0;                          ///< the bias of this run, a value of the axis
  std::vector<double> axis;                   ///< ascending
  std::vector<std::array<double, 4>> shares;  ///< at each bias the shares of acne, false occlusion, peter-panning, leak
  /// 0, or 1 + the index of the bias from which on the pixel is lit; and the category of its error. Empty if missing.
  Image<std::uint16_t> bin;
  Image<std::uint8_t> cause;
};

/// Which object or material each pixel shows.
struct ViewerParts {
  Image<std::uint16_t> index;  ///< 0 is the background, otherwise 1 + an index into `names`
  std::vector<std::string> names;
};

struct ViewerData {
  std::string title = "Images";
  std::size_t section = 0;  ///< the viewer stands before this section of the page
  int width = 0;
  int height = 0;
  bool full = false;  ///< every pixel, however large the images are
  std::vector<ViewerLayer> layers;
  std::vector<ViewerBias> biases{};
  ViewerParts objects{};
  ViewerParts materials{};
};

/// The JSON that the viewer reads (viewer/data.ts). Planes are deflated and in base64.
nlohmann::ordered_json viewer_json(const ViewerData& data);

}  // namespace umbrameter
