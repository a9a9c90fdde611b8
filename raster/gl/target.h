// Draws into textures: which ones, and the fixed-function state of the draw.
#pragma once

#include <string>
#include <vector>

#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// Depth is reversed: 1 at the near plane, 0 far away.
/// `nearer` and `farther` test without writing; `replace` writes without a test.
enum class DepthTest { off, nearer, farther, replace };
enum class DrawnFaces { all, front, back };

struct DrawState {
  DepthTest depth = DepthTest::off;
  DrawnFaces faces = DrawnFaces::all;
  bool adds = false;  ///< adds to the colours that are there
};

/// A framebuffer of textures of one size. They must outlive it.
class Target {
 public:
  Target(const std::string& label, const std::vector<const Texture*>& colors, const Texture* depth);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Sets all colours and the depth to 0.
  void clear() const;
  void clear_colors() const;
  /// Binds it and sets the state, for draws until the next begin().
  void begin(const DrawState& state) const;

 private:
  Framebuffer framebuffer_;
  TextureSize size_;
  int colors_ = 0;
  bool has_depth_ = false;
};

/// Draws triangles whose vertex shader needs no attributes.
void draw_triangles(int vertices);

/// Makes what was drawn visible to textures, images and buffers.
void finish_draws();

}  // namespace umbrameter::gl
