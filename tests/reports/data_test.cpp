#include "reports/files/data.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace umbrameter {
namespace {

enum class Filter : int { nearest, box };
constexpr std::array<std::string_view, 2> filter_names = {"nearest", "box"};

struct Sample {
  bool enabled = true;
  int resolution = 1024;
  double bias = 0.02;
  std::string camera = "main";
  Size size;
  Filter filter = Filter::box;
};

Parameters describe(Sample& sample) {
  return concatenate({Description("view")
                          .field("camera", sample.camera, {"", "camera of the scene, by name or index"})
                          .field("size", sample.size, {"px", "size of the image", 1, 16384})
                          .take(),
                      Description("shadow")
                          .field("enabled", sample.enabled, {"", "draw shadows"})
                          .field("resolution", sample.resolution, {"texels", "side of the map", 1, 16384})
                          .field("constant-bias", sample.bias, {"m", "along the light"})
                          .choice("filter", sample.filter, filter_names, {"", "how taps are weighed"})
                          .take()});
}

struct Loaded {
  Error error{ExitCode::ok, "no error", ""};
  ExperimentFile file;
};

Loaded load(const std::string& text) {
  const TemporaryFolder folder;
  put_text(folder / "experiment.toml", text);
  Loaded loaded;
  try {
    loaded.file = read_experiment(folder / "experiment.toml");
  } catch (const Error& error) {
    loaded.error = error;
  }
  return loaded;
}

TEST(Csv, The_header_comes_first_and_numbers_read_back_the_same) {
  const Table table{{{"shadow.resolution", "texels", ""}, {"mae", "1", ""}, {"ok", "", ""}},
                    {{std::int64_t{512}, 0.1, true}, {std::int64_t{-1}, 1e-300, false}}};
  EXPECT_EQ(to_csv(table), "shadow.resolution,mae,ok\r\n512,0.1,true\r\n-1,1e-300,false\r\n");
}

// RFC 4180, section 2, rules 5 to 7.
TEST(Csv, Fields_with_commas_quotes_and_line_breaks_are_quoted) {
  const Table table{
      {{"a,b", "", ""}, {"c", "", ""}},
      {{std::string("say \"hi\""), std::string("two\r\nlines")}, {std::string(""), std::string("plain")}}};
  EXPECT_EQ(to_csv(table), "\"a,b\",c\r\n\"say \"\"hi\"\"\",\"two\r\nlines\"\r\n,plain\r\n");
}

TEST(Csv, A_table_without_rows_is_its_header) { EXPECT_EQ(to_csv({{{"mae", "1", ""}}, {}}), "mae\r\n"); }

TEST(Experiment, It_reads_as_documented) {
  Sample sample;
  EXPECT_EQ(to_toml("courtyard", describe(sample), {{"shadow.constant-bias", "0:0.2:129"}}),
            "scene = \"courtyard\"\n"
            "\n[view]\n"
            "camera = \"main\"  # camera of the scene, by name or index\n"
            "size = \"1280x720\"  # [px] size of the image\n"
            "\n[shadow]\n"
            "enabled = true  # draw shadows\n"
            "resolution = 1024  # [texels] side of the map\n"
            "constant-bias = 0.02  # [m] along the light\n"
            "filter = \"box\"  # how taps are weighed: nearest or box\n"
            "\n[vary]  # first:last:count, first:last:count:log, or a list\n"
            "\"shadow.constant-bias\" = \"0:0.2:129\"\n");
}

TEST(Experiment, The_scene_stands_in_its_table_where_parameters_do) {
  std::string unit = "cm";
  const Parameters parameters = Description("scene").field("unit", unit, {"", "unit of the file"}).take();
  const std::string text = to_toml("courtyard", parameters, {});
  EXPECT_EQ(text,
            "[scene]\n"
            "source = \"courtyard\"  # file, or name of a built-in scene\n"
            "unit = \"cm\"  # unit of the file\n");
  const Loaded loaded = load(text);
  ASSERT_EQ(loaded.error.code(), ExitCode::ok) << loaded.error.what();
  EXPECT_EQ(loaded.file.scene, "courtyard");
  ASSERT_EQ(loaded.file.values.size(), 1u);
  EXPECT_EQ(loaded.file.values[0].first, "scene.unit");
  EXPECT_EQ(std::get<std::string>(loaded.file.values[0].second), "cm");
  EXPECT_EQ(load("[scene]\nsource = 3\n").error.code(), ExitCode::usage);
}

TEST(Experiment, Every_value_comes_back_to_the_last_bit) {
  for (const double bias : {0.1, 1.0, -0.0, 1e300, 5e-324, 1.0 / 3.0, 123456789.0, 1e22}) {
    Sample sample;
    sample.bias = bias;
    sample.enabled = false;
    sample.resolution = 16384;
    sample.size = {640, 480};
    sample.filter = Filter::nearest;
    const Loaded loaded = load(to_toml("a.glb", describe(sample), {}));
    ASSERT_EQ(loaded.error.code(), ExitCode::ok) << loaded.error.what();
    Sample read;
    const Parameters parameters = describe(read);
    EXPECT_EQ(loaded.file.values.size(), parameters.size());
    for (const auto& [key, value] : loaded.file.values) require(parameters, key).set(value);
    EXPECT_EQ(read.bias, bias);
    EXPECT_EQ(std::signbit(read.bias), std::signbit(bias));
    EXPECT_FALSE(read.enabled);
    EXPECT_EQ(read.resolution, 16384);
    EXPECT_EQ(read.size, (Size{640, 480}));
    EXPECT_EQ(read.filter, Filter::nearest);
  }
}

TEST(Experiment, Hostile_names_come_back_unchanged) {
  for (const std::string& name :
       {std::string("a \"quoted\" \\ name"), std::string("tab\tnew\nline\r\x01\x7f"), std::string("# = [shadow]"),
        std::string("光 λ ’"), std::string("\"\"\"\n[vary]\n"), std::string()}) {
    Sample sample;
    sample.camera = name;
    const Loaded loaded = load(to_toml(name, describe(sample), {}));
    ASSERT_EQ(loaded.error.code(), ExitCode::ok) << loaded.error.what();
    EXPECT_EQ(loaded.file.scene, name);
    bool found = false;
    for (const auto& [key, value] : loaded.file.values) {
      if (key != "view.camera") continue;
      EXPECT_EQ(std::get<std::string>(value), name);
      found = true;
    }
    EXPECT_TRUE(found);
  }
}

TEST(Experiment, Axes_keep_the_order_in_which_they_were_written) {
  const std::vector<std::pair<std::string, std::string>> axes = {
      {"shadow.resolution", "256,512"}, {"ao.radius", "0.1:1:9:log"}, {"shadow.constant-bias", "0:0.2:129"}};
  Sample sample;
  EXPECT_EQ(load(to_toml("s", describe(sample), axes)).file.axes, axes);
}

TEST(Experiment, A_part_of_a_file_is_enough) {
  const Loaded loaded = load("[shadow]\nresolution = 512\n");
  EXPECT_EQ(loaded.error.code(), ExitCode::ok);
  EXPECT_EQ(loaded.file.scene, "");
  ASSERT_EQ(loaded.file.values.size(), 1u);
  EXPECT_EQ(loaded.file.values[0].first, "shadow.resolution");
  EXPECT_EQ(std::get<std::int64_t>(loaded.file.values[0].second), 512);
  EXPECT_EQ(load("").error.code(), ExitCode::ok);
}

TEST(Experiment, Wrong_files_are_usage_errors_with_file_and_line) {
  const struct {
    const char* text;
    const char* place;
  } cases[] = {{"scene = \n", ":1"},
               {"scene = \"a\"\n[shadow\n", ":2"},
               {"scene = 3\n", ":1"},
               {"\n\nresolution = 3\n", ":3"},
               {"[shadow]\nresolution = [1, 2]\n", ":2"},
               {"[shadow]\nresolution = 1979-05-27\n", ":2"},
               {"[shadow]\nbias = 1\nbias = 2\n", ":3"},
               {"[vary]\n\"shadow.constant-bias\" = 3\n", ":2"},
               {"[shadow]\n[shadow.deeper]\nx = 1\n", ":2"}};
  for (const auto& each : cases) {
    const Loaded loaded = load(each.text);
    EXPECT_EQ(loaded.error.code(), ExitCode::usage) << each.text;
    EXPECT_TRUE(contains(loaded.error.what(), std::string("experiment.toml") + each.place))
        << each.text << loaded.error.what();
  }
}

TEST(Experiment, A_file_of_rubbish_is_a_usage_error) {
  EXPECT_EQ(load(std::string("\xFF\xFE\x00\x01", 4)).error.code(), ExitCode::usage);
  EXPECT_EQ(load("[[[[[[").error.code(), ExitCode::usage);
  EXPECT_EQ(load("a = " + std::string(100000, '[')).error.code(), ExitCode::usage);
}

TEST(Experiment, Names_of_very_many_parts_are_usage_errors) {
  std::string parts = "a";
  for (int i = 0; i < 40'000; ++i) parts += ".a";
  for (const std::string& text :
       {"[" + parts + "]\n", parts + " = 1\n", "b = {" + parts + " = 1}\n", "b = [\n{" + parts + " = 1}]\n",
        "s = \"\"\"a\"\"\"\"\nb = {s = \x27\x27\x27x\x27\x27\x27\x27, " + parts + " = 1}\n"}) {
    const Loaded loaded = load("\n" + text);
    EXPECT_EQ(loaded.error.code(), ExitCode::usage) << text.substr(0, 20);
    EXPECT_TRUE(contains(loaded.error.what(), "more than 256 levels deep")) << loaded.error.what();
  }
  // 200 nested brackets, each with a name of 200 parts: 200 times 200 levels.
  std::string nested;
  for (int i = 0; i < 200; ++i) nested.append("{").append(parts, 0, 399).append(" = ");
  nested += "1" + std::string(200, '}');
  EXPECT_TRUE(contains(load("b = " + nested).error.what(), "more than 256 levels deep"));
}

TEST(Experiment, Dots_in_texts_comments_and_numbers_are_no_levels) {
  const std::string dots(1000, '.');
  std::string comments;
  for (int i = 0; i < 1000; ++i) comments += "# 0.5.\n";
  const Loaded loaded = load("scene = \"" + dots + "\\\"" + dots + "\"\n" + comments +
                             "[vary]\n\"shadow.slope-bias\" = '" + dots + "'\n");
  EXPECT_EQ(loaded.error.code(), ExitCode::ok) << loaded.error.what();
  EXPECT_EQ(loaded.file.scene.size(), 2001u);
}

TEST(Experiment, A_file_that_cannot_be_read_is_unreadable_input) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder / "absent.toml", folder.path()}) {
    try {
      read_experiment(path);
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::unreadable_input);
      EXPECT_TRUE(contains(error.what(), path.string())) << error.what();
    }
  }
}

}  // namespace
}  // namespace umbrameter
