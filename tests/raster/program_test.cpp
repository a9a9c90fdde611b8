#include "raster/gl/program.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"

namespace umbrameter {
namespace {

gl::ShaderLoader from(const std::map<std::string, std::string>& files) {
  return [&files](std::string_view name) -> std::optional<std::string_view> {
    const auto found = files.find(std::string(name));
    if (found == files.end()) return std::nullopt;
    return found->second;
  };
}

TEST(ShaderText, Version_and_defines_come_first_and_lines_keep_their_numbers) {
  const std::map<std::string, std::string> files{{"a.comp", "one\n#include \"b.glsl\"\nthree\n"}, {"b.glsl", "two\n"}};
  const gl::ShaderText shader = gl::resolve_includes("a.comp", "#define X 1\n", from(files));
  EXPECT_EQ(shader.text, "#version 450 core\n#define X 1\n#line 1 0\none\n#line 1 1\ntwo\n#line 3 0\nthree\n");
  EXPECT_EQ(shader.files, (std::vector<std::string>{"a.comp", "b.glsl"}));
}

TEST(ShaderText, A_file_is_taken_in_once_even_in_a_circle) {
  const std::map<std::string, std::string> files{{"a.comp", "#include \"b.glsl\"\n#include \"c.glsl\"\n"},
                                                 {"b.glsl", "#include \"c.glsl\"\nb\n"},
                                                 {"c.glsl", "#include \"b.glsl\"\nc\n"}};
  const gl::ShaderText shader = gl::resolve_includes("a.comp", "", from(files));
  EXPECT_EQ(shader.files, (std::vector<std::string>{"a.comp", "b.glsl", "c.glsl"}));
  EXPECT_EQ(shader.text,
            "#version 450 core\n#line 1 0\n#line 1 1\n#line 1 2\n#line 2 2\nc\n#line 2 1\nb\n#line 2 0\n#line 3 0\n");
}

TEST(ShaderText, An_include_may_name_the_file_by_a_define) {
  const std::map<std::string, std::string> files{{"a.comp", "#include TEXT\n#include NONE\n"}, {"b.glsl", "two\n"}};
  EXPECT_THROW(gl::resolve_includes("a.comp", "#define TEXT b.glsl\n", from(files)), Error);
  const std::string defines = "#define NONE b.glsl\n#define TEXT b.glsl\n";
  EXPECT_EQ(gl::resolve_includes("a.comp", defines, from(files)).files, (std::vector<std::string>{"a.comp", "b.glsl"}));
}

TEST(ShaderText, A_missing_include_names_file_and_line) {
  const std::map<std::string, std::string> files{{"a.comp", "one\ntwo\n#include \"gone.glsl\"\n"}};
  try {
    gl::resolve_includes("a.comp", "", from(files));
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("a.comp:3"), std::string::npos) << message;
    EXPECT_NE(message.find("gone.glsl"), std::string::npos) << message;
  }
}

TEST(ShaderText, Log_lines_of_Mesa_and_of_other_drivers_name_the_file) {
  const std::vector<std::string> files{"a.comp", "b.glsl"};
  EXPECT_EQ(gl::name_files_in_log("1:14(3): error: no such thing\n0(7) : error C0000: syntax\n", files),
            "b.glsl:14(3): error: no such thing\na.comp:7 : error C0000: syntax\n");
}

TEST(ShaderText, Log_lines_without_a_known_file_stay_as_they_are) {
  EXPECT_EQ(gl::name_files_in_log("9:1(1): error\n99999999999999999999:1(1): x\nplain\n", {"a.comp"}),
            "9:1(1): error\n99999999999999999999:1(1): x\nplain\n");
}

TEST(EmbeddedShaders, Every_program_finds_all_that_it_includes) {
  for (const char* file :
       {"gbuffer.vert", "gbuffer.frag", "gbuffer_resolve.comp", "classify.comp", "linear_depth.comp", "shadow.vert",
        "shadow.geom", "shadow.frag", "visibility.comp", "ssao.comp", "box_blur.comp"}) {
    const gl::ShaderText shader = gl::resolve_includes(file, "");
    EXPECT_EQ(shader.text.find("#include"), std::string::npos) << file;
    EXPECT_NE(shader.text.find("void main()"), std::string::npos) << file;
  }
  EXPECT_FALSE(gl::embedded_shader("gone.comp").has_value());
}

}  // namespace
}  // namespace umbrameter
