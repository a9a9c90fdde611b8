// Draws SVG: as pixels, and as a page of PDF. It reads neither files nor the network, and any thread may use it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "reports/files/png.h"

namespace umbrameter {

/// An image below a drawing, in units of its viewBox.
struct ImageBelow {
  const DeflatedImage* image = nullptr;
  ivec2 corner{0, 0};  ///< top left
  ivec2 size{0, 0};    ///< as shown
};

class SvgDrawing {
 public:
  /// Throws Error (partial) when the text is no SVG or does not say how large it is.
  explicit SvgDrawing(const std::string& svg);

  /// Draws it over the image, whose sides it fills. Throws Error (partial) for more than 32767 pixels along a side.
  void draw_over(Image<glm::u8vec3>& image) const;

  /// The drawing on white, with `zoom` pixels for each of its pixels; 96 of these are an inch. Throws as draw_over()
  /// does.
  Image<glm::u8vec3> pixels(double zoom) const;

  /// A white page of its size with the images, and the drawing over them. Equal drawings give equal bytes.
  std::string to_pdf(const std::vector<ImageBelow>& images = {}) const;

 private:
  struct Handle;
  std::shared_ptr<Handle> handle_;
};

/// Whether any font is installed. Without one, letters are drawn as boxes, whose widths are left to chance.
bool has_fonts();

}  // namespace umbrameter
