#include "reports/page/page_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "reports/files/png.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Beyond this a browser is quicker with the pixels than with the drawing.
constexpr std::size_t largest_inline_svg = 12u << 20;

constexpr int least_columns = 640;  // of a reduced image

bool is_file_stem(std::string_view stem) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  return !stem.empty() && stem.front() != '.' && std::ranges::all_of(stem, fits);
}

Image<glm::u8vec3> reduced(const Image<glm::u16vec4>& image, int n) {
  Image<glm::u8vec3> result(image.width / n, image.height / n);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      glm::ivec3 sum(0);
      for (int k = 0; k < n * n; ++k) sum += glm::ivec3(image.at(n * x + k % n, n * y + k / n)) / 257;
      result.at(x, y) = glm::u8vec3((sum + n * n / 2) / (n * n));
    }
  }
  return result;
}

}  // namespace

std::string with_reduced_images(std::string_view drawing) {
  static constexpr std::string_view start = "data:image/png;base64,";
  std::string result;
  for (;;) {
    const std::size_t begin = drawing.find(start);
    if (begin == std::string_view::npos) return result + std::string(drawing);
    const std::size_t end = std::min(drawing.size(), drawing.find('"', begin));
    const std::string png = from_base64(std::string(drawing.substr(begin + start.size(), end - begin - start.size())));
    const PngHeader header = png_header(png);
    const int n = std::min(header.width / least_columns, header.height);
    result += drawing.substr(0, begin);
    result += n > 1 ? data_uri("image/png", to_png(reduced(from_png(png), n)))
                    : std::string(drawing.substr(begin, end - begin));
    drawing.remove_prefix(end);
  }
}

std::string inline_svg(std::string_view document, std::string_view id_prefix) {
  const std::size_t begin = document.find("<svg");
  const std::size_t end = document.rfind("</svg>");
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return {};
  document = document.substr(begin, end + 6 - begin);
  if (document.find("<script") != std::string_view::npos) return {};
  static constexpr std::string_view references[] = {" id=\"", "url(#", "href=\"#"};
  std::string result;
  result.reserve(document.size() + 1024);
  bool in_tag = false;
  while (!document.empty()) {
    if (document[0] == '<' || document[0] == '>') in_tag = document[0] == '<';
    std::size_t length = 1;
    bool is_reference = false;
    for (const std::string_view reference : references) {
      if (!in_tag || !document.starts_with(reference)) continue;
      length = reference.size();
      is_reference = true;
    }
    result += document.substr(0, length);
    if (is_reference) result += id_prefix;
    document.remove_prefix(length);
  }
  return result;
}

Json figure_files(const fs::path& folder, const std::string& stem) {
  static constexpr std::pair<const char*, const char*> kinds[] = {{".svg", "SVG"}, {".pdf", "PDF"}, {".png", "PNG"}};
  Json files = Json::array();
  for (const auto& [extension, kind] : kinds) {
    std::error_code error;
    if (!is_file_stem(stem) || !fs::is_regular_file(folder / "figures" / (stem + extension), error)) continue;
    files.push_back({{"name", stem + extension}, {"kind", kind}, {"stem", stem}});
  }
  return files;
}

void add_picture(Json& figure, const fs::path& folder) {
  std::string drawing;
  std::string png;
  if (const std::string stem = figure["stem"]; is_file_stem(stem)) {
    const fs::path base = folder / "figures" / stem;
    const std::string id_prefix = fmt::format("f{}-", figure["number"].dump());
    drawing = inline_svg(text_of_file(fs::path(base).concat(".svg")).value_or(""), id_prefix);
    if (drawing.empty() || drawing.size() > largest_inline_svg)
      png = text_of_file(fs::path(base).concat(".png")).value_or("");
  }
  if (!png.empty()) {
    figure["pixels"] = data_uri("image/png", png);
  } else if (!drawing.empty()) {
    figure["drawing"] = std::move(drawing);
  } else {
    figure["missing"] = true;
  }
}

}  // namespace umbrameter
