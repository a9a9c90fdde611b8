#include "reports/files/image_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "reports/files/exr.h"
#include "reports/files/float_formats.h"
#include "reports/files/png.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

std::string error_of(const std::filesystem::path& path, ExitCode code, const std::string& layer = {}) {
  try {
    read_color_image(path, layer);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << path << " was read";
  return {};
}

std::string float_bytes(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

TEST(ImageFile, A_pfm_stores_the_bottom_row_first) {
  const Image<vec3> image = from_pfm("PF\n1 2\n-1.0\n" + float_bytes({1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}));
  EXPECT_EQ(image.at(0, 0), vec3(4.0f, 5.0f, 6.0f));
  EXPECT_EQ(image.at(0, 1), vec3(1.0f, 2.0f, 3.0f));
  const Image<vec3> big_endian = from_pfm(std::string("Pf\n1 1\n1.0\n\x3f\x80\x00\x00", 15));
  EXPECT_EQ(big_endian.at(0, 0), vec3(1.0f));
}

TEST(ImageFile, Radiance_pixels_are_mantissas_with_one_exponent) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X ";
  // Exponent 129 is a scale of 2^(129 − 136) = 1/128.
  EXPECT_EQ(from_radiance(header + "1\n" + "\x80\x40\x20\x81").at(0, 0), vec3(1.0f, 0.5f, 0.25f));
  // Eight pixels, run-length encoded: red is one run, green eight different bytes, blue and exponent one run each.
  const std::string encoded = std::string("\x02\x02\x00\x08", 4) + "\x88\x80" + "\x08\x01\x02\x03\x04\x05\x06\x07\x08" +
                              "\x88\x40" + "\x88\x81";
  const Image<vec3> image = from_radiance(header + "8\n" + encoded);
  EXPECT_EQ(image.at(7, 0), vec3(1.0f, 8.0f / 128.0f, 0.5f));
  EXPECT_EQ(image.at(0, 0), vec3(1.0f, 1.0f / 128.0f, 0.5f));
}

TEST(ImageFile, Truncated_and_damaged_files_are_unreadable) {
  const TemporaryFolder folder;
  const std::string header = "#?RADIANCE\n\n-Y 1 +X 8\n";
  EXPECT_NE(error_of(folder.write("a.hdr", header + "\x02\x02"), ExitCode::unreadable_input).find("truncated"),
            std::string::npos);
  EXPECT_NE(
      error_of(folder.write("b.hdr", header + std::string("\x02\x02\x00\x08\x89\x01", 6)), ExitCode::unreadable_input)
          .find("run"),
      std::string::npos);
  EXPECT_NE(error_of(folder.write("c.hdr", "#?RADIANCE\n\n-Y 900000 +X 900000\n"), ExitCode::unreadable_input)
                .find("truncated"),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("d.pfm", "PF\n9 9\n-1\nx"), ExitCode::unreadable_input).find("truncated"),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("e.pfm", "PF\n0 9\n-1\n"), ExitCode::unreadable_input).find("size"),
            std::string::npos);
  error_of(folder.write("f.png", "\x89PNG\r\n\x1a\n"), ExitCode::unreadable_input);
  error_of(folder.write("g.txt", "hello"), ExitCode::unreadable_input);
  error_of(folder / "missing.png", ExitCode::unreadable_input);
  error_of(folder.path(), ExitCode::unreadable_input);
}

TEST(ImageFile, A_png_is_srgb) {
  const TemporaryFolder folder;
  const ColorImage image = read_color_image(folder.write("a.png", to_png({2, 1, {188, 0, 255}})));
  EXPECT_TRUE(image.is_display);
  EXPECT_NEAR(image.linear.at(1, 0).r, 0.50289, 1e-5);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(image.linear.at(1, 0).g, 0.0f);
  EXPECT_EQ(image.linear.at(1, 0).b, 1.0f);
}

TEST(ImageFile, Layers_of_an_exr_are_selected_by_name) {
  const TemporaryFolder folder;
  LayeredImage file;
  add_layer(file, "truth_ao", Image<float>(2, 1, 0.5f));
  add_layer(file, "gbuffer_normal", Image<vec3>(2, 1, vec3(0.0f, 1.0f, 0.0f)));
  write_exr(folder / "a.exr", file);
  EXPECT_EQ(read_color_image(folder / "a.exr", "truth_ao").linear.at(0, 0), vec3(0.5f));
  EXPECT_TRUE(read_color_image(folder / "a.exr", "truth_ao.Y").is_scalar);
  EXPECT_EQ(read_color_image(folder / "a.exr", "gbuffer_normal").linear.at(0, 0), vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(read_color_image(folder / "a.exr", "gbuffer_normal.Y").linear.at(0, 0), vec3(1.0f));
  const std::string error = error_of(folder / "a.exr", ExitCode::usage, "truth");
  EXPECT_NE(error.find("truth_ao.Y"), std::string::npos) << error;
  error_of(folder / "a.exr", ExitCode::usage);  // two layers, none selected
}

}  // namespace
}  // namespace umbrameter
