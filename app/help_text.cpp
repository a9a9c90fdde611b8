#include <algorithm>
#include <string_view>

#include "app/command_help.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

constexpr std::size_t indent = 2;
constexpr std::size_t command_column = 14;
constexpr std::size_t meaning_column = 34;

std::string spaces(std::size_t count) { return std::string(count, ' '); }

// Breaks at blanks; the first line continues at column `at`, further ones begin at column `margin`.
std::string wrapped(std::string_view text, std::size_t at, std::size_t margin) {
  std::string result;
  std::size_t column = at;
  bool is_first = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t width = count_characters(word);
    if (!is_first && column + 1 + width > static_cast<std::size_t>(help_width)) {
      result.append("\n").append(margin, ' ');
      column = margin;
    } else if (!is_first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += width;
    is_first = false;
  }
  return result + "\n";
}

std::string row(const std::string& left, const std::string& right, std::size_t column = meaning_column) {
  const std::size_t used = indent + count_characters(left);
  std::string text = spaces(indent) + left;
  if (right.empty()) return text + "\n";
  // A name that is too long takes a whole line.
  const std::size_t gap = used + 2 > column ? 0 : column - used;
  if (gap == 0) text += "\n";
  return text + spaces(gap == 0 ? column : gap) + wrapped(right, column, column);
}

std::string left_of(const OptionHelp& option) {
  if (option.is_positional) return option.names.front();
  std::string text = option.short_name.empty() ? "" : "-" + option.short_name;
  for (const std::string& name : option.names) text += (text.empty() ? "--" : ", --") + name;
  return option.value.empty() ? text : text + " " + option.value;
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string right_of(const OptionHelp& option, bool with_range) {
  std::string text = option.meaning;
  if (!option.choices.empty()) text += ": " + list(option.choices);
  if (!option.aliases.empty()) text += "; " + option.aliases;
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
    if (is_listed(option) && std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
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
  std::string text = wrapped(program.about, 0, 0) + "\nUsage: umbrameter COMMAND [OPTIONS]\n" + command_rows(program);
  text += options_text(program.options, false, [](const OptionHelp&) { return true; });
  text += "\nExamples:\n";
  for (const char* example : first_examples) text += spaces(indent) + example + "\n";
  return text + "\n" + exit_text() + "'umbrameter help COMMAND' shows the options of a command and an example.\n";
}

std::string full_help_text(const ProgramHelp& program) {
  std::string text = help_text(program);
  const std::vector<OptionHelp>* parameters = nullptr;
  for (const CommandHelp& command : program.commands) {
    if (command.options.empty()) continue;
    text += "\n";
    text += wrapped("umbrameter " + command.name + " " + command.usage, 0, 4);
    const std::string own =
        options_text(command.options, true, [](const OptionHelp& option) { return !option.is_parameter; });
    text += own.substr(std::min<std::size_t>(1, own.size()));
    const auto count = [](const std::vector<OptionHelp>& options) {
      return std::count_if(options.begin(), options.end(), [](const OptionHelp& o) { return o.is_parameter; });
    };
    if (parameters == nullptr || count(command.options) > count(*parameters)) parameters = &command.options;
  }
  if (parameters == nullptr) return text;
  text += "\nParameters of compare, sweep, trace and raster\n";
  return text + options_text(*parameters, true, [](const OptionHelp& option) { return option.is_parameter; });
}

std::string help_text(const CommandHelp& command, bool all) {
  std::string text =
      wrapped(command.summary, 0, 0) + "\n" + wrapped("Usage: umbrameter " + command.name + " " + command.usage, 0, 4);
  text += options_text(command.options, all, [&](const OptionHelp& option) { return all || option.is_basic; });
  const auto hidden = std::count_if(command.options.begin(), command.options.end(),
                                    [](const OptionHelp& option) { return !option.is_basic; });
  if (!all && hidden > 0) {
    text +=
        "\n'umbrameter " + command.name + " --help-all' lists all parameters (" + std::to_string(hidden) + " more).\n";
  }
  return command.example.empty() ? text : text + "\n" + command.example + "\n";
}

}  // namespace umbrameter
