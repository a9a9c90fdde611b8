// Tables for LaTeX documents, in the style of the package booktabs.
#pragma once

#include <string>
#include <string_view>

#include "core/table.h"

namespace umbrameter {

/// Text that LaTeX sets as it is: no character of it is a command, a separator of cells or the start of an option.
/// Control characters become blanks; bytes that are no UTF-8 the replacement character. Needs text mode; signs such as
/// ± and − are set in math mode.
std::string escape_latex(std::string_view text);

/// A tabular with the columns' names, their units in brackets below, and the rows. Columns of numbers are aligned
/// right. A note is set small below them. What is wider than a column of a two-column page is set small with narrow
/// gaps. The document needs \usepackage{booktabs}.
std::string to_latex(const Table& table, std::string_view note = {});

}  // namespace umbrameter
