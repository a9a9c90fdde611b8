// Groups of options of single commands, for app/command_line.cpp.
#pragma once

#include "app/command_line.h"

namespace CLI {
class App;
}

namespace umbrameter {

/// Heading of the options of add_figure_options() in help.
inline constexpr const char* figure_group = "Figures";

void add_diff_options(CLI::App& command, CommandLine& line);
/// Of every command that draws figures.
void add_figure_options(CLI::App& command, FigureOptions& figures);

}  // namespace umbrameter
