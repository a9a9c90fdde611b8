// `presets` and --preset: what is listed, what a preset sets, and what overrides it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "experiments/settings/experiment.h"
#include "tests/app/run_program.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

Json listed() {
  const ProgramResult result = run_program({"presets", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return Json::parse(result.out);
}

// What `compare` would measure, without drawing or tracing anything.
ProgramResult settings(std::vector<std::string> more) {
  std::vector<std::string> words{"compare", "contact-box", "--light", "0", "--dry-run", "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return run_program(words);
}

TEST(Presets, Every_one_says_where_it_is_from_and_sets_known_parameters_to_allowed_values) {
  const Json presets = listed();
  EXPECT_GE(presets.size(), 39u);
  std::set<std::string> kinds;
  for (const Json& preset : presets) {
    SCOPED_TRACE(preset.at("name").get<std::string>());
    kinds.insert(preset.at("kind").get<std::string>());
    Experiment experiment;
    const Parameters parameters = describe(experiment);
    EXPECT_FALSE(preset.at("values").empty());
    for (const auto& [key, value] : preset.at("values").items()) {
      const Parameter& parameter = require(parameters, key);
      if (value.is_string()) {
        EXPECT_NO_THROW(parameter.set(Value(value.get<std::string>()))) << key;
      } else if (value.is_boolean()) {
        EXPECT_NO_THROW(parameter.set(Value(value.get<bool>()))) << key;
      } else if (value.is_number_integer()) {
        EXPECT_NO_THROW(parameter.set(Value(value.get<std::int64_t>()))) << key;
      } else {
        EXPECT_NO_THROW(parameter.set(Value(value.get<double>()))) << key;
      }
    }
    EXPECT_EQ(settings({"--preset", preset.at("name").get<std::string>()}).exit_code, 0);
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"ao", "directional", "point", "spot"}));
}

TEST(Presets, A_file_overrides_a_preset_and_flags_override_both) {
  const TemporaryFolder folder;
  const std::string file = folder.write("mine.toml", "[shadow]\nresolution = 700\nfilter-size = 7\n");
  const std::string out = folder / "out";
  const ProgramResult run =
      run_program({"trace", "contact-box", "--light", "0", "--size", "8x5", "--no-cache", "--no-figures", "-o", out,
                   "--preset", "playcanvas-pcf3", "--preset", "xegtao", "-c", file, "--shadow.resolution", "300"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string written = text_of(out + "/experiment.toml");
  for (const char* line :
       {"\nresolution = 300 ", "\nfilter-size = 7 ", "\nfilter = \"optimized\" ", "\ntechnique = \"gtao\" ",
        "\npolygon-offset-factor = 0.5 ", "\nconstant-bias = \"1e-04depth\" "}) {
    EXPECT_NE(written.find(line), std::string::npos) << line;
  }
}

TEST(Presets, An_unknown_name_and_a_broken_file_are_one_line) {
  const ProgramResult unknown = settings({"--preset", "playcanvas-pcf2"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("did you mean 'playcanvas-pcf1' or 'playcanvas-pcf3'?"), std::string::npos) << unknown.err;

  const TemporaryFolder folder;
  ProgramOptions elsewhere;
  elsewhere.environment = {"UMBRAMETER_DATA=" + folder.path().string()};
  const ProgramResult missing = run_program({"presets"}, elsewhere);
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_NE(missing.err.find("set UMBRAMETER_DATA to its folder"), std::string::npos) << missing.err;
  std::filesystem::create_directories(folder / "presets");
  const char* const head = "[preset]\nengine = \"E\"\nmeaning = \"m\"\nsource = \"s\"\n";
  for (const auto& [text, message] :
       {std::pair{std::string("[shadow]\n"), "needs engine, meaning and source"},
        std::pair{head + std::string("kind = \"sun\"\nconfirmed = \"run\"\n"), "preset.kind must be"},
        std::pair{head + std::string("kind = \"spot\"\nconfirmed = \"yes\"\n"), "preset.confirmed must be"},
        std::pair{head + std::string("kind = \"ao\"\nconfirmed = \"run\"\n[shadow]\nresolution = 5\n"),
                  "sets parameters of"}}) {
    folder.write("presets/mine.toml", text);
    ProgramOptions options;
    options.environment = {"UMBRAMETER_DATA=" + folder.path().string()};
    const ProgramResult broken = run_program({"presets"}, options);
    EXPECT_EQ(broken.exit_code, 2);
    EXPECT_NE(broken.err.find("mine.toml"), std::string::npos) << broken.err;
    EXPECT_NE(broken.err.find(message), std::string::npos) << broken.err;
  }
}

}  // namespace
}  // namespace umbrameter
