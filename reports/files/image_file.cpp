#include "reports/files/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/metrics/color_space.h"
#include "core/error.h"
#include "core/input_file.h"
#include "core/lists.h"
#include "reports/files/exr.h"
#include "reports/files/float_formats.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), why);
}

std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

const Image<float>* channel(const LayeredImage& file, const std::string& name) {
  const auto found = std::ranges::find(file.channels, name, &Channel::name);
  return found == file.channels.end() ? nullptr : &found->values;
}

// A layer's colour, vector or lone channel; nothing where it has another set of channels.
bool take_layer(const LayeredImage& file, const std::string& layer, ColorImage& result) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  for (const std::string_view names : {"RGB", "XYZ", "YYY"}) {
    const Image<float>* planes[3] = {};
    for (std::size_t c = 0; c < 3; ++c) planes[c] = channel(file, prefix + names[c]);
    if (planes[0] == nullptr || planes[1] == nullptr || planes[2] == nullptr) continue;
    result.is_scalar = names == "YYY";
    result.linear = Image<vec3>(planes[0]->width, planes[0]->height);
    for (std::size_t i = 0; i < result.linear.size(); ++i) {
      result.linear[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
    }
    return true;
  }
  return false;
}

ColorImage read_exr_color(std::string_view bytes, const std::filesystem::path& path, const std::string& layer) {
  const LayeredImage file = from_exr(bytes);
  ColorImage result;
  if (take_layer(file, layer, result)) {
    result.has_other_layers = layer.empty() && std::ranges::any_of(file.channels, [](const Channel& each) {
                                return !layer_of(each.name).empty();
                              });
    return result;
  }
  if (const Image<float>* plane = channel(file, layer); plane != nullptr && !layer.empty()) {
    take_layer({{{"Y", *plane}}, {}}, "", result);
    return result;
  }
  std::set<std::string> layers;
  for (const Channel& each : file.channels) layers.insert(layer_of(each.name));
  if (layer.empty() && layers.size() == 1 && take_layer(file, *layers.begin(), result)) return result;
  throw Error(ExitCode::usage, path.string(),
              layer.empty() ? "no channels R, G and B, and more than one layer" : "no layer '" + layer + "'",
              "choose from its channels: " + joined(file.channels, ", ", &Channel::name));
}

// Light of each 16-bit code value, by the file's own curve. A gamma within 5 % of 1/2.2 means the curve of sRGB, as it
// does for libpng: such files are older than the sRGB chunk.
std::vector<float> light_of_codes(const PngHeader& header, std::string& encoding) {
  constexpr double gamma_of_srgb = 1.0 / 2.2;
  const bool is_srgb = header.gamma <= 0.0 || std::abs(header.gamma / gamma_of_srgb - 1.0) < 0.05;
  encoding = !is_srgb                                  ? fmt::format("gamma {:.3g}", 1.0 / header.gamma)
             : header.names_srgb || header.gamma > 0.0 ? "sRGB"
                                                       : "sRGB, assumed";
  std::vector<float> light(65536);
  for (std::size_t code = 0; code < light.size(); ++code) {
    const double value = static_cast<double>(code) / 65535.0;
    light[code] = static_cast<float>(is_srgb ? linear_from_srgb(value) : std::pow(value, 1.0 / header.gamma));
  }
  return light;
}

ColorImage read_png_color(std::string_view bytes) {
  ColorImage result;
  result.is_display = true;
  const std::vector<float> light = light_of_codes(png_header(bytes), result.encoding);
  const Image<glm::u16vec4> codes = from_png(bytes);
  result.linear = Image<vec3>(codes.width, codes.height);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const float alpha = static_cast<float>(codes[i].a) / 65535.0f;
    for (int c = 0; c < 3; ++c) result.linear[i][c] = alpha * light[codes[i][c]] + (1.0f - alpha);
  }
  return result;
}

// Calls action(), and names the file in what it throws.
template <class Action>
auto naming(const std::filesystem::path& path, const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    if (error.code() == ExitCode::unreadable_input || error.code() == ExitCode::usage) throw;
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, "not enough memory for its size");
  } catch (const std::exception& error) {
    refuse(path, error.what());
  }
}

ColorImage read_pfm_color(std::string_view bytes) {
  ColorImage result;
  result.linear = from_pfm(bytes);
  result.is_scalar = bytes.starts_with("Pf");
  return result;
}

ivec2 size_of_png(std::string_view bytes) {
  const PngHeader header = png_header(bytes);
  return {header.width, header.height};
}

}  // namespace

struct ImageFormat {
  std::string_view name;
  std::vector<std::string_view> first_bytes;  // one of these
  ivec2 (*size_of)(std::string_view bytes) = nullptr;
  ColorImage (*decode)(std::string_view bytes) = nullptr;  // null: EXR, which has layers
};

namespace {

const std::vector<ImageFormat>& image_formats() {
  static const std::vector<ImageFormat> all = {
      {"EXR", {"\x76\x2f\x31\x01"}, size_of_exr},
      {"PNG", {"\x89PNG"}, size_of_png, read_png_color},
      {"Radiance HDR",
       {"#?"},
       size_of_radiance,
       [](std::string_view bytes) { return ColorImage{from_radiance(bytes)}; }},
      {"PFM", {"PF", "Pf"}, size_of_pfm, read_pfm_color},
  };
  return all;
}

}  // namespace

std::string image_format_names(std::string_view word) {
  std::string names;
  for (const ImageFormat& each : image_formats()) {
    const bool is_last = &each == &image_formats().back();
    names += (names.empty() ? "" : is_last ? fmt::format(" {} ", word) : ", ") + std::string(each.name);
  }
  return names;
}

ImageFile::ImageFile(std::filesystem::path path) : path_(std::move(path)), bytes_(read_input(path_)) {
  const std::string_view view = bytes_;
  const auto found = std::ranges::find_if(image_formats(), [&](const ImageFormat& each) {
    return std::ranges::any_of(each.first_bytes, [&](std::string_view first) { return view.starts_with(first); });
  });
  if (found == image_formats().end()) refuse(path_, "it is neither " + image_format_names("nor"));
  format_ = &*found;
  const ivec2 size = naming(path_, [&] { return format_->size_of(view); });
  constexpr std::int64_t most_pixels = std::int64_t{16384} * 16384;  // of the largest --size
  if (std::int64_t{size.x} * size.y > most_pixels) {
    refuse(path_, fmt::format("its size is {}x{}, more than 16384x16384 pixels", size.x, size.y));
  }
  width_ = size.x;
  height_ = size.y;
}

ColorImage ImageFile::decode(const std::string& layer) const {
  if (format_->decode == nullptr) return naming(path_, [&] { return read_exr_color(bytes_, path_, layer); });
  if (!layer.empty()) {
    throw Error(ExitCode::usage, path_.string(), "only EXR files have layers", "leave out the layer '" + layer + "'");
  }
  return naming(path_, [&] { return format_->decode(bytes_); });
}

}  // namespace umbrameter
