// What the specifications of all plots share: columns by name, captions in lines, one look.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/table.h"
#include "reports/figures/style.h"

namespace umbrameter {

using Json = nlohmann::ordered_json;

/// Of a plot without its axis labels [units].
int plot_width(const FigureStyle& style);

/// Nothing for a value that is no number.
std::optional<double> number(const Value& value);

/// Throws Error (partial) that names the figure when there is no column of that name.
std::size_t column_of(const Table& table, const std::string& stem, const std::string& name);

bool is_numeric(const Table& table, std::size_t column);

/// The different values of a column as text: numbers by size, all else in the order of the rows.
std::vector<std::string> different_values(const Table& table, std::size_t column);

/// Sets the title and the conditions below it where the style has titles, and the notes in any case.
void add_title(Json& specification, const FigureStyle& style, const std::string& title, const std::string& conditions,
               const std::vector<std::string>& notes = {});

/// Height of a plot without a given one [units].
inline constexpr int plot_height = 280;

/// Of a plot in the style: what a given height leaves beside the other axis and a legend of two lines [units].
double height_of_plot(const FigureStyle& style);

/// A label in lines that fit along a side of this many units: a longer one would enlarge the drawing.
Json fitting_label(const std::string& label, double units);

/// Tells the drawer how wide a drawing for print is, so that it can fit the plot; `columns` and `rows` of panels.
void add_print_size(Json& specification, const FigureStyle& style, int columns = 1, int rows = 1);

/// For axes, legends and headers of values that are texts: numbers with four significant digits, all else as it is.
/// The parentheses belong to it: in a header Vega-Lite replaces "datum.label" by an expression with operators in it.
inline constexpr const char* short_labels = "isNaN(+(datum.label)) ? datum.label : format(+(datum.label), '.4~g')";

/// A field of a plot's rows.
struct PlotField {
  std::string field;   ///< "x"
  std::string column;  ///< of the table: "shadow.constant-bias"
  std::string label;   ///< "constant bias [m]"; may be empty
};

/// usermeta of a specification: the fields that the drawing keeps of each point, so that a page can show them. The
/// first `keys` of them tell which cell of a sweep it is.
Json plot_fields(const std::vector<PlotField>& fields, std::size_t keys);

/// Fonts, inks, axes and legends.
Json plot_look(const FigureStyle& style);

}  // namespace umbrameter
