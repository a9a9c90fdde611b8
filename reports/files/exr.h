// Multi-layer float EXR files. Every channel is 32-bit float, ZIP-compressed, lossless.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

struct Channel {
  std::string name;  ///< "truth_ao.Y", "gbuffer_position.X", "R": at most one dot
  Image<float> values;
};

struct LayeredImage {
  std::vector<Channel> channels;                  ///< all of one size
  std::map<std::string, std::string> attributes;  ///< own keys, written as "umbrameter.<key>"
  /// Standard attributes of the view: right-handed world to camera, and world to normalised device coordinates.
  mat4 world_to_camera{1.0f};
  mat4 world_to_ndc{1.0f};
};

/// Appends a scalar image as "<layer>.Y", or a vector image as "<layer>.X/Y/Z".
void add_layer(LayeredImage& image, const std::string& layer, const Image<float>& values);
void add_layer(LayeredImage& image, const std::string& layer, const Image<vec3>& values);
/// A linear colour image as "<layer>.R/G/B".
void add_color_layer(LayeredImage& image, const std::string& layer, const Image<vec3>& colors);

/// Written to a temporary name and renamed. Throws Error naming the path when the disk is full or not writable.
void write_exr(const std::filesystem::path& path, const LayeredImage& image);
/// Width and height by the header of a file's bytes; no pixel is decoded. Throws std::exception that says what is
/// wrong.
ivec2 size_of_exr(std::string_view bytes);
/// Decodes a file's bytes. Throws std::exception that says what is wrong.
LayeredImage from_exr(std::string_view bytes);
/// Throws Error (unreadable_input) naming the path.
LayeredImage read_exr(const std::filesystem::path& path);

}  // namespace umbrameter
