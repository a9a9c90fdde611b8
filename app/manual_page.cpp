#include <cstdint>
#include <string_view>

#include "app/command_help.h"

namespace umbrameter {
namespace {

// groff_char(7): characters beyond ASCII by their number, so that any output device has a form for them.
std::string roff(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80) {
      if (text[i] == '\\') {
        result += "\\e";
      } else if (text[i] == '-') {
        result += "\\-";
      } else if ((text[i] == '.' || text[i] == '\'') && (result.empty() || result.back() == '\n')) {
        result += std::string("\\&") + text[i];
      } else {
        result += text[i];
      }
      ++i;
      continue;
    }
    const std::size_t length = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : 2;
    std::uint32_t code = byte & (0xffu >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k) {
      code = (code << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3fu);
    }
    static constexpr char digits[] = "0123456789ABCDEF";
    std::string number;
    for (int shift = code > 0xffff ? 20 : 12; shift >= 0; shift -= 4) number += digits[(code >> shift) & 15u];
    result += "\\[u" + number + "]";
    i += length;
  }
  return result;
}

std::string heading(const char* title) { return std::string(".SH ") + title + "\n"; }

std::string lines(const std::string& text) { return ".nf\n" + roff(text) + "\n.fi\n"; }

std::string item(const OptionHelp& option) {
  std::string left;
  if (option.is_positional) {
    left = "\\fI" + roff(option.names.front()) + "\\fR";
  } else {
    if (!option.short_name.empty()) left = "\\fB\\-" + option.short_name + "\\fR";
    for (const std::string& name : option.names) {
      left += std::string(left.empty() ? "" : ", ") + "\\fB" + roff("--" + name) + "\\fR";
    }
    if (!option.value.empty()) left += " \\fI" + roff(option.value) + "\\fR";
  }
  std::string text = meaning_of(option);
  if (!option.unit.empty()) text += " [" + option.unit + "]";
  if (!option.range.empty()) text += ", " + option.range;
  if (!option.default_value.empty()) text += " (default " + option.default_value + ")";
  return ".TP\n" + left + "\n" + roff(text) + "\n";
}

}  // namespace

std::string manual_page(const ProgramHelp& program) {
  std::string text = ".\\\" Made by 'umbrameter generate man'.\n";
  text += ".TH UMBRAMETER 1 \"\" \"umbrameter " UMBRAMETER_VERSION "\" \"User Commands\"\n";
  text += heading("NAME") + "umbrameter \\- measures the error of real-time shadows and ambient occlusion\n";
  text += heading("SYNOPSIS") + ".B umbrameter\n.I COMMAND\n[\\fIOPTIONS\\fR]\n";
  text += heading("DESCRIPTION") + roff(program.about) + "\n";
  for (const OptionHelp& option : program.options) text += item(option);
  text += heading("COMMANDS");
  for (const CommandHelp& command : program.commands) {
    text += ".SS umbrameter " + command.name + " " + roff(command.usage) + "\n" + roff(command.summary) + ".\n";
    for (const OptionHelp& option : command.options) {
      if (!option.is_parameter) text += item(option);
    }
    if (!command.example.empty()) text += ".PP\n" + lines(command.example);
  }
  if (const CommandHelp* measuring = command_with_most_parameters(program)) {
    text += heading("PARAMETERS") +
            "Options of compare, sweep, trace and raster, keys of experiment files, and names of axes for "
            "\\fB\\-\\-vary\\fR.\n";
    std::string group;
    for (const OptionHelp& option : measuring->options) {
      if (!option.is_parameter) continue;
      if (option.group != group) text += ".SS " + roff(option.group) + "\n";
      group = option.group;
      text += item(option);
    }
  }
  text += heading("EXIT STATUS");
  for (const ExitMeaning& exit : exit_meanings) text += std::string(".TP\n") + exit.code + "\n" + exit.meaning + "\n";
  text += heading("ENVIRONMENT");
  text += ".TP\n.B UMBRAMETER_CACHE\nfolder of the cache of references, which machines may share\n";
  text +=
      ".TP\n.B UMBRAMETER_SHARDS\nlist of shards, 3,7-9, of which \\-\\-shard env takes the one at the task's index\n";
  text += ".TP\n.B UMBRAMETER_CACHE_SIZE\nmax size of the cache of references: 500M, 10G; 0 for no cache (2G)\n";
  text += ".TP\n.B XDG_CACHE_HOME\nfolder that holds the cache (~/.cache)\n";
  text += ".TP\n.B NO_COLOR\nno colours in the progress bar\n";
  text += heading("EXAMPLES") + ".nf\n";
  for (const char* example : first_examples) text += roff(example) + "\n";
  return text + ".fi\n";
}

}  // namespace umbrameter
