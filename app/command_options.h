// Groups of options of single commands, for app/command_line.cpp.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string_view>

#include "app/command_line.h"

namespace umbrameter {

/// Headings in help, of options that the short help of a command with parameters leaves out: those of
/// add_figure_options(), and those that write further files.
inline constexpr const char* figure_group = "Figures";
inline constexpr const char* files_group = "Files";
inline constexpr const char* tuning_group = "Tuning";

/// Refuses text that is no number from `min` to `max`, both included, in the words that parameters use.
CLI::Validator number_between(int min, int max);
CLI::Validator number_between(double min, double max);

/// An option that takes a value, which help calls `placeholder`.
template <class Value>
CLI::Option* add_value(CLI::App& command, const char* names, Value& target, const char* placeholder,
                       const char* meaning) {
  return command.add_option(names, target, meaning)->type_name(placeholder);
}

/// The parameters with a wanted name, or those whose names begin so.
void add_parameters(CLI::App& command, CommandLine& line, const std::function<bool(std::string_view)>& is_wanted);
void add_parameters(CLI::App& command, CommandLine& line, std::string_view prefix);

/// --quiet, --verbose and --json.
void add_output_flags(CLI::App& command, CommandLine& line);
void add_threads(CLI::App& command, CommandLine& line);
void add_memory(CLI::App& command, CommandLine& line);
void add_gl_device(CLI::App& command, CommandLine& line);
void add_page_cells(CLI::App& command, CommandLine& line);
void add_no_cache(CLI::App& command, CommandLine& line);
/// --no-figures and --full-images.
void add_page_options(CLI::App& command, CommandLine& line);

void add_diff_options(CLI::App& command, CommandLine& line);
void add_tune_options(CLI::App& command, CommandLine& line);
/// -c and --preset.
void add_settings_options(CLI::App& command, CommandLine& line);

void add_check_options(CLI::App& command, CheckOptions& check);
void add_report_options(CLI::App& command, CommandLine& line);
void add_convert_options(CLI::App& command, CommandLine& line);
/// --engine, of commands that draw.
void add_engine_choice(CLI::App& command, CommandLine& line);
/// All of serve but what other commands share.
void add_serve_options(CLI::App& command, CommandLine& line);
void add_engine_options(CLI::App& command, CommandLine& line);
/// The files of a frame, of evaluate.
void add_frame_options(CLI::App& command, CommandLine& line);

/// The engine that the words name, or the experiment file among them; empty for none. The engine describes its
/// parameters, and only then can flags be read.
std::string named_engine(int argc, const char* const* argv);

/// Of every command that draws figures.
void add_figure_options(CLI::App& command, FigureOptions& figures);

}  // namespace umbrameter
