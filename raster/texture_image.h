// Images to textures and back. Textures have the bottom row first, images the top row: this is where it flips.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "raster/gl/objects.h"

namespace umbrameter {

template <class T>
void flip_rows(std::span<T> pixels, int width, int height) {
  const auto row = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  for (std::size_t y = 0; y < rows / 2; ++y) {
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row));
  }
}

/// All layers of a texture whose texel is a T, top row first.
template <class T>
std::vector<Image<T>> read_layers(const gl::Texture& texture, gl::Format format, int layers) {
  const gl::TextureSize size = gl::size_of(texture);
  const std::size_t count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  std::vector<T> all(count * static_cast<std::size_t>(layers));
  gl::read_texels(texture, format, std::as_writable_bytes(std::span<T>(all)));
  std::vector<Image<T>> images;
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(layers); ++layer) {
    Image<T>& image = images.emplace_back();
    image.width = size.width;
    image.height = size.height;
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(layer * count);
    image.pixels.assign(first, first + static_cast<std::ptrdiff_t>(count));
    flip_rows(std::span<T>(image.pixels), image.width, image.height);
  }
  return images;
}

template <class T>
Image<T> read_image(const gl::Texture& texture, gl::Format format) {
  const gl::TextureSize size = gl::size_of(texture);
  Image<T> image(size.width, size.height);
  gl::read_texels(texture, format, std::as_writable_bytes(std::span<T>(image.pixels)));
  flip_rows(std::span<T>(image.pixels), image.width, image.height);
  return image;
}

template <class T>
gl::Texture upload_image(const std::string& label, gl::Format format, Image<T> image) {
  flip_rows(std::span<T>(image.pixels), image.width, image.height);
  gl::Texture texture = gl::make_texture(label, format, image.width, image.height);
  gl::write_texels(texture, format, image.width, image.height, std::as_bytes(std::span<const T>(image.pixels)));
  return texture;
}

/// Replaces a layer of an array.
template <class T>
void write_layer(const gl::Texture& texture, gl::Format format, int layer, Image<T> image) {
  flip_rows(std::span<T>(image.pixels), image.width, image.height);
  gl::write_layer(texture, format, layer, {image.width, image.height}, std::as_bytes(std::span<const T>(image.pixels)));
}

}  // namespace umbrameter
