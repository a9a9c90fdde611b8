#include <fmt/format.h>

#include <algorithm>

#include "app/command_help.h"
#include "core/lists.h"
#include "reports/files/markup.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

constexpr const char* axis_value = "PARAM=AXIS";

std::string scene_names() { return joined(builtin_scenes(), " ", &BuiltinScene::name); }

std::string command_names(const ProgramHelp& program) { return joined(program.commands, " ", &CommandHelp::name); }

// Full names, each once, as the first words of axes but for the last "="; they have a dot.
std::string parameter_names(const ProgramHelp& program) {
  std::vector<std::string> names;
  for (const CommandHelp& command : program.commands) {
    for (const OptionHelp& option : command.options) {
      if (option.is_parameter && std::ranges::find(names, option.names.front()) == names.end()) {
        names.push_back(option.names.front());
      }
    }
  }
  return joined(names, "= ");
}

std::vector<std::string> flags_of(const OptionHelp& option) {
  std::vector<std::string> flags;
  if (option.is_positional) return flags;
  if (!option.short_name.empty()) flags.push_back("-" + option.short_name);
  for (const std::string& name : option.names) flags.push_back("--" + name);
  return flags;
}

std::vector<std::string> flags_of(const std::vector<OptionHelp>& options) {
  std::vector<std::string> flags;
  for (const OptionHelp& option : options) {
    for (std::string& flag : flags_of(option)) flags.push_back(std::move(flag));
  }
  return flags;
}

const OptionHelp* positional_of(const CommandHelp& command) {
  const auto found =
      std::ranges::find_if(command.options, [](const OptionHelp& option) { return option.is_positional; });
  return found == command.options.end() ? nullptr : &*found;
}

// For a word in single quotes, in bash and zsh.
std::string shell_quoted(const std::string& text) { return "'" + replace_all(text, "'", "'\\''") + "'"; }

std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

// Completes the value of an option, or of the command itself: a command of the script of bash, an action of zsh's
// _arguments, and the flags of fish's complete, -x for a value that is no file and -r for a file.
struct ShellValues {
  std::string bash;
  std::string zsh;
  std::string fish;
};

ShellValues values_of(const OptionHelp& option, const ProgramHelp& program) {
  const auto words = [](const std::string& list) { return " -x -a " + fish_quoted(list); };
  if (!option.choices.empty()) {
    const std::string choices = joined(option.choices, " ");
    return {"_umbrameter_words " + shell_quoted(choices), "(" + choices + ")", words(choices)};
  }
  const std::string& value = option.is_positional ? option.names.front() : option.value;
  if (value == "FILE") return {"_umbrameter_files -f", "_files", " -r -F"};
  if (value == "DIR") return {"_umbrameter_files -d", "_files -/", " -x -a '(__fish_complete_directories)'"};
  if (value == "SCENE") {
    return {"_umbrameter_words \"$scenes\"; _umbrameter_files -f", "_umbrameter_scenes",
            " -F -a " + fish_quoted(scene_names())};
  }
  if (value == "NAME" && option.is_positional) {
    return {"_umbrameter_words \"$scenes\"", "_umbrameter_built_in", words(scene_names())};
  }
  if (value == axis_value) {
    return {"_umbrameter_words \"$parameters\"; compopt -o nospace 2>/dev/null", "_umbrameter_axes",
            words(parameter_names(program) + "=")};
  }
  if (value == "COMMAND") {
    return {"_umbrameter_words \"$commands\"", "_umbrameter_commands", words(command_names(program))};
  }
  return {":", " ", option.value.empty() ? "" : " -x"};
}

constexpr const char* bash_start = R"(# Completion for umbrameter in bash, made by 'umbrameter generate bash'.

_umbrameter_words() {
  local match
  while IFS='' read -r match; do COMPREPLY+=("$match"); done < <(compgen -W "$1" -- "$word")
}

_umbrameter_files() {
  local match
  compopt -o filenames 2>/dev/null
  while IFS='' read -r match; do COMPREPLY+=("$match"); done < <(compgen "$1" -- "$word")
}

_umbrameter() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command='' i
  COMPREPLY=()
  # bash splits words at '=': --name=value are three of them.
  if [[ $word == '=' ]]; then
    word=''
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

// zsh: in a specification, what has a meaning inside [] or between colons.
std::string zsh_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

// One specification a name: "'(-o --output)-o[folder]:DIR:_files -/'".
std::vector<std::string> zsh_specifications(const OptionHelp& option, const ProgramHelp& program) {
  const std::string action = values_of(option, program).zsh;
  if (option.is_positional) return {shell_quoted("*:" + option.names.front() + ":" + action)};
  std::vector<std::string> specifications;
  const std::vector<std::string> flags = flags_of(option);
  const bool repeats = option.value == axis_value;
  for (const std::string& flag : flags) {
    std::string text = repeats ? "*" : flags.size() > 1 ? fmt::format("({})", joined(flags, " ")) : "";
    text += flag;
    if (!option.value.empty()) text += flag.starts_with("--") ? "=" : "+";
    text += fmt::format("[{}]", zsh_escaped(option.meaning));
    if (!option.value.empty()) text += fmt::format(":{}:{}", zsh_escaped(option.value), action);
    specifications.push_back(shell_quoted(text));
  }
  return specifications;
}

std::string zsh_arguments(const std::vector<OptionHelp>& options, const ProgramHelp& program,
                          const std::string& indent) {
  std::string text;
  for (const OptionHelp& option : options) {
    for (const std::string& specification : zsh_specifications(option, program))
      text += " \\\n" + indent + specification;
  }
  return text;
}

std::string fish_line(const std::string& condition, const OptionHelp& option, const ProgramHelp& program) {
  std::string text = "complete -c umbrameter -n " + fish_quoted(condition);
  if (!option.short_name.empty()) text += " -s " + option.short_name;
  if (!option.is_positional) {
    for (const std::string& name : option.names) text += " -l " + name;
  }
  text += values_of(option, program).fish;
  return option.is_positional ? text + "\n" : text + " -d " + fish_quoted(option.meaning) + "\n";
}

}  // namespace

std::string bash_completion(const ProgramHelp& program) {
  std::string text = bash_start;
  text += "  local commands=" + shell_quoted(command_names(program)) + "\n";
  text += "  local scenes=" + shell_quoted(scene_names()) + "\n";
  text += "  local parameters=" + shell_quoted(parameter_names(program) + "=") + "\n";
  text += "  local options=" + shell_quoted(joined(flags_of(program.options), " ")) + "\n";
  text += "  for ((i = 1; i < COMP_CWORD; i++)); do\n    case ${COMP_WORDS[i]} in\n";
  text += "      " + joined(program.commands, "|", &CommandHelp::name);
  text += ") command=${COMP_WORDS[i]}; break ;;\n    esac\n  done\n\n";

  text += "  case \"$command $previous\" in\n";
  for (const CommandHelp& command : program.commands) {
    for (const OptionHelp& option : command.options) {
      if (option.is_positional || option.value.empty()) continue;
      const std::string patterns = joined(
          flags_of(option), "|", [&](const std::string& flag) { return shell_quoted(command.name + " " + flag); });
      text += fmt::format("    {}) {}; return ;;\n", patterns, values_of(option, program).bash);
    }
  }
  text += "  esac\n\n  case $command in\n";
  for (const CommandHelp& command : program.commands) {
    text += "    " + command.name + ")\n";
    if (const OptionHelp* positional = positional_of(command)) {
      text += "      if [[ $word != -* ]]; then " + values_of(*positional, program).bash + "; return; fi\n";
    }
    text += "      options=" + shell_quoted(joined(flags_of(command.options), " ")) + "\n      ;;\n";
  }
  text += "    *) [[ $word == -* ]] || options=$commands ;;\n  esac\n  _umbrameter_words \"$options\"\n}\n\n";
  return text + "complete -F _umbrameter umbrameter\n";
}

std::string zsh_completion(const ProgramHelp& program) {
  std::string text = "#compdef umbrameter\n# Completion for umbrameter in zsh, made by 'umbrameter generate zsh'.\n\n";
  text += "_umbrameter_built_in() {\n  compadd -- " + scene_names() + "\n}\n\n";
  text += "_umbrameter_scenes() {\n  _umbrameter_built_in\n  _files\n}\n\n";
  text += "_umbrameter_axes() {\n  compadd -S '' -- " + parameter_names(program) + "=\n}\n\n";
  text += "_umbrameter_commands() {\n  local -a commands=(\n";
  for (const CommandHelp& command : program.commands) {
    text += "    " + shell_quoted(command.name + ":" + zsh_escaped(command.summary)) + "\n";
  }
  text += "  )\n  _describe command commands\n}\n\n";
  text += "_umbrameter() {\n  local context state line\n  typeset -A opt_args\n";
  text += "  _arguments -C" + zsh_arguments(program.options, program, "    ");
  text += " \\\n    '1:command:_umbrameter_commands' \\\n    '*::argument:->arguments'\n";
  text += "  [[ $state == arguments ]] || return\n  case $words[1] in\n";
  for (const CommandHelp& command : program.commands) {
    text += "    " + command.name + ")\n      _arguments -s" + zsh_arguments(command.options, program, "        ") +
            "\n      ;;\n";
  }
  return text + "  esac\n}\n\n_umbrameter \"$@\"\n";
}

std::string fish_completion(const ProgramHelp& program) {
  std::string text =
      "# Completion for umbrameter in fish, made by 'umbrameter generate fish'.\ncomplete -c umbrameter -f\n";
  for (const CommandHelp& command : program.commands) {
    text += "complete -c umbrameter -n __fish_use_subcommand -a " + command.name + " -d " +
            fish_quoted(command.summary) + "\n";
  }
  for (const OptionHelp& option : program.options) text += fish_line("__fish_use_subcommand", option, program);
  for (const CommandHelp& command : program.commands) {
    for (const OptionHelp& option : command.options) {
      text += fish_line("__fish_seen_subcommand_from " + command.name, option, program);
    }
  }
  return text;
}

}  // namespace umbrameter
