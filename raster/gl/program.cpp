#include "raster/gl/program.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <utility>

#include "core/error.h"
#include "raster/gl/api.h"

namespace umbrameter::gl {
namespace {

// The name of the file in an include line; empty if the line is none. Instead of a name in quotes it may have a word
// that `defines` gives.
std::string included_by(const std::string& line, const std::string& defines) {
  static const std::regex include(R"re(^\s*#include\s+(?:"([^"]+)"|([A-Z_]+))\s*$)re");
  std::smatch match;
  if (!std::regex_match(line, match, include)) return {};
  if (match[1].matched) return match[1];
  const std::string define = "#define " + match[2].str() + " ";
  const std::size_t found = defines.find(define);
  if (found == std::string::npos) return match[2];
  const std::size_t begin = found + define.size();
  return defines.substr(begin, defines.find('\n', begin) - begin);
}

void append_file(ShaderText& shader, const std::string& file, const std::string& defines, const ShaderLoader& load,
                 const std::string& included_at) {
  const auto text = load(file);
  if (!text) {
    throw Error(ExitCode::no_backend, "shader " + (included_at.empty() ? file : included_at),
                "there is no shader file '" + file + "'", "this is a bug in the build: please report it");
  }
  const std::string number = std::to_string(shader.files.size());
  shader.files.push_back(file);
  shader.text += "#line 1 " + number + "\n";
  std::istringstream lines{std::string(*text)};
  std::string line;
  for (int row = 1; std::getline(lines, line); ++row) {
    const std::string name = included_by(line, defines);
    if (name.empty()) {
      shader.text += line + "\n";
      continue;
    }
    if (std::ranges::find(shader.files, name) == shader.files.end()) {
      append_file(shader, name, defines, load, file + ":" + std::to_string(row));
    }
    shader.text += "#line " + std::to_string(row + 1) + " " + number + "\n";
  }
}

GLenum stage_of(const std::string& file) {
  if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (file.ends_with(".geom")) return GL_GEOMETRY_SHADER;
  if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
  return GL_COMPUTE_SHADER;
}

template <class GetLength, class GetLog>
std::string read_log(unsigned name, GetLength get_length, GetLog get_log) {
  GLint length = 0;
  get_length(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  get_log(name, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

Shader compile(const std::string& file, const std::string& defines, const ShaderLoader& load) {
  const ShaderText shader_text = resolve_includes(file, defines, load);
  Shader shader(glCreateShader(stage_of(file)));
  glObjectLabel(GL_SHADER, shader.name(), -1, file.c_str());
  const char* text = shader_text.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    const std::string log = read_log(
        shader.name(), [](GLuint n, GLenum what, GLint* value) { glGetShaderiv(n, what, value); },
        [](GLuint n, GLsizei size, GLsizei* written, GLchar* log_text) {
          glGetShaderInfoLog(n, size, written, log_text);
        });
    throw Error(ExitCode::no_backend, "shader " + file, name_files_in_log(log, shader_text.files),
                "choose another device with --gl-device");
  }
  return shader;
}

void append_inputs(unsigned program, GLenum interface, std::vector<ProgramInput>& inputs) {
  GLint count = 0;
  glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
  for (GLint i = 0; i < count; ++i) {
    char name[256];
    glGetProgramResourceName(program, interface, static_cast<GLuint>(i), sizeof(name), nullptr, name);
    const GLint location = interface == GL_UNIFORM ? glGetUniformLocation(program, name) : i;
    if (location >= 0) inputs.push_back({name, location});  // below 0: a member of a block
  }
}

}  // namespace

ShaderText resolve_includes(const std::string& file, const std::string& defines, const ShaderLoader& load) {
  ShaderText shader;
  shader.text = "#version 450 core\n" + defines;
  append_file(shader, file, defines, load, {});
  return shader;
}

std::string name_files_in_log(const std::string& log, const std::vector<std::string>& files) {
  static const std::regex position(R"(^(\d+)(?::(\d+)|\((\d+)\))(.*)$)");
  std::istringstream lines(log);
  std::string named;
  std::string line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_match(line, match, position) && match[1].length() < 6) {
      const auto number = static_cast<std::size_t>(std::stoul(match[1]));
      if (number < files.size()) {
        line = files[number] + ":" + (match[2].matched ? match[2].str() : match[3].str()) + match[4].str();
      }
    }
    named += line + "\n";
  }
  return named;
}

LinkedProgram make_program(const ProgramSource& source, const ShaderLoader& load) {
  Program program(glCreateProgram());
  std::string label;
  std::vector<Shader> shaders;
  for (const std::string& file : source.files) {
    shaders.push_back(compile(file, source.defines, load));
    glAttachShader(program.name(), shaders.back().name());
    label += (label.empty() ? "" : "+") + file;
  }
  glObjectLabel(GL_PROGRAM, program.name(), -1, label.c_str());
  glLinkProgram(program.name());
  for (const Shader& shader : shaders) glDetachShader(program.name(), shader.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    const std::string log = read_log(
        program.name(), [](GLuint n, GLenum what, GLint* value) { glGetProgramiv(n, what, value); },
        [](GLuint n, GLsizei size, GLsizei* written, GLchar* text) { glGetProgramInfoLog(n, size, written, text); });
    throw Error(ExitCode::no_backend, "shader program " + label, log, "choose another device with --gl-device");
  }
  LinkedProgram linked_program{std::move(program), {}};
  append_inputs(linked_program.program.name(), GL_UNIFORM, linked_program.inputs);
  append_inputs(linked_program.program.name(), GL_UNIFORM_BLOCK, linked_program.inputs);
  append_inputs(linked_program.program.name(), GL_SHADER_STORAGE_BLOCK, linked_program.inputs);
  return linked_program;
}

}  // namespace umbrameter::gl
