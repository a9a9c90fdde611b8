// A rectangular array of values of one type. Row 0 is the top row; values are linear.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace umbrameter {

template <class T>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<T> pixels;  ///< row by row from the top, width · height values

  Image() = default;
  Image(int image_width, int image_height, const T& fill = T{})
      : width(image_width),
        height(image_height),
        pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height), fill) {}

  bool empty() const { return pixels.empty(); }
  std::size_t size() const { return pixels.size(); }

  std::size_t index(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  T& at(int x, int y) { return pixels[index(x, y)]; }
  const T& at(int x, int y) const { return pixels[index(x, y)]; }

  T& operator[](std::size_t i) { return pixels[i]; }
  const T& operator[](std::size_t i) const { return pixels[i]; }

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace umbrameter
