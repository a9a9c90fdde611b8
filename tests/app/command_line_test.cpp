#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

const std::vector<std::string> commands = {"compare", "sweep", "trace", "raster",     "diff", "scenes",
                                           "scene",   "cache", "info",  "parameters", "help", "serve"};

// In characters, not bytes.
std::size_t width_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80; }));
}

void expect_narrow(const std::string& text, const std::string& what) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(width_of(line), 100u) << what << ": " << line;
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

// What the shell prints and how it ends.
ProgramResult shell(const TemporaryFolder& folder, const std::string& command) {
  const int status = std::system(("(" + command + ") >" + (folder / "shell.out").string() + " 2>" +
                                  (folder / "shell.err").string() + " </dev/null")
                                     .c_str());
  return {status, text_of(folder / "shell.out"), text_of(folder / "shell.err")};
}

// What bash offers behind these words, the last one unfinished.
std::string completions(const TemporaryFolder& folder, const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += " '" + word + "'";
  const std::string script = "cd '" + folder.path().string() + "'; source ./umbrameter.bash; COMP_WORDS=(" + line +
                             "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                             "; _umbrameter; printf '%s\\n' \"${COMPREPLY[@]}\"";
  folder.write("complete.sh", script);
  return std::string(" ") + shell(folder, "bash " + (folder / "complete.sh").string() + " | tr '\\n' ' '").out;
}

TEST(CommandLine, Help_is_on_stdout_and_shows_an_example_for_each_command) {
  const ProgramResult all = run_program({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_EQ(all.err, "");
  for (const char* command : {"compare", "sweep", "trace", "raster", "diff", "scenes", "scene", "info", "parameters"}) {
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

TEST(CommandLine, V_is_short_for_version) { EXPECT_EQ(run_program({"-V"}).out, run_program({"--version"}).out); }

TEST(CommandLine, Help_fits_one_hundred_columns) {
  expect_narrow(run_program({"--help"}).out, "--help");
  expect_narrow(run_program({"--help-all"}).out, "--help-all");
  for (const std::string& command : commands) {
    expect_narrow(run_program({command, "--help"}).out, command + " --help");
    expect_narrow(run_program({command, "--help-all"}).out, command + " --help-all");
  }
}

TEST(CommandLine, Help_lists_the_basic_parameters_and_help_all_the_rest) {
  const std::string basic = run_program({"compare", "--help"}).out;
  const std::string all = run_program({"compare", "--help-all"}).out;
  EXPECT_NE(basic.find("--shadow.constant-bias"), std::string::npos);
  EXPECT_EQ(basic.find("--shadow.filter-taps"), std::string::npos);
  EXPECT_NE(basic.find("--help-all"), std::string::npos) << "it says where the rest is";
  EXPECT_NE(all.find("--shadow.constant-bias"), std::string::npos);
  EXPECT_NE(all.find("--shadow.filter-taps"), std::string::npos);
  EXPECT_LT(std::count(basic.begin(), basic.end(), '\n'), 70) << "it fits a tall terminal";
}

TEST(CommandLine, Help_of_a_command_that_draws_nothing_lists_no_parameters_of_techniques) {
  for (const char* command : {"trace", "evaluate"}) {
    const std::string basic = run_program({command, "--help"}).out;
    // The counted pixels depend on the map's size, the reference of AO on the radius.
    for (const char* read : {"--shadow.resolution", "--ao.radius", "--truth.spp"}) {
      EXPECT_NE(basic.find(read), std::string::npos) << command << read;
    }
    for (const char* unread : {"--shadow.constant-bias", "--shadow.filter", "--ao.samples", "--engine.adapter"}) {
      EXPECT_EQ(basic.find(unread), std::string::npos) << command << unread;
    }
    EXPECT_NE(run_program({command, "--help-all"}).out.find("--shadow.constant-bias"), std::string::npos) << command;
  }
}

TEST(CommandLine, Most_basic_parameters_take_one_line) {
  std::istringstream lines(run_program({"compare", "--help"}).out);
  int parameters = 0;
  int continued = 0;
  bool is_parameter = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  --")) {
      is_parameter = line.find('.') < line.find(' ', 4);
      parameters += is_parameter ? 1 : 0;
    } else if (line.starts_with("      ")) {
      continued += is_parameter ? 1 : 0;
    }
  }
  EXPECT_GT(parameters, 10);
  EXPECT_LE(continued, 4);
}

TEST(CommandLine, Help_of_a_command_is_shown_by_the_command_help_too) {
  EXPECT_EQ(run_program({"help", "sweep"}).out, run_program({"sweep", "--help"}).out);
  EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
  const ProgramResult result = run_program({"help", "swep"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("did you mean 'sweep'?"), std::string::npos) << result.err;
}

TEST(CommandLine, A_hint_names_the_whole_parameter) {
  const auto hint = [](const std::string& flag) {
    return run_program({"compare", "corner", "-o", "out", flag, "1"}).err;
  };
  EXPECT_NE(hint("--bias").find("did you mean '--shadow.constant-bias'"), std::string::npos) << hint("--bias");
  EXPECT_EQ(hint("--bias").find("--size"), std::string::npos) << hint("--bias");
  EXPECT_NE(hint("--cascaeds").find("did you mean '--shadow.cascades'?"), std::string::npos);
  const std::string axis = run_program({"sweep", "corner", "-o", "out", "--vary", "bias=0,1"}).err;
  EXPECT_NE(axis.find("did you mean 'shadow.constant-bias'"), std::string::npos) << axis;
}

TEST(CommandLine, A_report_refuses_a_run_that_is_given_twice) {
  const TemporaryFolder folder;
  const std::string run = folder.path().string();
  const ProgramResult result = run_program({"report", run, run + "/.", "-o", folder / "both"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("this run is given twice; name each run once"), std::string::npos) << result.err;
}

TEST(CommandLine, Pcf_is_understood_as_box) {
  const ProgramResult result = run_program({"raster", "corner", "--dry-run", "--shadow.filter", "pcf", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("box filter"), std::string::npos) << result.out;
}

TEST(CommandLine, A_dry_run_of_the_image_commands_needs_no_folder_and_writes_none) {
  const TemporaryFolder folder;
  for (const std::string command : {"compare", "trace", "raster"}) {
    const ProgramResult result =
        run_program({command, "courtyard", "--dry-run", "-o", (folder / "out").string(), "--quiet"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const char* row : {"scene ", "view ", "lights ", "files "}) {
      EXPECT_NE(result.out.find(row), std::string::npos) << result.out;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
  EXPECT_EQ(run_program({"compare", "courtyard", "--dry-run", "--quiet"}).exit_code, 0);
  const ProgramResult json = run_program({"trace", "corner", "--dry-run", "--quiet", "--json"});
  EXPECT_EQ(json.out.rfind("{\n", 0), 0u) << json.out;
}

TEST(Completion, The_scripts_parse) {
  const TemporaryFolder folder;
  for (const std::string kind : {"bash", "zsh", "fish"}) {
    const std::filesystem::path script = folder / ("umbrameter." + kind);
    ASSERT_EQ(run_program({"generate", kind, "-o", script.string()}).exit_code, 0);
    EXPECT_EQ(run_program({"generate", kind}).out, text_of(script));
    EXPECT_NE(text_of(script).find("shadow.constant-bias"), std::string::npos);
    if (!has_program(kind)) continue;
    const ProgramResult result = shell(folder, kind + " -n '" + script.string() + "'");
    EXPECT_EQ(result.exit_code, 0) << kind << ": " << result.err;
    EXPECT_EQ(result.err, "");
  }
}

TEST(Completion, Bash_completes_commands_parameters_values_and_scenes) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"generate", "bash", "-o", (folder / "umbrameter.bash").string()}).exit_code, 0);
  EXPECT_EQ(completions(folder, {"umbrameter", "swe"}), " sweep ");
  EXPECT_EQ(completions(folder, {"umbrameter", "compare", "--shadow.cons"}), " --shadow.constant-bias ");
  EXPECT_EQ(completions(folder, {"umbrameter", "compare", "--shadow.filter", "bo"}), " box ");
  EXPECT_EQ(completions(folder, {"umbrameter", "compare", "--shadow.filter", "=", "bo"}), " box ");
  EXPECT_EQ(completions(folder, {"umbrameter", "compare", "--shadow.filter", "="}),
            " nearest bilinear box tent gaussian poisson vogel optimized area-tent ");
  EXPECT_EQ(completions(folder, {"umbrameter", "sweep", "--vary", "shadow.resol"}), " shadow.resolution= ");
  EXPECT_EQ(completions(folder, {"umbrameter", "info", "courty"}), " courtyard ");
  EXPECT_EQ(completions(folder, {"umbrameter", "compare", "complete"}), " complete.sh ") << "files are scenes, too";
  EXPECT_EQ(completions(folder, {"umbrameter", "help", "tra"}), " trace ");
}

TEST(ManualPage, It_has_every_section_and_no_warning) {
  const TemporaryFolder folder;
  const std::filesystem::path page = folder / "umbrameter.1";
  ASSERT_EQ(run_program({"generate", "man", "-o", page.string()}).exit_code, 0);
  const std::string text = text_of(page);
  for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "COMMANDS", "PARAMETERS", "EXIT STATUS"}) {
    EXPECT_NE(text.find(std::string("\n.SH ") + section + "\n"), std::string::npos) << section;
  }
  EXPECT_NE(text.find("\\-\\-shadow.constant\\-bias"), std::string::npos);
  if (!has_program("groff")) GTEST_SKIP() << "no groff here";
  const ProgramResult result = shell(folder, "groff -man -Tutf8 -ww -z '" + page.string() + "'");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
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

TEST(CommandLine, Parameters_are_listed_as_JSON_with_type_default_and_limits) {
  const ProgramResult result = run_program({"parameters", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const auto named = [&](const std::string& name) {
    return *std::ranges::find_if(json["parameters"], [&](const auto& each) { return each["name"] == name; });
  };
  const auto filter = named("shadow.filter");
  EXPECT_EQ(filter["type"], "choice");
  EXPECT_EQ(filter["default"], "nearest");
  EXPECT_EQ(filter["choices"][1], "bilinear");
  EXPECT_EQ(filter["aliases"]["pcf"], "box");
  EXPECT_EQ(named("shadow.resolution")["maximum"], 16384);
  EXPECT_EQ(named("shadow.constant-bias")["type"], "length");
  EXPECT_EQ(named("scene.ground")["default"], false);
  EXPECT_EQ(run_program({"parameters", "--json", "--markdown"}).exit_code, 2);
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
