#include <gtest/gtest.h>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

TEST(CommandLine, Help_is_on_stdout_and_shows_an_example_for_each_command) {
  const ProgramResult all = run_program({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_EQ(all.err, "");
  for (const char* command : {"compare", "sweep", "trace", "raster", "scenes", "scene", "info", "parameters"}) {
    EXPECT_NE(all.out.find(command), std::string::npos) << command;
    const ProgramResult one = run_program({command, "--help"});
    EXPECT_EQ(one.exit_code, 0) << command;
    EXPECT_NE(one.out.find(std::string("Example: umbrameter ") + command), std::string::npos) << one.out;
  }
}

TEST(CommandLine, Version_names_program_and_number) {
  const ProgramResult result = run_program({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.rfind("umbrameter ", 0), 0u) << result.out;
}

TEST(CommandLine, Built_in_scenes_are_listed_with_the_default_first) {
  const ProgramResult result = run_program({"scenes"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.rfind("courtyard", 0), 0u);
  for (const char* name : {"tilted-plane", "contact-box", "thin-leaf", "corner"}) {
    EXPECT_NE(result.out.find(name), std::string::npos) << name;
  }
}

TEST(CommandLine, The_reference_page_is_what_the_program_describes) {
  const ProgramResult result = run_program({"parameters", "--markdown"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, text_of(std::string(UMBRAMETER_DOCS) + "/parameters.md"))
      << "run: umbrameter parameters --markdown > docs/parameters.md";
}

TEST(CommandLine, A_written_scene_is_byte_identical_each_time_and_loads_back) {
  const TemporaryFolder folder;
  for (const char* file : {"a.glb", "b.glb"}) {
    const ProgramResult result = run_program({"scene", "thin-leaf", "-o", folder / file});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_EQ(text_of(folder / "a.glb"), text_of(folder / "b.glb"));
  EXPECT_EQ(text_of(folder / "a.glb").substr(0, 4), "glTF");
  const ProgramResult info = run_program({"info", folder / "a.glb"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("triangles"), std::string::npos);
}

}  // namespace
}  // namespace umbrameter
