#include "raster/gl/compute_pass.h"

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"

namespace umbrameter::gl {

ComputePass::ComputePass(const Context& context, const std::string& file, const std::string& defines)
    : context_(context), file_(file), program_(context.program({{file}, interface_defines() + defines})) {}

int ComputePass::location(const char* name) const {
  const int found = glGetUniformLocation(program_.name(), name);
  if (found < 0) {
    throw Error(ExitCode::no_backend, "shader " + file_, std::string("it has no uniform '") + name + "'",
                "this is a bug in the build: please report it");
  }
  return found;
}

ComputePass& ComputePass::texture(const char* name, const Texture& texture) {
  glProgramUniform1i(program_.name(), location(name), static_cast<int>(next_texture_));
  glBindTextureUnit(next_texture_++, texture.name());
  return *this;
}

ComputePass& ComputePass::image(const char* name, const Texture& texture, Format format, bool layered) {
  glProgramUniform1i(program_.name(), location(name), static_cast<int>(next_image_));
  glBindImageTexture(next_image_++, texture.name(), 0, layered ? GL_TRUE : GL_FALSE, 0, GL_WRITE_ONLY,
                     internal_format(format));
  return *this;
}

ComputePass& ComputePass::value(const char* name, float number) {
  glProgramUniform1f(program_.name(), location(name), number);
  return *this;
}

ComputePass& ComputePass::value(const char* name, int number) {
  glProgramUniform1i(program_.name(), location(name), number);
  return *this;
}

ComputePass& ComputePass::value(const char* name, int x, int y) {
  glProgramUniform2i(program_.name(), location(name), x, y);
  return *this;
}

void ComputePass::dispatch(int width, int height, int layers) {
  glUseProgram(program_.name());
  glDispatchCompute(group_count(width), group_count(height), static_cast<unsigned>(layers));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  context_.check(file_.c_str());
}

}  // namespace umbrameter::gl
