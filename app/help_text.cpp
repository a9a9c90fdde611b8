#include <algorithm>
#include <string_view>

#include "app/command_help.h"
#include "core/lists.h"
#include "reports/files/markup.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

constexpr std::size_t indent = 2;
constexpr std::size_t command_column = 14;
constexpr std::size_t meaning_column = 34;

std::string spaces(std::size_t count) { return std::string(count, ' '); }

// Lines from a column on; all but the first are indented by `hanging`, too.
std::string wrapped(std::string_view text, std::size_t column, std::size_t hanging = 0) {
  return joined(wrap_lines(text, help_width - column, hanging), "\n" + spaces(column)) + "\n";
}

std::string row(const std::string& left, const std::string& right, std::size_t column = meaning_column) {
  const std::size_t used = indent + count_characters(left);
  std::string text = spaces(indent) + left;
  if (right.empty()) return text + "\n";
  // A name that is too long takes a whole line.
  const std::size_t gap = used + 2 > column ? 0 : column - used;
  if (gap == 0) text += "\n";
  return text + spaces(gap == 0 ? column : gap) + wrapped(right, column);
}

std::string left_of(const OptionHelp& option) {
  if (option.is_positional) return option.names.front();
  std::string text = option.short_name.empty() ? "" : "-" + option.short_name;
  for (const std::string& name : option.names) text += (text.empty() ? "--" : ", --") + name;
  return option.value.empty() ? text : text + " " + option.value;
}

std::string right_of(const OptionHelp& option, bool with_range) {
  std::string text = meaning_of(option);
  const std::string range = with_range ? option.range : "";
  if (!option.unit.empty() || !range.empty()) {
    text += " [" + option.unit + (option.unit.empty() || range.empty() ? "" : ", ") + range + "]";
  }
  if (!option.default_value.empty()) text += " (" + option.default_value + ")";
  return text;
}

// Under its headings, in the order in which these first occur.
std::string options_text(const std::vector<OptionHelp>& options, bool all, const auto& is_listed) {
  std::vector<std::string> groups;
  for (const OptionHelp& option : options) {
    if (is_listed(option) && std::ranges::find(groups, option.group) == groups.end()) {
      groups.push_back(option.group);
    }
  }
  std::string text;
  for (const std::string& group : groups) {
    text += "\n" + group + ":\n";
    for (const OptionHelp& option : options) {
      if (option.group == group && is_listed(option)) text += row(left_of(option), right_of(option, all));
    }
  }
  return text;
}

std::string command_rows(const ProgramHelp& program) {
  std::string text = "\nCommands:\n";
  for (const CommandHelp& command : program.commands) text += row(command.name, command.summary, command_column);
  return text;
}

std::string exit_text() {
  std::string text;
  for (const ExitMeaning& exit : exit_meanings) {
    text += (text.empty() ? "Exit codes: " : "; ") + std::string(exit.code) + " " + exit.meaning;
  }
  return wrapped(text + ".", 0, 12);
}

}  // namespace

std::string help_text(const ProgramHelp& program) {
  std::string text = wrapped(program.about, 0) + "\nUsage: umbrameter COMMAND [OPTIONS]\n" + command_rows(program);
  text += options_text(program.options, false, [](const OptionHelp&) { return true; });
  text += "\nExamples:\n";
  for (const char* example : first_examples) text += spaces(indent) + example + "\n";
  return text + "\n" + exit_text() + "'umbrameter help COMMAND' shows the options of a command and an example.\n";
}

std::string full_help_text(const ProgramHelp& program) {
  std::string text = help_text(program);
  for (const CommandHelp& command : program.commands) {
    if (command.options.empty()) continue;
    text += "\n";
    text += wrapped("umbrameter " + command.name + " " + command.usage, 0, 4);
    const std::string own =
        options_text(command.options, true, [](const OptionHelp& option) { return !option.is_parameter; });
    text += own.substr(std::min<std::size_t>(1, own.size()));
  }
  const CommandHelp* measuring = command_with_most_parameters(program);
  if (measuring == nullptr) return text;
  text += "\nParameters of compare, sweep, trace and raster\n";
  return text + options_text(measuring->options, true, [](const OptionHelp& option) { return option.is_parameter; });
}

std::string help_text(const CommandHelp& command, bool all) {
  std::string text =
      wrapped(command.summary, 0) + "\n" + wrapped("Usage: umbrameter " + command.name + " " + command.usage, 0, 4);
  text += options_text(command.options, all, [&](const OptionHelp& option) { return all || option.is_basic; });
  const auto hidden = std::ranges::count_if(command.options, [](const OptionHelp& option) { return !option.is_basic; });
  if (!all && hidden > 0) {
    text += "\n'umbrameter " + command.name + " --help-all' lists all options (" + std::to_string(hidden) + " more).\n";
  }
  return command.example.empty() ? text : text + "\n" + command.example + "\n";
}

}  // namespace umbrameter
