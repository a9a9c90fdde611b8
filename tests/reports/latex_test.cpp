#include "reports/files/latex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

namespace umbrameter {
namespace {

// What a LaTeX cell may consist of: plain characters, escaped ones, commands that end in {}, braces around one
// character, and our own math.
const std::regex cell_grammar(
    R"(([^\\{}_%&#$~^<>|"`\[\]*]|\\[_%&#${}]|\\text[a-z]+\{\}|\{[\[\]*]\}|\{\}|\$(\\pm|-|\\times|\\cdot|\^2|\^\\circ)\$)*)");

bool is_cell(const std::string& text) { return std::regex_match(text, cell_grammar); }

TEST(Latex, Special_characters_are_set_as_they_are) {
  EXPECT_EQ(escape_latex("a_b"), "a\\_b");
  EXPECT_EQ(escape_latex("100 % & #1 $x$"), "100 \\% \\& \\#1 \\$x\\$");
  EXPECT_EQ(escape_latex("{}"), "\\{\\}");
  EXPECT_EQ(escape_latex("~^\\"), "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}");
  EXPECT_EQ(escape_latex("[2mm] *"), "{[}2mm{]} {*}") << "neither is an option of the row before";
  EXPECT_EQ(escape_latex("--figure"), "-{}-{}figure") << "no dash";
  EXPECT_EQ(escape_latex("2.18 ± 0.04, −1"), "2.18 $\\pm$ 0.04, $-$1");
  EXPECT_EQ(escape_latex("a\nb\x01"), "a b ");
}

TEST(Latex, No_text_leaves_its_cell) {
  EXPECT_FALSE(is_cell("a & b"));
  EXPECT_FALSE(is_cell("\\input{x}"));
  for (const char* name : {"_ % & # $ { } ~ ^ \\", "\\input{/etc/passwd}", "\\\\", "$$", "}}\\end{tabular}", "%",
                           "</script> \"quotes\" `ticks`", "\xff\xfe", "a|b<c>d", "\\\\*[3cm]"}) {
    EXPECT_TRUE(is_cell(escape_latex(name))) << name << " becomes " << escape_latex(name);
  }
}

TEST(Latex, Each_row_of_a_table_has_as_many_cells_as_columns) {
  Table table{{{"run_a & b", "", ""}, {"mae", "%", ""}, {"verdict", "", ""}}, {}};
  table.rows.push_back({std::string("[first]"), std::string("2.18 ± 0.04"), std::string("yes")});
  table.rows.push_back({std::string("second \\\\ & third"), std::string("—"), std::string("no")});
  const std::string text = to_latex(table);
  EXPECT_NE(text.find("\\begin{tabular}{@{}lrl@{}}"), std::string::npos) << "numbers are aligned right";
  std::istringstream lines(text);
  std::vector<std::string> seen;
  for (std::string line; std::getline(lines, line);) {
    if (!line.ends_with(" \\\\")) {
      if (line.starts_with("  ")) seen.push_back(line.substr(2));
      continue;
    }
    std::string row = line.substr(2, line.size() - 5);
    for (int i = 0; i < 3; ++i) {
      const std::size_t end = row.find(" & ");
      ASSERT_EQ(end == std::string::npos, i == 2) << line;
      EXPECT_TRUE(is_cell(row.substr(0, end))) << row.substr(0, end);
      if (i < 2) row = row.substr(end + 3);
    }
  }
  EXPECT_EQ(seen, (std::vector<std::string>{"\\toprule", "\\midrule", "\\bottomrule"}));
  EXPECT_NE(text.find("{[}\\%{]}"), std::string::npos) << "the unit stands in the header";
}

TEST(Latex, A_note_is_a_row_over_all_columns_below_the_table) {
  Table table{{{"Error", "", ""}, {"box", "", ""}}, {}};
  table.rows.push_back({std::string("Acne [%]"), std::string("−0.32 ± 0.05*")});
  const std::string text = to_latex(table, "* significant: its 95 % interval excludes 0");
  EXPECT_TRUE(
      text.ends_with("  \\bottomrule\n  \\multicolumn{2}{l}{\\footnotesize {*} significant: its 95 \\% interval "
                     "excludes 0} \\\\\n\\end{tabular}\n"))
      << text;
}

// Set by pdflatex, these cells are 306 pt wide at ten points; a column of 85 mm has 242 pt.
TEST(Latex, A_table_that_is_wider_than_a_column_is_set_small) {
  Table table{{{"Error [%]", "", ""}, {"nearest", "", ""}, {"box", "", ""}}, {}};
  table.rows.push_back({std::string("Mean absolute error"), std::string("10.89 ± 0.70"), std::string("16.66 ± 0.81")});
  EXPECT_EQ(to_latex(table).find("\\footnotesize"), std::string::npos);
  table.columns.push_back({"gaussian", "", ""});
  table.rows[0].push_back(std::string("16.66 ± 0.81"));
  const std::string text = to_latex(table);
  EXPECT_NE(text.find("{\\footnotesize\\setlength{\\tabcolsep}{2.5pt}%\n\\begin{tabular}"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("\\end{tabular}}\n")) << text;
}

}  // namespace
}  // namespace umbrameter
