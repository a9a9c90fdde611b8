// Drawing into textures: the framebuffer, and the fixed-function state of a draw.
#pragma once

#include <string>
#include <vector>

#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// The depth test of a draw. Depth is reversed: 1 at the near plane, 0 far away.
/// `nearer` and `farther` test without writing; `replace` writes without a test.
enum class DepthTest { off, nearer, farther, replace };
enum class DrawnFaces { all, front, back };

struct DrawState {
  DepthTest depth = DepthTest::off;
  DrawnFaces faces = DrawnFaces::all;
  bool adds = false;  ///< additive blending
};

/// A framebuffer of textures of one size, which must outlive it. The destructor binds the default framebuffer.
class Target {
 public:
  Target(const std::string& label, const std::vector<const Texture*>& colors, const Texture* depth);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Sets all colours and the depth to 0.
  void clear() const;
  void clear_colors() const;
  /// Draws that follow write to this layer of an array, the depth of the target.
  void set_layer(const Texture& depth, int layer) const;
  /// Binds the framebuffer and sets the state for the draws that follow.
  void begin(const DrawState& state) const;

 private:
  Framebuffer framebuffer_;
  TextureSize size_;
  int colors_ = 0;
  bool has_depth_ = false;
};

/// Draws triangles whose vertex shader needs no attributes.
void draw_triangles(int vertices);

}  // namespace umbrameter::gl
