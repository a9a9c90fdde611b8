#include "raster/gl/pass.h"

#include <utility>

#include "core/error.h"
#include "raster/gl/api.h"
#include "raster/shader_interface.h"

namespace umbrameter::gl {

Pass::Pass(const Context& context, const ProgramSource& source)
    : context_(context),
      label_(source.files.back()),
      program_(context.program({source.files, interface_defines() + source.defines})),
      bound_(program_.inputs.size()) {}

Pass& Pass::bind(const char* name, const Bound& bound) {
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    if (program_.inputs[i].name == name) bound_[i] = bound;
  }
  return *this;
}

int Pass::location(const char* name) {
  bind(name, {Bound::Kind::value});
  return glGetUniformLocation(program_.program.name(), name);
}

const Buffer& Pass::keep(Buffer buffer) { return kept_.emplace_back(std::move(buffer)); }

Pass& Pass::image(const char* name, const Texture& texture, Format format, bool layered, int level) {
  return bind(name, {Bound::Kind::image, texture.name(), format, layered, level});
}

template <class SetUniform, class... Number>
Pass& Pass::set(const char* name, SetUniform set_uniform, Number... numbers) {
  set_uniform(program_.program.name(), location(name), numbers...);
  return *this;
}

Pass& Pass::value(const char* name, float x) { return set(name, glProgramUniform1f, x); }
Pass& Pass::value(const char* name, int x) { return set(name, glProgramUniform1i, x); }
Pass& Pass::value(const char* name, unsigned x) { return set(name, glProgramUniform1ui, x); }
Pass& Pass::value(const char* name, int x, int y) { return set(name, glProgramUniform2i, x, y); }
Pass& Pass::value(const char* name, const vec2& v) { return set(name, glProgramUniform2f, v.x, v.y); }
Pass& Pass::value(const char* name, const vec3& v) { return set(name, glProgramUniform3f, v.x, v.y, v.z); }
Pass& Pass::value(const char* name, const vec4& v) { return set(name, glProgramUniform4f, v.x, v.y, v.z, v.w); }

void Pass::use() const {
  const unsigned program = program_.program.name();
  unsigned taken[6] = {};  // number of binding points in use, by kind
  for (std::size_t i = 0; i < bound_.size(); ++i) {
    const ProgramInput& input = program_.inputs[i];
    const Bound& bound = bound_[i];
    const unsigned point = taken[static_cast<std::size_t>(bound.kind)]++;
    switch (bound.kind) {
      case Bound::Kind::nothing:
        throw Error(ExitCode::no_backend, "shader " + label_, "nothing is bound to '" + input.name + "'",
                    "this is a bug in the build: please report it");
      case Bound::Kind::value:
        break;
      case Bound::Kind::texture:
        glProgramUniform1i(program, input.location, static_cast<int>(point));
        glBindTextureUnit(point, bound.name);
        break;
      case Bound::Kind::image:
        glProgramUniform1i(program, input.location, static_cast<int>(point));
        glBindImageTexture(point, bound.name, bound.level, bound.layered ? GL_TRUE : GL_FALSE, 0, GL_WRITE_ONLY,
                           internal_format(bound.format));
        break;
      case Bound::Kind::buffer:
        glShaderStorageBlockBinding(program, static_cast<unsigned>(input.location), point);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, point, bound.name);
        break;
      case Bound::Kind::block:
        glUniformBlockBinding(program, static_cast<unsigned>(input.location), point);
        glBindBufferBase(GL_UNIFORM_BUFFER, point, bound.name);
        break;
    }
  }
  glUseProgram(program);
}

void Pass::dispatch(int width, int height, int layers) const {
  dispatch_groups(group_count(width), group_count(height), static_cast<unsigned>(layers));
}

void Pass::dispatch_groups(unsigned x, unsigned y, unsigned z) const {
  use();
  glDispatchCompute(x, y, z);
  make_writes_visible();
  context_.check(label_.c_str());
}

void make_writes_visible() {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace umbrameter::gl
