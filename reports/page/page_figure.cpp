#include "reports/page/page_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <optional>

#include "reports/files/markup.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

// Beyond this a browser is quicker with the pixels than with the drawing.
constexpr std::size_t largest_inline_svg = 12u << 20;

bool is_file_stem(std::string_view stem) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  return !stem.empty() && stem.front() != '.' && std::all_of(stem.begin(), stem.end(), fits);
}

std::optional<std::string> read_file(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
  if (error || size == 0) return std::nullopt;
  std::string bytes(size, '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) return std::nullopt;
  return bytes;
}

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

// The picture's element, or nothing when there is neither a drawing nor pixels.
std::string picture_markup(const fs::path& base, const std::string& alternative, std::string_view id_prefix) {
  const auto with_extension = [&](const char* extension) { return fs::path(base).concat(extension); };
  const std::optional<std::string> svg = read_file(with_extension(".svg"));
  std::string drawing = svg ? inline_svg(*svg, id_prefix) : std::string();
  if (drawing.empty() || drawing.size() > largest_inline_svg) {
    const std::optional<std::string> png = read_file(with_extension(".png"));
    if (png) {
      return fmt::format("<div class=\"picture\"><img alt=\"{}\" src=\"data:image/png;base64,{}\"></div>\n",
                         alternative, to_base64(*png));
    }
  }
  if (drawing.empty()) return {};
  return fmt::format("<div class=\"picture\" role=\"img\" aria-label=\"{}\">{}</div>\n", alternative, drawing);
}

std::string file_links(const fs::path& base, const std::string& stem) {
  std::string links;
  for (const char* extension : {"svg", "pdf", "png"}) {
    std::error_code error;
    if (!fs::is_regular_file(fs::path(base).concat(".").concat(extension), error)) continue;
    links += fmt::format("<li><a href=\"figures/{0}.{1}\">{2}<span class=\"hidden\"> of {0}</span></a></li>",
                         escape_markup(stem), extension,
                         extension == std::string_view("svg")   ? "SVG"
                         : extension == std::string_view("pdf") ? "PDF"
                                                                : "PNG");
  }
  return links.empty() ? links : "<ul class=\"files\">" + links + "</ul>\n";
}

}  // namespace

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
      if (!in_tag || !starts_with(document, reference)) continue;
      length = reference.size();
      is_reference = true;
    }
    result += document.substr(0, length);
    if (is_reference) result += id_prefix;
    document.remove_prefix(length);
  }
  return result;
}

std::string figure_markup(const fs::path& folder, const PageFigure& figure, std::string_view id_prefix) {
  const std::string title = escape_markup(figure.title);
  const std::string caption = escape_markup(figure.caption);
  std::string picture;
  std::string links;
  if (is_file_stem(figure.stem)) {
    const fs::path base = folder / "figures" / figure.stem;
    picture =
        picture_markup(base, title.empty() || caption.empty() ? title + caption : title + ". " + caption, id_prefix);
    links = file_links(base, figure.stem);
  }
  std::string text = caption.empty() ? title : caption;
  if (picture.empty()) {
    picture = "<div class=\"picture\"><p class=\"missing\">This figure could not be drawn; see the notes.</p></div>\n";
    if (!title.empty() && !caption.empty()) text = title + ". " + caption;
  }
  return fmt::format("<figure>\n{}<figcaption><strong>Figure {}.</strong> {}\n{}</figcaption>\n</figure>\n", picture,
                     figure.number, text, links);
}

}  // namespace umbrameter
