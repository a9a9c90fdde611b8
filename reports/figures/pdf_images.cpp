#include "reports/figures/pdf_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr int marker_width = 2;
constexpr std::size_t first_marker_height = 2;  // an image of one pixel could become a rectangle

[[noreturn]] void refuse(const char* why) { throw Error(ExitCode::partial, "PDF", why); }

// The number after the text, which must be there.
std::size_t number_after(std::string_view text, std::string_view name) {
  const std::size_t begin = text.find(name);
  std::size_t number = 0;
  if (begin == std::string_view::npos) refuse("cairo wrote no table of references");
  text.remove_prefix(std::min(text.size(), begin + name.size()));
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(" \r\n")));
  if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc()) {
    refuse("cairo wrote no table of references");
  }
  return number;
}

// ISO 32000-1, section 7.5.4: "xref", first and count of the objects, then for each a line of 20 bytes that starts with
// its place in the file. Object 0 is none; cairo's objects have the numbers from 1 on.
struct References {
  std::size_t place = 0;             ///< of the table
  std::string_view trailer;          ///< the dictionary, with its name
  std::vector<std::size_t> objects;  ///< place of object i + 1; each ends where another or the table begins
};

References read_references(std::string_view pdf) {
  constexpr std::size_t line = 20;
  References references;
  references.place = number_after(pdf.substr(std::min(pdf.size(), pdf.rfind("startxref"))), "startxref");
  if (references.place > pdf.size()) refuse("cairo wrote no table of references");
  std::string_view table = pdf.substr(references.place);
  const std::size_t count = number_after(table, "xref\n0 ");
  const std::size_t trailer = table.find("trailer");
  if (trailer == std::string_view::npos || count < 1 || count > trailer / line) {
    refuse("cairo wrote no table of references");
  }
  references.trailer = table.substr(trailer, table.rfind("startxref") - trailer);
  for (std::size_t i = 1; i < count; ++i) {
    const std::size_t place = number_after(table.substr(trailer - (count - i) * line), "");
    if (place >= references.place) refuse("an object of cairo's stands behind the table of references");
    references.objects.push_back(place);
  }
  return references;
}

// The index of the image whose marker the object is; the number of images if it is none.
std::size_t image_of(std::string_view object, std::size_t images) {
  const std::string_view dictionary = object.substr(0, object.find("stream"));
  if (dictionary.find("/Subtype /Image") == std::string_view::npos) return images;
  const std::size_t height = number_after(dictionary, "/Height");
  if (number_after(dictionary, "/Width") != marker_width || height < first_marker_height) return images;
  return std::min(images, height - first_marker_height);
}

// ISO 32000-1, section 8.6.6.3: the last index, and the colours as a string.
std::string color_space(const DeflatedImage& image) {
  if (image.palette.empty()) return "/DeviceRGB";
  std::string colors;
  for (const char byte : image.palette) colors += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return fmt::format("[/Indexed /DeviceRGB {} <{}>]", image.palette.size() / 3 - 1, colors);
}

// Its rows are those of a PNG, which PDF knows as "predictor 15" (ISO 32000-1, section 7.4.4.4). /Interpolate is what
// cairo writes, too.
std::string image_object(std::size_t number, const DeflatedImage& image) {
  return fmt::format(
             "{} 0 obj\n<< /Type /XObject /Subtype /Image /Width {} /Height {} /ColorSpace {} "
             "/BitsPerComponent 8 /Interpolate true /Filter /FlateDecode /DecodeParms << /Predictor 15 /Colors {} "
             "/BitsPerComponent 8 /Columns {} >> /Length {} >>\nstream\n",
             number, image.width, image.height, color_space(image), image.palette.empty() ? 3 : 1, image.width,
             image.rows.size()) +
         image.rows + "\nendstream\nendobj\n";
}

}  // namespace

ivec2 marker_size(std::size_t index) { return {marker_width, static_cast<int>(index + first_marker_height)}; }

std::string with_images(std::string_view pdf, const std::vector<const DeflatedImage*>& images) {
  const References references = read_references(pdf);
  std::vector<std::size_t> places = references.objects;
  places.push_back(references.place);
  std::ranges::sort(places);
  std::string result(pdf.substr(0, places.front()));
  std::string table = fmt::format("xref\n0 {}\n0000000000 65535 f \n", references.objects.size() + 1);
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < references.objects.size(); ++i) {
    const std::size_t begin = references.objects[i];
    const std::size_t end = *std::upper_bound(places.begin(), places.end(), begin);
    const std::string_view object = pdf.substr(begin, end - begin);
    table += fmt::format("{:010} 00000 n \n", result.size());
    const std::size_t image = image_of(object, images.size());
    replaced += image < images.size();
    result += image < images.size() ? image_object(i + 1, *images[image]) : std::string(object);
  }
  if (replaced != images.size()) refuse("cairo did not draw each image once");
  const std::size_t place = result.size();
  return result + table + std::string(references.trailer) + fmt::format("startxref\n{}\n%%EOF\n", place);
}

}  // namespace umbrameter
