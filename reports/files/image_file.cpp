#include "reports/files/image_file.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "compare/metrics/color_space.h"
#include "core/error.h"
#include "reports/files/exr.h"
#include "reports/files/float_formats.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), why);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, std::generic_category().message(EISDIR));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, std::generic_category().message(errno));
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

const Image<float>* channel(const LayeredImage& file, const std::string& name) {
  const auto found = std::find_if(file.channels.begin(), file.channels.end(),
                                  [&](const Channel& candidate) { return candidate.name == name; });
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

ColorImage read_exr_color(const std::filesystem::path& path, const std::string& layer) {
  const LayeredImage file = read_exr(path);
  ColorImage result;
  if (take_layer(file, layer, result)) return result;
  if (const Image<float>* plane = channel(file, layer); plane != nullptr && !layer.empty()) {
    take_layer({{{"Y", *plane}}, {}}, "", result);
    return result;
  }
  std::set<std::string> layers;
  for (const Channel& each : file.channels) layers.insert(layer_of(each.name));
  if (layer.empty() && layers.size() == 1 && take_layer(file, *layers.begin(), result)) return result;
  std::string names;
  for (const Channel& each : file.channels) names += (names.empty() ? "" : ", ") + each.name;
  throw Error(ExitCode::usage, "--layer '" + layer + "'",
              layer.empty() ? path.string() + " has no channels R, G and B, and no single layer"
                            : path.string() + " has no such layer",
              "choose from its channels: " + names);
}

}  // namespace

ColorImage read_color_image(const std::filesystem::path& path, const std::string& layer) {
  const std::string bytes = bytes_of(path);
  const std::string_view view = bytes;
  if (view.starts_with("\x76\x2f\x31\x01")) return read_exr_color(path, layer);
  if (!layer.empty()) {
    throw Error(ExitCode::usage, "--layer '" + layer + "'", path.string() + " is no EXR file", "leave --layer out");
  }
  ColorImage result;
  try {
    if (view.starts_with("\x89PNG")) {
      const Image<glm::u8vec3> codes = from_png(bytes);
      result.is_display = true;
      result.linear = Image<vec3>(codes.width, codes.height);
      for (std::size_t i = 0; i < codes.size(); ++i) {
        for (int c = 0; c < 3; ++c) result.linear[i][c] = static_cast<float>(linear_from_srgb(codes[i][c] / 255.0));
      }
    } else if (view.starts_with("#?")) {
      result.linear = from_radiance(view);
    } else if (view.starts_with("PF") || view.starts_with("Pf")) {
      result.linear = from_pfm(view);
      result.is_scalar = view.starts_with("Pf");
    } else {
      refuse(path, "it is neither EXR, PNG, Radiance HDR nor PFM");
    }
  } catch (const Error& error) {
    if (error.code() == ExitCode::unreadable_input) throw;
    refuse(path, error.what());
  } catch (const std::bad_alloc&) {
    refuse(path, "not enough memory for its size");
  } catch (const std::exception& error) {
    refuse(path, error.what());
  }
  return result;
}

}  // namespace umbrameter
