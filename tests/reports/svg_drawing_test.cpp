#include "reports/figures/svg_drawing.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/error.h"
#include "reports/files/markup.h"
#include "tests/support/temporary_folder.h"

namespace umbrameter {
namespace {

const glm::u8vec3 red(255, 0, 0);
const glm::u8vec3 white(255, 255, 255);

std::string svg_of(const std::string& size, const std::string& content) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" " + size + ">" +
         content + "</svg>";
}

// Red on the left half of 8 × 4 units.
std::string half_red(const std::string& size) {
  return svg_of(size + " viewBox=\"0 0 8 4\"", "<rect width=\"4\" height=\"4\" fill=\"#ff0000\"/>");
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(SvgDrawing, Is_drawn_on_white_pixel_by_pixel) {
  const Image<glm::u8vec3> image = SvgDrawing(half_red("width=\"8\" height=\"4\"")).pixels(2.0);
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(image.at(x, y), x < 8 ? red : white) << x << ", " << y;
  }
}

// 96 pixels are an inch, 25.4 mm; a part of a pixel is one.
TEST(SvgDrawing, Has_its_size_in_millimetres) {
  const Image<glm::u8vec3> image = SvgDrawing(half_red("width=\"25.4mm\" height=\"12.8mm\"")).pixels(1.0);
  EXPECT_EQ(image.width, 96);
  EXPECT_EQ(image.height, 49);
  const std::string pdf = SvgDrawing(half_red("width=\"25.4mm\" height=\"12.7mm\"")).to_pdf();
  double width = 0.0;
  ASSERT_EQ(std::sscanf(pdf.c_str() + pdf.find("/MediaBox"), "/MediaBox [ 0 0 %lf", &width), 1);
  EXPECT_NEAR(width, 72.0, 1e-4) << "points of an inch";
}

TEST(SvgDrawing, Leaves_what_lies_below_where_it_draws_nothing) {
  Image<glm::u8vec3> image(16, 8, glm::u8vec3(1, 2, 3));
  SvgDrawing(half_red("width=\"8\" height=\"4\"")).draw_over(image);
  EXPECT_EQ(image.at(7, 0), red);
  EXPECT_EQ(image.at(8, 7), glm::u8vec3(1, 2, 3));
}

TEST(SvgDrawing, What_is_no_drawing_is_an_error_of_one_line) {
  for (const std::string& text : {std::string(), std::string("no drawing"), std::string("<svg"),
                                  std::string("<html></html>"), svg_of("width=\"0\" height=\"3\"", "")}) {
    try {
      const SvgDrawing drawing(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::partial) << text;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

TEST(SvgDrawing, Too_many_pixels_are_an_error_that_says_how_many) {
  try {
    SvgDrawing(half_red("width=\"20000\" height=\"10\"")).pixels(2.0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("40000×20"), std::string::npos) << error.what();
  }
}

TEST(SvgDrawing, Reads_no_file) {
  const TemporaryFolder folder;
  const std::string file = folder.write("red.png", to_png(Image<glm::u8vec3>(4, 4, red))).string();
  for (const std::string& link : {file, "file://" + file, std::string("http://127.0.0.1:9/red.png")}) {
    const std::string image = "<image width=\"4\" height=\"4\" xlink:href=\"" + link + "\"/>";
    EXPECT_EQ(SvgDrawing(svg_of("width=\"4\" height=\"4\"", image)).pixels(1.0).at(1, 1), white) << link;
  }
  const std::string data = data_uri("image/png", to_png(Image<glm::u8vec3>(4, 4, red)));
  const std::string image = "<image width=\"4\" height=\"4\" xlink:href=\"" + data + "\"/>";
  EXPECT_EQ(SvgDrawing(svg_of("width=\"4\" height=\"4\"", image)).pixels(1.0).at(1, 1), red) << "the link works";
}

// libxml2 refuses texts of more than 10 MB unless told otherwise.
TEST(SvgDrawing, May_hold_images_of_many_megabytes) {
  const std::string comment = "<desc>" + std::string(12u << 20u, 'x') + "</desc>";
  EXPECT_EQ(SvgDrawing(svg_of("width=\"4\" height=\"4\"", comment)).pixels(1.0).width, 4);
}

// The PDF's bytes of images are those of the PNG: here each is found, with its size, and at the end the table of
// references (ISO 32000-1, section 7.5.4), each of whose places holds the object of that number.
TEST(SvgDrawing, Pdf_holds_the_images_below_it_as_they_were_compressed) {
  const Image<glm::u8vec3> wide(40, 3, red);
  const Image<glm::u8vec3> high(5, 70, glm::u8vec3(9, 8, 7));
  const DeflatedImage first(wide), second(high);
  const SvgDrawing drawing(half_red("width=\"80\" height=\"40\""));
  const std::string pdf = drawing.to_pdf({{&first, {0, 0}, {4, 4}}, {&second, {4, 0}, {4, 4}}});
  EXPECT_NE(pdf.find("stream\n" + first.rows + "\nendstream"), std::string::npos);
  EXPECT_NE(pdf.find("stream\n" + second.rows + "\nendstream"), std::string::npos);
  EXPECT_EQ(count_of(pdf, "/Width 40 /Height 3 "), 1u);
  EXPECT_EQ(count_of(pdf, "/Width 5 /Height 70 "), 1u);
  EXPECT_EQ(count_of(pdf, "/Subtype /Image"), 2u) << "no marker is left";
  EXPECT_EQ(pdf.substr(pdf.size() - 6), "%%EOF\n");
  const std::size_t table = std::stoul(pdf.substr(pdf.rfind("startxref") + 10));
  ASSERT_EQ(pdf.substr(table, 7), "xref\n0 ");
  const std::size_t count = std::stoul(pdf.substr(table + 7));
  const std::size_t lines = pdf.find('\n', table + 5) + 1;
  ASSERT_EQ(pdf.substr(lines + 20 * count, 7), "trailer");
  for (std::size_t i = 1; i < count; ++i) {
    const std::string start = std::to_string(i) + " 0 obj";
    EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(lines + 20 * i, 10)), start.size()), start);
  }
}

TEST(SvgDrawing, Equal_drawings_are_equal_bytes) {
  const DeflatedImage image(Image<glm::u8vec3>(4, 4, red));
  const std::string text = svg_of("width=\"80\" height=\"40\"", "<text x=\"4\" y=\"30\">Text</text>");
  const std::string pdf = SvgDrawing(text).to_pdf({{&image, {0, 0}, {4, 4}}});
  EXPECT_TRUE(SvgDrawing(text).to_pdf({{&image, {0, 0}, {4, 4}}}) == pdf);
}

}  // namespace
}  // namespace umbrameter
