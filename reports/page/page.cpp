#include "reports/page/page.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "reports/page/page_figure.h"
#include "reports/page/page_style.h"
#include "reports/page/page_table.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

std::string bytes_of_hex(std::string_view digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    unsigned byte = 0;
    std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16);
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

// Nothing may be loaded, run, framed or sent: only this page's own style sheet, and pictures that stand in the page.
std::string head_markup(const Report& report) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'sha256-{}'; img-src "
      "data:; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<meta name=\"referrer\" content=\"no-referrer\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n",
      to_base64(bytes_of_hex(page_style_hash())), escape_markup(report.title), page_style());
}

std::string file_list(const fs::path& folder) {
  static constexpr std::pair<const char*, const char*> files[] = {{"images.exr", "all images as float layers"},
                                                                  {"sweep.csv", "all cells of the sweep"},
                                                                  {"experiment.toml", "settings of this run"},
                                                                  {"summary.json", "all numbers, for programs"}};
  std::string items;
  for (const auto& [name, meaning] : files) {
    std::error_code error;
    if (!fs::is_regular_file(folder / name, error)) continue;
    items += fmt::format("<li><a href=\"{0}\">{0}</a> <span>{1}</span></li>\n", name, meaning);
  }
  return items.empty() ? items : "<ul class=\"files\">\n" + items + "</ul>\n";
}

// A box of lines under a heading; kind is its class.
std::string lines_markup(const char* kind, const char* heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string items;
  for (const std::string& line : lines) items += "<li>" + escape_markup(line) + "</li>\n";
  return fmt::format("<aside class=\"{0}\">\n<h2>{1}</h2>\n<ul>\n{2}</ul>\n</aside>\n", kind, heading, items);
}

std::string contents_markup(const Report& report) {
  std::string items;
  for (std::size_t s = 0; s < report.sections.size(); ++s) {
    items += fmt::format("<li><a href=\"#section-{}\">{}</a></li>\n", s + 1, escape_markup(report.sections[s].title));
  }
  if (!report.settings.columns.empty()) items += "<li><a href=\"#settings\">Settings</a></li>\n";
  return items.empty() ? items : "<nav aria-label=\"Sections\">\n<ul>\n" + items + "</ul>\n</nav>\n";
}

std::string paragraphs(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find("\n\n");
    const std::string_view paragraph = text.substr(0, end);
    if (paragraph.find_first_not_of(" \n") != std::string_view::npos)
      result += "<p>" + escape_markup(paragraph) + "</p>\n";
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 2);
  }
  return result;
}

// "4.1 % [4.0, 4.2]": the interval is set smaller than the number.
std::string value_markup(const std::string& value) {
  const std::size_t interval = value.find(" [");
  if (interval == std::string::npos || value.back() != ']') return escape_markup(value);
  return fmt::format("{} <span class=\"interval\">{}</span>", escape_markup(value.substr(0, interval)),
                     escape_markup(value.substr(interval + 1)));
}

std::string headlines_markup(const std::vector<Headline>& headlines) {
  if (headlines.empty()) return {};
  std::string tiles;
  for (const Headline& headline : headlines) {
    tiles += fmt::format("<div><dt>{}</dt><dd class=\"value\">{}</dd>", escape_markup(headline.label),
                         value_markup(headline.value));
    if (!headline.note.empty()) tiles += "<dd class=\"note\">" + escape_markup(headline.note) + "</dd>";
    tiles += "</div>\n";
  }
  return "<dl class=\"headlines\">\n" + tiles + "</dl>\n";
}

// What has been numbered so far, from the top of the page.
struct Numbers {
  std::size_t sections = 0;
  std::size_t figures = 0;
  std::size_t tables = 0;
};

std::string figures_markup(const fs::path& folder, const ReportSection& section, Numbers& numbers) {
  if (section.figures.empty()) return {};
  const auto text_at = [](const std::vector<std::string>& texts, std::size_t i) {
    return i < texts.size() ? texts[i] : std::string();
  };
  std::string result = fmt::format("<div class=\"figures{}\">\n", section.figures.size() == 1 ? " single" : "");
  for (std::size_t f = 0; f < section.figures.size(); ++f) {
    const PageFigure figure{section.figures[f], text_at(section.figure_titles, f), text_at(section.captions, f),
                            ++numbers.figures};
    result += figure_markup(folder, figure, fmt::format("f{}-", numbers.figures));
  }
  return result + "</div>\n";
}

std::string section_markup(const fs::path& folder, const ReportSection& section, Numbers& numbers) {
  ++numbers.sections;
  std::string result = fmt::format("<section aria-labelledby=\"section-{0}\">\n<h2 id=\"section-{0}\">{1}</h2>\n",
                                   numbers.sections, escape_markup(section.title));
  result += headlines_markup(section.headlines) + paragraphs(section.text) + figures_markup(folder, section, numbers);
  for (const auto& [title, table] : section.tables) {
    if (table.columns.empty()) continue;
    result += table_markup(table, fmt::format("Table {}. {}", ++numbers.tables, title));
  }
  return result + "</section>\n";
}

std::string settings_markup(const Report& report) {
  if (report.settings.columns.empty()) return {};
  return "<section aria-labelledby=\"settings\">\n<h2 id=\"settings\">Settings</h2>\n" +
         table_markup(report.settings, "Every parameter of this run") + "</section>\n";
}

}  // namespace

void write_page(const fs::path& folder, const Report& report) {
  std::string page = head_markup(report);
  page += "<body>\n<div class=\"page\">\n<header>\n<h1>" + escape_markup(report.title) + "</h1>\n";
  if (!report.subtitle.empty()) page += "<p class=\"subtitle\">" + escape_markup(report.subtitle) + "</p>\n";
  page += file_list(folder) + contents_markup(report) + "</header>\n<main>\n" +
          lines_markup("answers", "Answer", report.answers) + lines_markup("notes", "Notes", report.notes);
  Numbers numbers;
  for (const ReportSection& section : report.sections) page += section_markup(folder, section, numbers);
  page += settings_markup(report);
  if (!report.command.empty()) {
    page += "<section aria-labelledby=\"repeat\">\n<h2 id=\"repeat\">Repeat this run</h2>\n<pre><code>" +
            escape_markup(report.command) + "</code></pre>\n</section>\n";
  }
  page +=
      "</main>\n<footer>\n<p>Made by Umbrameter. This page is self-contained: no scripts, no external files."
      "</p>\n</footer>\n</div>\n</body>\n</html>\n";
  write_text(folder / "index.html", page);
}

}  // namespace umbrameter
