# cmake -DOUTPUT=file.cpp -DFILES=shaders/a.vert,shaders/b.frag -P embed_shaders.cmake
# Writes the shader files as string literals, with the look-up function that raster/gl/program.h declares.
string(REPLACE "," ";" FILES "${FILES}")
set(entries "")
foreach(file ${FILES})
  file(READ ${file} text)
  get_filename_component(name ${file} NAME)
  string(APPEND entries "    {\"${name}\", R\"~~~(${text})~~~\"},\n")
endforeach()
file(WRITE ${OUTPUT}.new "#include \"raster/gl/program.h\"

namespace umbrameter::gl {

std::optional<std::string_view> embedded_shader(std::string_view file) {
  struct File {
    std::string_view name;
    std::string_view text;
  };
  static constexpr File files[] = {
${entries}  };
  for (const File& candidate : files) {
    if (candidate.name == file) return candidate.text;
  }
  return std::nullopt;
}

}  // namespace umbrameter::gl
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUTPUT}.new)
