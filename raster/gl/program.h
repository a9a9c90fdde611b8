// Shader programs from the files that were embedded at build time: includes resolved, #defines put in front,
// compiler messages that name the file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raster/gl/objects.h"

namespace umbrameter::gl {

/// Which program: one file a stage, told apart by extension (.vert, .geom, .frag, .comp), and lines put in front.
struct ProgramSource {
  std::vector<std::string> files;
  std::string defines;
};

/// The text of a shader file, or nothing when there is none of that name.
using ShaderLoader = std::function<std::optional<std::string_view>(std::string_view)>;

/// A file of raster/shaders.
std::optional<std::string_view> embedded_shader(std::string_view file);

/// What goes to the compiler, and the files in it: number i in #line and in messages is files[i].
struct ShaderText {
  std::string text;
  std::vector<std::string> files;
};

/// Puts version and defines in front and replaces each line `#include "name"` by that file, the first time that it
/// is met. Throws Error (no_backend) naming file and line when an included file does not exist.
ShaderText resolve_includes(const std::string& file, const std::string& defines,
                            const ShaderLoader& load = embedded_shader);

/// A compiler's log with the file numbers at the start of its lines ("2:14(3): error", "2(14) : error") replaced by
/// "name:14".
std::string name_files_in_log(const std::string& log, const std::vector<std::string>& files);

/// What a program reads or writes by name: a uniform of any kind, or a block.
struct ProgramInput {
  std::string name;
  int location = 0;  ///< of a block: its index
};

struct LinkedProgram {
  Program program;
  std::vector<ProgramInput> inputs;  ///< those that the linked program uses
};

/// Compiles and links. Throws Error (no_backend) with the driver's messages.
LinkedProgram make_program(const ProgramSource& source, const ShaderLoader& load = embedded_shader);

}  // namespace umbrameter::gl
