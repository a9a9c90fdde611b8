#include "reports/files/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

Image<float> noise(int width, int height, std::uint32_t seed) {
  Image<float> image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = to_unit_float(hash(static_cast<std::uint32_t>(i), seed)) * 200.0f - 100.0f;
  }
  return image;
}

LayeredImage sample(int width, int height) {
  LayeredImage image;
  add_layer(image, "truth_ao", noise(width, height, 1));
  Image<vec3> positions(width, height);
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = vec3(1.0f, 2.0f, 3.0f) * static_cast<float>(i);
  add_layer(image, "gbuffer_position", positions);
  image.channels.push_back({"Z", noise(width, height, 2)});
  image.attributes = {{"scene", "courtyard \"α\""}, {"version", "0.1.0"}};
  return image;
}

const Image<float>& channel(const LayeredImage& image, const std::string& name) {
  for (const Channel& each : image.channels) {
    if (each.name == name) return each.values;
  }
  throw std::runtime_error("no channel " + name);
}

ExitCode code_of_reading(const fs::path& path) {
  try {
    read_exr(path);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    return error.code();
  }
  return ExitCode::ok;
}

TEST(Exr, Every_bit_comes_back) {
  const TemporaryFolder folder;
  LayeredImage image = sample(37, 23);
  const float special[] = {0.0f,
                           -0.0f,
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::denorm_min(),
                           std::numeric_limits<float>::max(),
                           std::numeric_limits<float>::quiet_NaN()};
  for (std::size_t i = 0; i < std::size(special); ++i) image.channels[0].values[i] = special[i];
  write_exr(folder / "a.exr", image);
  const LayeredImage read = read_exr(folder / "a.exr");
  ASSERT_EQ(read.channels.size(), image.channels.size());
  for (const Channel& each : image.channels) {
    const Image<float>& values = channel(read, each.name);
    ASSERT_EQ(values.width, 37);
    ASSERT_EQ(values.height, 23);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(values[i]), std::bit_cast<std::uint32_t>(each.values[i])) << each.name;
    }
  }
  EXPECT_EQ(read.attributes, image.attributes);
}

TEST(Exr, Layers_are_named_with_one_dot) {
  LayeredImage image;
  add_layer(image, "class_sun", Image<float>(1, 1));
  add_layer(image, "gbuffer_normal", Image<vec3>(1, 1, vec3(4.0f, 5.0f, 6.0f)));
  ASSERT_EQ(image.channels.size(), 4u);
  EXPECT_EQ(image.channels[0].name, "class_sun.Y");
  EXPECT_EQ(channel(image, "gbuffer_normal.X")[0], 4.0f);
  EXPECT_EQ(channel(image, "gbuffer_normal.Y")[0], 5.0f);
  EXPECT_EQ(channel(image, "gbuffer_normal.Z")[0], 6.0f);
}

TEST(Exr, The_file_holds_uncut_floats_without_loss_under_the_given_names) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample(8, 4));
  const Imf::InputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  std::vector<std::string> names;
  for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
    names.emplace_back(c.name());
    EXPECT_EQ(c.channel().type, Imf::FLOAT) << c.name();
  }
  const std::vector<std::string> expected = {"Z", "gbuffer_position.X", "gbuffer_position.Y", "gbuffer_position.Z",
                                             "truth_ao.Y"};
  EXPECT_EQ(names, expected);
  ASSERT_NE(file.header().findTypedAttribute<Imf::StringAttribute>("umbrameter.scene"), nullptr);
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("umbrameter.scene").value(), "courtyard \"α\"");
}

// OpenEXR multiplies row vectors: a translation stands in the last row (Imath, M44f::translate).
TEST(Exr, View_matrices_are_stored_for_row_vectors) {
  const TemporaryFolder folder;
  LayeredImage image = sample(2, 2);
  image.world_to_camera[3] = vec4(1.0f, 2.0f, 3.0f, 1.0f);  // moves by (1, 2, 3)
  image.world_to_ndc[1] = vec4(0.0f, 5.0f, 0.0f, 7.0f);     // y' = 5 y, w' = w + 7 y
  write_exr(folder / "a.exr", image);
  const Imf::InputFile file((folder / "a.exr").c_str());
  ASSERT_TRUE(Imf::hasWorldToCamera(file.header()) && Imf::hasWorldToNDC(file.header()));
  const Imath::V3f moved = Imath::V3f(10.0f, 20.0f, 30.0f) * Imf::worldToCamera(file.header());
  EXPECT_EQ(moved, Imath::V3f(11.0f, 22.0f, 33.0f));
  EXPECT_EQ(Imf::worldToNDC(file.header())[1][1], 5.0f);
  EXPECT_EQ(Imf::worldToNDC(file.header())[1][3], 7.0f);
  const LayeredImage read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.world_to_camera, image.world_to_camera);
  EXPECT_EQ(read.world_to_ndc, image.world_to_ndc);
}

TEST(Exr, Equal_images_are_equal_files_whatever_the_number_of_threads) {
  const TemporaryFolder folder;
  const int before = Imf::globalThreadCount();
  Imf::setGlobalThreadCount(0);
  write_exr(folder / "a.exr", sample(200, 150));
  Imf::setGlobalThreadCount(4);
  write_exr(folder / "b.exr", sample(200, 150));
  Imf::setGlobalThreadCount(before);
  EXPECT_TRUE(text_of(folder / "a.exr") == text_of(folder / "b.exr"));
}

TEST(Exr, What_cannot_be_written_is_refused_and_leaves_nothing) {
  const TemporaryFolder folder;
  LayeredImage mixed = sample(4, 4);
  mixed.channels.push_back({"odd.Y", Image<float>(4, 5)});
  LayeredImage two_dots = sample(4, 4);
  two_dots.channels[0].name = "a.b.Y";
  LayeredImage twice = sample(4, 4);
  twice.channels.push_back(twice.channels[0]);
  LayeredImage unnamed = sample(4, 4);
  unnamed.channels[0].name.clear();
  for (const LayeredImage& image : {LayeredImage(), sample(0, 0), mixed, two_dots, twice, unnamed}) {
    EXPECT_THROW(write_exr(folder / "a.exr", image), Error);
  }
  EXPECT_EQ(count_files(folder.path()), 0u);
}

TEST(Exr, A_place_that_cannot_be_written_is_an_error_that_names_it) {
  const TemporaryFolder folder;
  try {
    write_exr(folder / "none/a.exr", sample(2, 2));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::partial);
    EXPECT_NE(std::string(error.what()).find((folder / "none/a.exr").string()), std::string::npos) << error.what();
  }
}

TEST(Exr, What_is_no_exr_file_is_unreadable_input) {
  const TemporaryFolder folder;
  put_text(folder / "empty.exr", "");
  put_text(folder / "text.exr", "this is no image at all, but long enough to look at");
  EXPECT_EQ(code_of_reading(folder / "absent.exr"), ExitCode::unreadable_input);
  EXPECT_EQ(code_of_reading(folder.path()), ExitCode::unreadable_input);
  EXPECT_EQ(code_of_reading(folder / "empty.exr"), ExitCode::unreadable_input);
  EXPECT_EQ(code_of_reading(folder / "text.exr"), ExitCode::unreadable_input);
}

TEST(Exr, A_file_cut_short_anywhere_is_unreadable_input) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample(40, 40));
  const std::string whole = text_of(folder / "a.exr");
  for (std::size_t share = 1; share < 20; ++share) {
    put_text(folder / "cut.exr", whole.substr(0, whole.size() * share / 20));
    EXPECT_EQ(code_of_reading(folder / "cut.exr"), ExitCode::unreadable_input) << share;
  }
}

TEST(Exr, A_damaged_header_is_read_or_refused_but_never_worse) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", sample(5, 5));
  const std::string whole = text_of(folder / "a.exr");
  int refused = 0;
  for (std::size_t i = 0; i < 700 && i < whole.size(); i += 3) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(hash(static_cast<std::uint32_t>(i)));
    put_text(folder / "damaged.exr", damaged);
    const ExitCode code = code_of_reading(folder / "damaged.exr");
    EXPECT_TRUE(code == ExitCode::ok || code == ExitCode::unreadable_input) << i;
    refused += code == ExitCode::ok ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace umbrameter
