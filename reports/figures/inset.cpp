#include "reports/figures/inset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr double max_share = 0.6;  // of the image's width or height, for insets beside or below it
constexpr int max_enlargement = 4;

// Bluish green and orange (Okabe and Ito 2008), black and wine (Tol 2021): none is the colour of a cause, of an end of
// the error scale or of a grey; CIE L* 58, 72, 0 and 26.
constexpr std::array<const char*, 4> colors = {"#009e73", "#e69f00", "#000000", "#882255"};
constexpr std::array<const char*, 4> outline_dashes = {"none", "6 3", "2 2", "8 3 2 3"};  // in widths of the line

// Pixels of the drawing for one of the region's, where the image itself has `scale`.
int scale_of(const Inset& inset, std::size_t count, ivec2 image, int scale, int gap, bool is_below) {
  const int n = static_cast<int>(count);
  const ivec2 all = image * scale;
  const double along =
      is_below ? double(all.x - gap * (n - 1)) / (n * inset.width) : double(all.y - gap * (n - 1)) / (n * inset.height);
  const double across = is_below ? max_share * all.y / inset.height : max_share * all.x / inset.width;
  return static_cast<int>(std::max(0.0, std::min(along, across)));
}

// How much larger than in the image the least enlarged inset is drawn.
double least_ratio(const std::vector<Inset>& insets, ivec2 image, int scale, int gap, bool is_below) {
  double least = 1e9;
  for (const Inset& inset : insets) {
    least = std::min(least, double(scale_of(inset, insets.size(), image, scale, gap, is_below)) / scale);
  }
  return least;
}

std::string outline(ivec2 corner, ivec2 size, double outset, const char* color, double width, const std::string& dash) {
  return fmt::format(
      "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"none\" stroke=\"{}\" "
      "stroke-width=\"{:g}\"{}/>\n",
      corner.x - outset, corner.y - outset, size.x + 2 * outset, size.y + 2 * outset, color, width, dash);
}

std::string connection(ivec2 from, ivec2 to, const char* color, double width, const std::string& dash) {
  return fmt::format("<path d=\"M{},{}L{},{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>\n", from.x, from.y,
                     to.x, to.y, color, width, dash);
}

std::string dash_of(std::size_t index, double stroke) {
  std::string_view pattern = outline_dashes[index % outline_dashes.size()];
  if (pattern == "none") return "";
  std::string lengths;
  for (const char c : pattern) {
    if (c != ' ') lengths += fmt::format("{}{:g}", lengths.empty() ? "" : " ", (c - '0') * stroke);
  }
  return " stroke-dasharray=\"" + lengths + "\"";
}

}  // namespace

InsetLayout place_insets(const std::vector<Inset>& insets, ivec2 image, int image_scale, int gap) {
  InsetLayout layout;
  layout.image_scale = image_scale;
  layout.size = image * image_scale;
  if (insets.empty()) return layout;
  double best = 1.0;
  for (int scale = image_scale; scale <= max_enlargement * image_scale; ++scale) {
    for (const bool is_below : {false, true}) {
      const double ratio = least_ratio(insets, image, scale, gap, is_below);
      if (ratio <= 1.1 * best) continue;  // a larger file has to be worth it
      best = ratio;
      layout.image_scale = scale;
      layout.is_below = is_below;
    }
  }
  if (best == 1.0) {
    const auto largest = std::ranges::max_element(
        insets, [](const Inset& a, const Inset& b) { return a.width * a.height < b.width * b.height; });
    throw Error(ExitCode::partial,
                fmt::format("--inset {},{},{},{}", largest->x, largest->y, largest->width, largest->height),
                fmt::format("there is no room to enlarge {} insets of an image of {}×{} pixels", insets.size(), image.x,
                            image.y),
                "give fewer or smaller ones");
  }
  const ivec2 all = image * layout.image_scale;
  const int along = layout.is_below ? all.x : all.y;
  int used = 0;
  int across = 0;
  for (const Inset& inset : insets) {
    PlacedInset& placed = layout.insets.emplace_back();
    placed.region = inset;
    placed.scale = scale_of(inset, insets.size(), image, layout.image_scale, gap, layout.is_below);
    used += placed.scale * (layout.is_below ? inset.width : inset.height);
    across = std::max(across, placed.scale * (layout.is_below ? inset.height : inset.width));
  }
  // The first begins where the image does, the last ends with it.
  const int gaps = static_cast<int>(insets.size()) - 1;
  const int between = gaps > 0 ? (along - used) / gaps : 0;
  int at = 0;
  for (PlacedInset& placed : layout.insets) {
    placed.corner = layout.is_below ? ivec2(at, all.y + gap) : ivec2(all.x + gap, at);
    at += placed.scale * (layout.is_below ? placed.region.width : placed.region.height) + between;
  }
  layout.size = layout.is_below ? ivec2(all.x, all.y + gap + across) : ivec2(all.x + gap + across, all.y);
  return layout;
}

Image<glm::u8vec3> crop_enlarged(const Image<glm::u8vec3>& image, const Inset& region, int scale) {
  Image<glm::u8vec3> result(region.width * scale, region.height * scale);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) result.at(x, y) = image.at(region.x + x / scale, region.y + y / scale);
  }
  return result;
}

std::string inset_marks(const InsetLayout& layout, ivec2 origin, double stroke) {
  std::string svg;
  for (std::size_t i = 0; i < layout.insets.size(); ++i) {
    const PlacedInset& placed = layout.insets[i];
    const ivec2 region_size = ivec2(placed.region.width, placed.region.height);
    const ivec2 small = region_size * layout.image_scale;
    const ivec2 large = region_size * placed.scale;
    const ivec2 from = origin + ivec2(placed.region.x, placed.region.y) * layout.image_scale;
    const ivec2 to = origin + placed.corner;
    // From the side of the region that faces the inset to the side of the inset that faces the region.
    const ivec2 first_from = layout.is_below ? from + ivec2(0, small.y) : from + ivec2(small.x, 0);
    const ivec2 first_to = to;
    const ivec2 second_from = from + small;
    const ivec2 second_to = layout.is_below ? to + ivec2(large.x, 0) : to + ivec2(0, large.y);
    const char* color = colors[i % colors.size()];
    const std::string dash = dash_of(i, stroke);
    // White below the line keeps it visible on any picture. Lines stand outside of what they frame.
    for (const auto& [ink, width, pattern] :
         {std::tuple{"#ffffff", 2.0 * stroke, std::string()}, {color, stroke, dash}}) {
      svg += connection(first_from, first_to, ink, 0.7 * width, pattern);
      svg += connection(second_from, second_to, ink, 0.7 * width, pattern);
    }
    for (const auto& [ink, width, pattern] :
         {std::tuple{"#ffffff", 2.0 * stroke, std::string()}, {color, stroke, dash}}) {
      svg += outline(from, small, stroke, ink, width, pattern);
      svg += outline(to, large, stroke, ink, width, pattern);
    }
  }
  return svg;
}

}  // namespace umbrameter
