#include "reports/figures/pdf_images.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "reports/figures/svg_drawing.h"

namespace umbrameter {
namespace {

const DeflatedImage& pixel() {
  static const DeflatedImage image(Image<glm::u8vec3>(1, 1));
  return image;
}

std::string page() {
  return SvgDrawing("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"8\" height=\"4\"/>").to_pdf();
}

TEST(PdfImages, Without_images_the_objects_are_put_in_order_and_no_more) {
  const std::string ordered = with_images(page(), {});
  EXPECT_EQ(ordered.size(), page().size());
  EXPECT_EQ(with_images(ordered, {}), ordered);
}

TEST(PdfImages, An_image_without_its_marker_is_an_error) { EXPECT_THROW(with_images(page(), {&pixel()}), Error); }

TEST(PdfImages, What_has_no_table_of_references_is_refused) {
  for (const std::string pdf :
       {"", "startxref", "startxref\n", "startxref\nx", "startxref\n9999\n", "startxref\n0\n", "xref\nstartxref\n0\n",
        "xref\n0 5\ntrailer\nstartxref\n0\n%%EOF\n", "xref\n0 99999999999999999999\ntrailer\nstartxref\n0\n",
        "xref\n0 1000000000000000000\ntrailer\nstartxref\n0\n",
        "xref\n0 2\n0000000000 65535 f \n0000000900 00000 n \ntrailer\n<<>>\nstartxref\n0\n%%EOF\n"}) {
    EXPECT_THROW(with_images(pdf, {}), Error) << pdf;
  }
}

TEST(PdfImages, A_page_that_is_cut_off_is_refused) {
  const std::string pdf = page();
  for (std::size_t length = 0; length + 20 < pdf.size(); ++length) {
    EXPECT_THROW(with_images(pdf.substr(0, length), {&pixel()}), Error) << length;
  }
}

}  // namespace
}  // namespace umbrameter
