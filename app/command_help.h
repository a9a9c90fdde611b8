// What the command line offers, as data. Help, shell completion and the man page are made from it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace umbrameter {

struct OptionHelp {
  std::string short_name;          ///< "o"; empty for none
  std::vector<std::string> names;  ///< "output"; of a positional its placeholder, "SCENE"
  std::string value;               ///< placeholder of its value: "DIR"; empty for a flag
  std::string meaning;
  std::string unit;                  ///< empty for none or 1
  std::string range;                 ///< "1 to 16384"; empty for no limits
  std::string default_value;         ///< empty for none
  std::vector<std::string> choices;  ///< the words that are allowed; empty where it is not a choice
  std::string aliases;               ///< "pcf is accepted for box"
  std::string group;                 ///< heading
  bool is_positional = false;
  bool is_parameter = false;
  bool is_basic = true;  ///< listed by --help
};

struct CommandHelp {
  std::string name;
  std::string summary;
  std::string usage;    ///< "SCENE -o DIR [OPTIONS]"
  std::string example;  ///< lines below the options
  std::vector<OptionHelp> options;
};

struct ProgramHelp {
  std::string about;
  std::vector<OptionHelp> options;
  std::vector<CommandHelp> commands;
};

/// What CLI11's description of the program, a command or its options says, with what describe() says of parameters.
ProgramHelp program_help(const CLI::App& app);
CommandHelp command_help(const CLI::App& command);
std::vector<OptionHelp> options_help(const CLI::App& command);

/// Its meaning, the words that are allowed, and other names of these.
std::string meaning_of(const OptionHelp& option);

/// Null if no command has parameters.
const CommandHelp* command_with_most_parameters(const ProgramHelp& program);

/// Most characters of a line of help.
inline constexpr std::size_t help_width = 100;

/// `umbrameter --help`.
std::string help_text(const ProgramHelp& program);
/// `umbrameter --help-all`: the options of all commands, then every parameter once.
std::string full_help_text(const ProgramHelp& program);
/// `umbrameter COMMAND --help`; with every parameter where `all`.
std::string help_text(const CommandHelp& command, bool all);

/// Completion scripts; commands, options, choices, built-in scenes and parameters are listed in them.
std::string bash_completion(const ProgramHelp& program);
std::string zsh_completion(const ProgramHelp& program);
std::string fish_completion(const ProgramHelp& program);

/// The man page, section 1, in roff.
std::string manual_page(const ProgramHelp& program);

/// One exit code and its meaning, for help and man page.
struct ExitMeaning {
  const char* code;
  const char* meaning;
};
inline constexpr ExitMeaning exit_meanings[] = {
    {"0", "success"},
    {"1", "a check failed or images differ"},
    {"2", "usage or configuration"},
    {"3", "no usable OpenGL or Embree"},
    {"4", "unreadable input"},
    {"5", "partial result"},
    {"130, 143", "stopped by a signal"},
};

/// Two commands to start with.
inline constexpr const char* first_examples[] = {
    "umbrameter compare courtyard -o out",
    "umbrameter sweep scene.glb -o out --vary shadow.constant-bias=0.002:0.2:65:log",
};

}  // namespace umbrameter
