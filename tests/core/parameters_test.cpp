#include "core/parameters.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"

namespace umbrameter {
namespace {

enum class Flavor : int { plain, sweet };
constexpr std::array<std::string_view, 2> flavor_names = {"plain", "sweet"};

struct Sample {
  bool on = false;
  int count = 3;
  double width = 0.25;
  std::string name;
  Size size;
  Flavor flavor = Flavor::plain;
};

Parameters describe(Sample& s) {
  return Description("sample")
      .field("on", s.on, {"", "a switch"})
      .field("count", s.count, {"texels", "a count", 1, 9, false, true})
      .field("width", s.width, {"m", "a width", 0.0, 10.0})
      .field("name", s.name, {"", "a name"})
      .field("size", s.size, {"px", "a size", 1, 100})
      .choice("flavor", s.flavor, flavor_names, {"", "a choice"})
      .take();
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "no error";
}

TEST(Parameters, A_length_is_read_in_its_unit_and_written_so_that_it_reads_back) {
  struct Case {
    const char* text;
    Length length;
    const char* written;
  };
  for (const Case& c :
       {Case{"0.02", {0.02}, "0.02"}, Case{"2cm", {0.02}, "0.02"}, Case{"3 mm", {0.003}, "0.003"},
        Case{"-7cm", {-0.07}, "-0.07"}, Case{"1.5m", {1.5}, "1.5"}, Case{"2km", {2000.0}, "2000"},
        Case{"1inch", {0.0254}, "0.0254"}, Case{"10ft", {3.048}, "3.048"},
        Case{"1.5texels", {1.5, LengthUnit::texels}, "1.5texels"},
        Case{"1 texel", {1.0, LengthUnit::texels}, "1texels"}, Case{"7%", {7.0, LengthUnit::scene_percent}, "7%"},
        Case{"auto", {0.0, LengthUnit::automatic}, "auto"}}) {
    const auto length = parse_length(c.text);
    ASSERT_TRUE(length) << c.text;
    EXPECT_EQ(*length, c.length) << c.text;
    EXPECT_EQ(to_string(*length), c.written);
    EXPECT_EQ(parse_length(to_string(*length)), length);
  }
  for (const char* text : {"", "cm", "2 furlongs", "1.5 texelss", "nanm", "1,5cm", "2cm "}) {
    const auto length = parse_length(text);
    EXPECT_TRUE(!length || !std::isfinite(length->number)) << text;
  }
}

TEST(Parameters, A_length_takes_the_units_that_its_description_allows) {
  Length bias{1.5, LengthUnit::texels};
  const Parameters parameters =
      Description("a").field("bias", bias, {.unit = "m", .meaning = "", .min = -1, .units = {.texels = true}}).take();
  EXPECT_EQ(to_string(parameters[0].value()), "1.5texels");
  parameters[0].set_text("2cm");
  EXPECT_EQ(bias, Length{0.02});
  parameters[0].set(Value{0.5});  // a bare number, as in an experiment file, is metres
  EXPECT_EQ(bias, Length{0.5});
  for (const char* text : {"2%", "auto", "-2m", "-2texels", "nan", "infcm", "three"}) {
    const std::string message = message_of([&] { parameters[0].set_text(text); });
    EXPECT_NE(message.find("expected a length, at least -1 in m (2cm, 20mm), texels (1.5texels)"), std::string::npos)
        << message;
  }
  EXPECT_EQ(bias, Length{0.5});
}

TEST(Parameters, A_description_that_lacks_a_field_is_found_by_counting) {
  Sample sample;
  EXPECT_EQ(count_fields<Sample>(), 6);
  EXPECT_EQ(static_cast<int>(describe(sample).size()), count_fields<Sample>());
}

TEST(Parameters, Text_and_values_reach_the_field) {
  Sample sample;
  const Parameters parameters = describe(sample);
  require(parameters, "sample.on").set_text("true");
  require(parameters, "sample.count").set_text("5");
  require(parameters, "sample.width").set_text("1e-3");
  require(parameters, "sample.name").set_text("a b");
  require(parameters, "sample.size").set_text("64x32");
  require(parameters, "sample.flavor").set_text("sweet");
  EXPECT_TRUE(sample.on);
  EXPECT_EQ(sample.count, 5);
  EXPECT_EQ(sample.width, 0.001);
  EXPECT_EQ(sample.name, "a b");
  EXPECT_EQ(sample.size, (Size{64, 32}));
  EXPECT_EQ(sample.flavor, Flavor::sweet);
}

TEST(Parameters, Every_value_survives_text_and_back) {
  Sample sample{true, 7, 0.1 + 0.2, "x", {17, 19}, Flavor::sweet};
  Sample copy;
  const Parameters from = describe(sample);
  const Parameters to = describe(copy);
  for (std::size_t i = 0; i < from.size(); ++i) to[i].set_text(to_string(from[i].value()));
  EXPECT_EQ(copy.width, 0.1 + 0.2);
  for (std::size_t i = 0; i < from.size(); ++i) EXPECT_EQ(from[i].value(), to[i].value());
}

TEST(Parameters, A_value_out_of_range_names_the_key_and_its_limits) {
  Sample sample;
  const Parameters parameters = describe(sample);
  const std::string message = message_of([&] { require(parameters, "sample.width").set_text("10.5"); });
  EXPECT_EQ(message, "sample.width: '10.5' is not allowed; expected a number from 0 to 10, in m");
  EXPECT_EQ(sample.width, 0.25) << "a refused value changes nothing";
}

TEST(Parameters, What_is_no_value_of_the_kind_is_refused) {
  Sample sample;
  const Parameters parameters = describe(sample);
  const auto refused = [&](const char* key, const char* text) {
    return message_of([&] { require(parameters, key).set_text(text); }) != "no error";
  };
  EXPECT_TRUE(refused("sample.count", "4")) << "must be odd";
  EXPECT_TRUE(refused("sample.count", "3.5"));
  EXPECT_TRUE(refused("sample.count", "99999999999999999999"));
  EXPECT_TRUE(refused("sample.count", ""));
  EXPECT_TRUE(refused("sample.width", "nan"));
  EXPECT_TRUE(refused("sample.width", "inf"));
  EXPECT_TRUE(refused("sample.width", "1.0m"));
  EXPECT_TRUE(refused("sample.on", "perhaps"));
  EXPECT_TRUE(refused("sample.size", "64"));
  EXPECT_TRUE(refused("sample.size", "0x64"));
  EXPECT_TRUE(refused("sample.size", "64x101"));
  EXPECT_TRUE(refused("sample.flavor", "sour"));
  EXPECT_THROW(require(parameters, "sample.width").set(true), Error);
  EXPECT_THROW(require(parameters, "sample.width").set(std::numeric_limits<double>::quiet_NaN()), Error);
}

TEST(Parameters, An_unknown_key_suggests_the_nearest) {
  Sample sample;
  const Parameters parameters = describe(sample);
  EXPECT_EQ(message_of([&] { require(parameters, "sample.widht"); }),
            "sample.widht: unknown parameter; did you mean 'sample.width'?");
  EXPECT_EQ(find(parameters, "sample.widht"), nullptr);
}

TEST(Parameters, Shader_defines_hold_numbers_truths_and_choices) {
  Sample sample;
  sample.width = 2.0;
  EXPECT_EQ(shader_defines(describe(sample)),
            "#define SAMPLE_ON 0\n#define SAMPLE_COUNT 3\n#define SAMPLE_WIDTH 2.0\n#define SAMPLE_FLAVOR 0\n"
            "#define SAMPLE_FLAVOR_PLAIN 0\n#define SAMPLE_FLAVOR_SWEET 1\n");
}

TEST(Parameters, An_alias_of_a_choice_sets_the_name_that_it_means) {
  Sample sample;
  Parameters parameters = Description("sample")
                              .choice("flavor", sample.flavor, flavor_names,
                                      {.unit = {}, .meaning = "a choice", .aliases = {{"sugary", "sweet"}}})
                              .take();
  require(parameters, "sample.flavor").set_text("sugary");
  EXPECT_EQ(sample.flavor, Flavor::sweet);
  EXPECT_EQ(to_string(parameters.front().value()), "sweet") << "what is stored is the name";
  EXPECT_EQ(parameters.front().limits(), "plain or sweet; sugary is accepted for sweet");
}

}  // namespace
}  // namespace umbrameter
