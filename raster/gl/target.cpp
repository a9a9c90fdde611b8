#include "raster/gl/target.h"

#include "raster/gl/api.h"

namespace umbrameter::gl {

Target::Target(const std::string& label, const std::vector<const Texture*>& colors, const Texture* depth)
    : framebuffer_(make_framebuffer(label)),
      size_(size_of(depth != nullptr ? *depth : *colors.front())),
      colors_(static_cast<int>(colors.size())),
      has_depth_(depth != nullptr) {
  std::vector<GLenum> buffers;
  for (const Texture* color : colors) {
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    glNamedFramebufferTexture(framebuffer_.name(), buffers.back(), color->name(), 0);
  }
  if (has_depth_) glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth->name(), 0);
  glNamedFramebufferDrawBuffers(framebuffer_.name(), colors_, buffers.data());
}

Target::~Target() { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

void Target::clear() const {
  clear_colors();
  const GLfloat far_away[] = {0};
  glDepthMask(GL_TRUE);
  if (has_depth_) glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, far_away);
}

void Target::clear_colors() const {
  const GLfloat zero[] = {0, 0, 0, 0};
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  for (int i = 0; i < colors_; ++i) glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, i, zero);
}

void Target::set_layer(const Texture& depth, int layer) const {
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0, layer);
}

void Target::begin(const DrawState& state) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, size_.width, size_.height);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthRangef(0.0f, 1.0f);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  const auto set = [](GLenum what, bool is_on) { (is_on ? glEnable : glDisable)(what); };
  set(GL_DEPTH_TEST, state.depth != DepthTest::off);
  // What lies behind a surface may lie behind the far plane too.
  set(GL_DEPTH_CLAMP, state.depth == DepthTest::farther);
  glDepthMask(state.depth == DepthTest::replace ? GL_TRUE : GL_FALSE);
  glDepthFunc(state.depth == DepthTest::nearer ? GL_GREATER : state.depth == DepthTest::farther ? GL_LESS : GL_ALWAYS);
  set(GL_BLEND, state.adds);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
  set(GL_CULL_FACE, state.faces != DrawnFaces::all);
  glFrontFace(GL_CCW);
  glCullFace(state.faces == DrawnFaces::front ? GL_BACK : GL_FRONT);
}

void draw_triangles(int vertices) {
  const VertexArray none = make_vertex_array("no attributes");
  glBindVertexArray(none.name());
  glDrawArrays(GL_TRIANGLES, 0, vertices);
  glBindVertexArray(0);
}

}  // namespace umbrameter::gl
