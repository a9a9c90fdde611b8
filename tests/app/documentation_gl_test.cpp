// The commands that the README and the tutorial show: each ```sh block runs as it is pasted, in order, in a folder that
// holds a scene.glb.
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string_view>

#include "scenes/builtin.h"
#include "scenes/gltf.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Blocks with one of these words are left out.
struct LeftOut {
  std::string_view word;
  std::string_view reason;
};
constexpr std::array<LeftOut, 5> left_out{{{"apt install", "installs the program"},
                                           {"scripts/setup", "installs packages"},
                                           {"scripts/demo", "installs packages and builds the program"},
                                           {"scripts/test", "installs packages and runs all tests, this one too"},
                                           {"cmake ", "builds the program"}}};

std::vector<std::string> shell_blocks(const std::string& markdown) {
  std::vector<std::string> blocks;
  std::istringstream lines(markdown);
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!is_inside && line == "```sh") {
      blocks.emplace_back();
      is_inside = true;
    } else if (is_inside && line == "```") {
      is_inside = false;
    } else if (is_inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

const LeftOut* left_out_for(const std::string& block) {
  for (const LeftOut& entry : left_out) {
    if (block.find(entry.word) != std::string::npos) return &entry;
  }
  return nullptr;
}

// As many exporters write it.
Scene without_names(Scene scene) {
  scene.name.clear();
  const auto clear = [](auto& things) {
    for (auto& thing : things) thing.name.clear();
  };
  clear(scene.textures);
  clear(scene.materials);
  clear(scene.meshes);
  clear(scene.objects);
  clear(scene.cameras);
  clear(scene.lights);
  return scene;
}

// A folder as the reader has it: a scene.glb, and the program on the PATH and where a build puts it. Images are small
// unless a command gives their size.
class ReaderFolder {
 public:
  explicit ReaderFolder(const Scene& scene) {
    folder_.write("scene.glb", to_glb(scene));
    const std::string program =
        "#!/bin/sh\n"
        "echo \"$1\" >>\"$UMBRAMETER_CALLS\"\n"
        "case \"$*\" in\n"
        "  *' --size '*) exec \"$UMBRAMETER_TESTED\" \"$@\" ;;\n"
        "  compare\\ * | sweep\\ * | trace\\ * | raster\\ *) exec \"$UMBRAMETER_TESTED\" \"$@\" --size 96x54 ;;\n"
        "  *) exec \"$UMBRAMETER_TESTED\" \"$@\" ;;\n"
        "esac\n";
    for (const char* place : {"path", "build/default/bin"}) {
      fs::create_directories(folder_ / place);
      put_text(folder_ / place / "umbrameter", program);
      fs::permissions(folder_ / place / "umbrameter", fs::perms::owner_all);
    }
  }

  // The script takes the program's path as its first word.
  ProgramResult run(const std::string& block) const {
    const fs::path script =
        folder_.write("block.sh", "set -euo pipefail\nexport UMBRAMETER_TESTED=\"$1\"\ncd '" + folder_.path().string() +
                                      "'\nexport PATH=\"" + (folder_ / "path").string() + ":$PATH\"\n" + block);
    ProgramOptions options;
    // One reader has one cache.
    options.environment = {"UMBRAMETER_CALLS=" + (folder_ / "calls").string(),
                           "XDG_CACHE_HOME=" + (folder_ / "cache").string()};
    options.wrapper = {"bash", script.string()};
    return run_program({}, options);
  }

  // The commands that were given to the program, one a line.
  std::string calls() const { return fs::exists(folder_ / "calls") ? text_of(folder_ / "calls") : ""; }
  bool has(const std::string& path) const { return fs::exists(folder_ / path); }

 private:
  TemporaryFolder folder_;
};

class Documentation : public GlRun {
 protected:
  static void expect_commands_to_work(const fs::path& document, const Scene& scene,
                                      std::initializer_list<const char*> expected_calls) {
    const ReaderFolder folder(scene);
    for (const std::string& block : shell_blocks(text_of(document))) {
      if (const LeftOut* entry = left_out_for(block)) {
        std::cout << "left out, because it " << entry->reason << ":\n" << block;
        continue;
      }
      const ProgramResult result = folder.run(block);
      ASSERT_EQ(result.exit_code, 0) << document << ":\n" << block << result.err;
    }
    std::string calls = "\n";
    calls += folder.calls();
    for (const char* command : expected_calls) {
      EXPECT_NE(calls.find(std::string("\n") + command + "\n"), std::string::npos) << command << " in:" << calls;
    }
  }
};

const fs::path readme = fs::path(UMBRAMETER_SOURCE) / "README.md";
const fs::path tutorial = fs::path(UMBRAMETER_SOURCE) / "docs" / "tutorial.md";
Scene contact_box() { return load_scene("contact-box"); }

TEST_F(Documentation, The_commands_of_the_readme_work_when_pasted) {
  expect_commands_to_work(readme, contact_box(), {"compare", "sweep"});
}

TEST_F(Documentation, The_commands_of_the_readme_work_on_a_file_without_names) {
  expect_commands_to_work(readme, without_names(contact_box()), {"compare", "sweep"});
}

TEST_F(Documentation, The_command_of_the_page_on_serve_works_when_pasted) {
  expect_commands_to_work(fs::path(UMBRAMETER_SOURCE) / "docs" / "serve.md", contact_box(), {"serve"});
}

TEST_F(Documentation, The_commands_of_the_tutorial_work_when_pasted) {
  expect_commands_to_work(tutorial, contact_box(), {"info", "compare", "sweep"});
}

TEST_F(Documentation, The_commands_of_the_tutorial_work_on_a_file_without_names) {
  expect_commands_to_work(tutorial, without_names(contact_box()), {"info", "compare", "sweep"});
}

TEST_F(Documentation, A_command_runs_in_the_readers_folder_with_a_small_image) {
  const ReaderFolder folder(contact_box());
  const ProgramResult result = folder.run("umbrameter trace scene.glb -o out/traced --truth.spp 1 --light 0\n");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_TRUE(folder.has("out/traced/experiment.toml"));
  EXPECT_EQ(folder.run("grep -q 96x54 out/traced/experiment.toml\n").exit_code, 0);
}

TEST_F(Documentation, A_command_that_fails_is_noticed_wherever_it_is_in_a_block) {
  const ReaderFolder folder(contact_box());
  EXPECT_EQ(folder.run("umbrameter info missing.glb\ntrue\n").exit_code, 4);
  EXPECT_EQ(folder.run("umbrameter info --no-such-flag | cat\ntrue\n").exit_code, 2);
  EXPECT_EQ(folder.calls(), "info\ninfo\n");
}

TEST(DocumentationBlocks, Are_those_marked_as_shell_commands) {
  const std::string markdown = "a\n```sh\none\ntwo\n```\n```\nthree\n```\n```cmake\nfour\n```\n```sh\nfive\n```\n";
  EXPECT_EQ(shell_blocks(markdown), (std::vector<std::string>{"one\ntwo\n", "five\n"}));
}

TEST(DocumentationBlocks, Are_left_out_only_where_they_build_or_install) {
  EXPECT_NE(left_out_for("scripts/demo     # installs what is missing\n"), nullptr);
  EXPECT_NE(left_out_for("cmake --preset default\n"), nullptr);
  EXPECT_EQ(left_out_for("umbrameter compare scene.glb -o out/demo\n"), nullptr);
}

}  // namespace
}  // namespace umbrameter
