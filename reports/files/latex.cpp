#include "reports/files/latex.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/lists.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

// Longer ones first where one starts another. Brackets and stars are put in braces because the end of a row, \\, would
// read them as its option; hyphens because two of them become a dash.
constexpr std::array<std::pair<std::string_view, std::string_view>, 27> replacements = {{
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"_", "\\_"},
    {"%", "\\%"},
    {"&", "\\&"},
    {"#", "\\#"},
    {"$", "\\$"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"\"", "\\textquotedbl{}"},
    {"`", "\\textasciigrave{}"},
    {"[", "{[}"},
    {"]", "{]}"},
    {"*", "{*}"},
    {"--", "-{}-{}"},
    {"±", "$\\pm$"},
    {"−", "$-$"},
    {"×", "$\\times$"},
    {"·", "$\\cdot$"},
    {"²", "$^2$"},
    {"°", "$^\\circ$"},
    {"—", "---"},
    {"\xEF\xBF\xBD", "?"},
}};

std::string row_text(const std::vector<std::string>& cells) { return "  " + joined(cells, " & ") + " \\\\\n"; }

// A column whose texts begin like numbers is aligned as numbers.
bool is_number_text(const Value& value) {
  const std::string text = to_string(value);
  const std::string_view sign = "−";
  std::string_view rest = text;
  if (rest.starts_with('(')) rest.remove_prefix(1);
  if (rest.starts_with(sign)) rest.remove_prefix(sign.size());
  if (rest.starts_with('-') || rest.starts_with('+')) rest.remove_prefix(1);
  return text.empty() || text == "—" || (!rest.empty() && rest.front() >= '0' && rest.front() <= '9');
}

// A column of a two-column page holds about as many characters of ten points.
constexpr std::size_t most_characters = 45;

std::size_t width_of(const Table& table) {
  std::size_t width = 0;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::size_t widest = count_characters(table.columns[c].name);
    for (const std::vector<Value>& row : table.rows) widest = std::max(widest, count_characters(to_string(row[c])));
    width += widest;
  }
  return width;
}

}  // namespace

std::string escape_latex(std::string_view text) {
  const std::string plain = plain_text(text);
  std::string result;
  for (std::size_t i = 0; i < plain.size();) {
    const auto starts_here = [&](const auto& pair) {
      return std::string_view(plain).substr(i).starts_with(pair.first);
    };
    const auto found = std::ranges::find_if(replacements, starts_here);
    if (found == replacements.end()) {
      result += plain[i++];
    } else {
      result += found->second;
      i += found->first.size();
    }
  }
  return result;
}

std::string to_latex(const Table& table, std::string_view note) {
  std::string alignment;
  std::vector<std::string> names;
  std::vector<std::string> units;
  bool has_units = false;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool is_number =
        !table.rows.empty() && std::ranges::all_of(table.rows, [&](const auto& row) { return is_number_text(row[c]); });
    alignment += is_number ? 'r' : 'l';
    const Column& column = table.columns[c];
    names.push_back(escape_latex(column.name));
    units.push_back(column.unit.empty() ? "" : escape_latex("[" + column.unit + "]"));
    has_units = has_units || !column.unit.empty();
  }
  const bool is_wide = width_of(table) > most_characters;
  std::string text = "% Needs \\usepackage{booktabs}.\n";
  if (is_wide) text += "{\\footnotesize\\setlength{\\tabcolsep}{2.5pt}%\n";
  text += "\\begin{tabular}{@{}" + alignment + "@{}}\n  \\toprule\n";
  text += row_text(names);
  if (has_units) text += row_text(units);
  text += "  \\midrule\n";
  for (const std::vector<Value>& row : table.rows) {
    const std::vector<std::string> cells =
        mapped(row, [](const Value& value) { return escape_latex(to_string(value)); });
    text += row_text(cells);
  }
  text += "  \\bottomrule\n";
  if (!note.empty()) {
    text += "  \\multicolumn{" + std::to_string(table.columns.size()) + "}{l}{\\footnotesize " + escape_latex(note) +
            "} \\\\\n";
  }
  return text + "\\end{tabular}" + (is_wide ? "}\n" : "\n");
}

}  // namespace umbrameter
