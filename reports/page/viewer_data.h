// What the page's image viewer shows: the layers of a run or of some cells of a sweep, the images of causes at every
// bias, names of objects and materials. The page holds them as JSON, of very large images only every second pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
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
  double reach = 1.0;  ///< of an error: the end of its scale; of a standard error: what makes it a 95 % half width
  std::string unit{};
  std::vector<CategoryColor> categories{};
  std::vector<Image<float>> planes{};  ///< one; of colours and vectors three
};

/// One light's error at every constant bias of an axis, and the pixels that are wrong at each of them.
struct ViewerBias {
  std::string group;                          ///< that of the light's layers
  std::string missing;                        ///< why the images cannot follow the bias; empty if they can
  std::string unit = "m";                     ///< of the axis: "m", "texels" or "depth"
  double unit_length = 1.0;                   ///< of one such unit, mean over the counted pixels [m]
  double mean_texel = 0.0;                    ///< [m]
  bool texels_differ = false;                 ///< from pixel to pixel: texels are metres only on average
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

/// The cell of a sweep that a set of images shows.
struct ViewerCell {
  std::size_t number = 0;   ///< its row in sweep.csv
  std::string reason;       ///< why it was chosen: "least error"
  std::string bias_axis{};  ///< the column whose every value the bias slider shows; empty if none
};

/// The images of a run or of one cell.
struct ViewerData {
  int width = 0;
  int height = 0;
  bool full = false;     ///< every pixel, however large the images are
  bool rounded = false;  ///< fewer digits, and no error that is the difference of technique and reference
  std::vector<ViewerLayer> layers;
  std::vector<ViewerBias> biases{};
  ViewerParts objects{};
  ViewerParts materials{};
  std::optional<ViewerCell> cell{};
  std::string title{};  ///< of a set that is no cell: "best"; empty where the page has one set
};

/// Sets of images as the page holds them: JSON. What several sets share is held once.
struct ViewerPack {
  std::string title = "Images";
  std::vector<std::string> sets{};   ///< the first is shown when the page opens
  std::set<std::string> layers{};    ///< their names
  std::vector<std::string> items{};  ///< planes and names, to which the sets refer by index
};

/// Packs a set, so that its images need not stay in memory. Planes are deflated and in base64.
void add_set(ViewerPack& pack, const ViewerData& data);

/// What the page's script reads (viewer/data.ts), as it may stand in a <script> element.
std::string viewer_text(const ViewerPack& pack);

}  // namespace umbrameter
