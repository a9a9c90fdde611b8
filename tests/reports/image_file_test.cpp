#include "reports/files/image_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "reports/files/exr.h"
#include "reports/files/float_formats.h"
#include "reports/files/png.h"
#include "tests/support/png_bytes.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

std::string error_of(const std::filesystem::path& path, ExitCode code, const std::string& layer = {}) {
  try {
    ImageFile(path).decode(layer);
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
  const ColorImage image = ImageFile(folder.write("a.png", to_png({2, 1, {188, 0, 255}}))).decode();
  EXPECT_TRUE(image.is_display);
  EXPECT_NEAR(image.linear.at(1, 0).r, 0.50289, 1e-5);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(image.linear.at(1, 0).g, 0.0f);
  EXPECT_EQ(image.linear.at(1, 0).b, 1.0f);
}

// One grey pixel of 16 bits.
std::string grey16(std::uint32_t code, const std::string& chunks = {}) {
  return png_bytes(1, 1, 16, 0, std::string(1, '\0') + big_endian(code, 2), chunks);
}

ColorImage decoded(const TemporaryFolder& folder, const std::string& png) {
  return ImageFile(folder.write("a.png", png)).decode();
}

TEST(ImageFile, A_png_without_a_colour_space_is_srgb_at_8_and_at_16_bits) {
  const TemporaryFolder folder;
  const ColorImage eight = decoded(folder, png_bytes(1, 1, 8, 0, std::string("\0\xbc", 2)));
  const ColorImage sixteen = decoded(folder, grey16(188 * 257));  // 188/255 = 48316/65535
  EXPECT_TRUE(sixteen.is_display);
  EXPECT_EQ(sixteen.linear.at(0, 0), eight.linear.at(0, 0));
  EXPECT_NEAR(sixteen.linear.at(0, 0).r, 0.50289, 1e-5);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(eight.encoding, "sRGB, assumed");
  EXPECT_EQ(sixteen.encoding, "sRGB, assumed");
  const ColorImage stated = decoded(folder, grey16(188 * 257, png_chunk("sRGB", std::string(1, '\0'))));
  EXPECT_EQ(stated.encoding, "sRGB");
  EXPECT_EQ(stated.linear.at(0, 0), eight.linear.at(0, 0));
}

TEST(ImageFile, The_gamma_that_a_png_states_is_used) {
  const TemporaryFolder folder;
  const auto with_gamma = [&](std::uint32_t gamma) {
    return decoded(folder, grey16(188 * 257, png_chunk("gAMA", big_endian(gamma))));
  };
  EXPECT_NEAR(with_gamma(100000).linear.at(0, 0).r, 188.0 / 255.0, 1e-6);
  EXPECT_EQ(with_gamma(100000).encoding, "gamma 1");
  EXPECT_NEAR(with_gamma(50000).linear.at(0, 0).r, 188.0 / 255.0 * 188.0 / 255.0, 1e-6);
  EXPECT_EQ(with_gamma(45455).encoding, "sRGB") << "what writers of sRGB state besides the chunk sRGB, or instead";
  EXPECT_NEAR(with_gamma(45455).linear.at(0, 0).r, 0.50289, 1e-5);
}

TEST(ImageFile, Sixteen_bits_of_a_png_are_not_cut_to_eight) {
  const TemporaryFolder folder;
  const float higher = decoded(folder, grey16(30001)).linear.at(0, 0).r;
  // The derivative of the sRGB curve: 2.4 ((c + 0.055) / 1.055)^1.4 / 1.055 / 65535 at c = 30000.5/65535 = 0.457778.
  EXPECT_NEAR(higher - decoded(folder, grey16(30000)).linear.at(0, 0).r, 1.2643e-5, 1e-7);
}

TEST(ImageFile, A_png_is_laid_over_white_in_linear_light) {
  const TemporaryFolder folder;
  // Black with an alpha of 128/255.
  const ColorImage image = decoded(folder, png_bytes(1, 1, 8, 4, std::string("\0\0\x80", 3)));
  EXPECT_NEAR(image.linear.at(0, 0).r, 127.0 / 255.0, 1e-6);
}

TEST(ImageFile, A_size_that_the_bytes_cannot_hold_is_refused_before_it_takes_memory) {
  const TemporaryFolder folder;
  const std::string png = png_bytes(60000, 60000, 8, 2, "");
  EXPECT_LT(png.size(), 80u);
  EXPECT_NE(error_of(folder.write("a.png", png), ExitCode::unreadable_input).find("60000x60000"), std::string::npos);
  EXPECT_NE(error_of(folder.write("b.hdr", "#?RADIANCE\n\n-Y 60000 +X 60000\n" + std::string(70'000, 'x')),
                     ExitCode::unreadable_input)
                .find("truncated"),
            std::string::npos);
  // The data window of an EXR file: its last pixel moves from 0 to 59999 in x and y.
  LayeredImage file;
  file.channels.push_back({"Y", Image<float>(1, 1, 0.5f)});
  write_exr(folder / "c.exr", file);
  std::string exr = text_of(folder / "c.exr");
  const std::size_t window = exr.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
  for (const std::size_t at : {window + 8, window + 12}) exr.replace(at, 4, std::string("\x5f\xea\0\0", 4));
  error_of(folder.write("d.exr", exr), ExitCode::unreadable_input);
}

TEST(ImageFile, More_pixels_than_the_largest_size_of_the_program_are_refused) {
  const TemporaryFolder folder;
  const std::string rows(16384 * (1 + 2049), '\0');  // of 16385 pixels of 1 bit
  EXPECT_NE(error_of(folder.write("a.png", png_bytes(16385, 16384, 1, 0, rows)), ExitCode::unreadable_input)
                .find("more than 16384x16384 pixels"),
            std::string::npos);
}

TEST(ImageFile, Any_cut_and_any_flipped_bit_gives_an_image_or_an_error) {
  const TemporaryFolder folder;
  LayeredImage file;
  add_layer(file, "a", Image<vec3>(9, 7, vec3(0.25f)));
  write_exr(folder / "a.exr", file);
  const std::string alpha16 = png_bytes(3, 2, 16, 6, std::string(2 * (1 + 3 * 8), '\0'));
  for (const std::string& whole :
       {text_of(folder / "a.exr"), alpha16, to_png(Image<glm::u8vec3>(5, 4)),
        std::string("#?RADIANCE\n\n-Y 1 +X 1\n\x80\x40\x20\x81"), "PF\n1 1\n-1\n" + float_bytes({1, 2, 3})}) {
    for (std::size_t i = 0; i < 2 * whole.size(); ++i) {
      std::string bytes = whole.substr(0, i);
      if (i >= whole.size()) {
        bytes = whole;
        bytes[i - whole.size()] = static_cast<char>(bytes[i - whole.size()] ^ (1 << i % 8));
      }
      try {
        ImageFile(folder.write("b", bytes)).decode(bytes.starts_with("\x76\x2f") ? "a" : "");
      } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ExitCode::unreadable_input || error.code() == ExitCode::usage) << error.what();
      }
    }
  }
}

TEST(ImageFile, Layers_of_an_exr_are_selected_by_name) {
  const TemporaryFolder folder;
  LayeredImage file;
  add_layer(file, "truth_ao", Image<float>(2, 1, 0.5f));
  add_layer(file, "gbuffer_normal", Image<vec3>(2, 1, vec3(0.0f, 1.0f, 0.0f)));
  write_exr(folder / "a.exr", file);
  const ImageFile layers(folder / "a.exr");
  EXPECT_EQ(layers.width(), 2);
  EXPECT_EQ(layers.decode("truth_ao").linear.at(0, 0), vec3(0.5f));
  EXPECT_TRUE(layers.decode("truth_ao.Y").is_scalar);
  EXPECT_EQ(layers.decode("gbuffer_normal").linear.at(0, 0), vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(layers.decode("gbuffer_normal.Y").linear.at(0, 0), vec3(1.0f));
  const std::string error = error_of(folder / "a.exr", ExitCode::usage, "truth");
  EXPECT_NE(error.find("truth_ao.Y"), std::string::npos) << error;
  error_of(folder / "a.exr", ExitCode::usage);  // two layers, none selected
}

}  // namespace
}  // namespace umbrameter
