// Groups of options of single commands, for app/command_line.cpp.
#pragma once

#include "app/command_line.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace umbrameter {

/// Headings in help, of options that the short help of a command with parameters leaves out: those of
/// add_figure_options(), and those that write further files.
inline constexpr const char* figure_group = "Figures";
inline constexpr const char* files_group = "Files";

/// Refuses text that is no number from `min` to `max`, both included, in the words that parameters use.
CLI::Validator number_between(int min, int max);
CLI::Validator number_between(double min, double max);

void add_diff_options(CLI::App& command, CommandLine& line);
void add_tune_options(CLI::App& command, CommandLine& line);
/// Of every command that draws figures.
void add_figure_options(CLI::App& command, FigureOptions& figures);

}  // namespace umbrameter
