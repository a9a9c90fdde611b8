#include "app/command_help.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "app/command_options.h"
#include "experiments/settings/experiment.h"
#include "experiments/settings/stage_inputs.h"

namespace umbrameter {
namespace {

// The name of a value in help: "DIR", "LENGTH".
std::string placeholder(const Parameter& parameter) {
  if (std::holds_alternative<int*>(parameter.field)) return "N";
  if (std::holds_alternative<double*>(parameter.field)) return "X";
  if (std::holds_alternative<Size*>(parameter.field)) return "WxH";
  if (std::holds_alternative<Length*>(parameter.field)) return "LENGTH";
  return std::holds_alternative<bool*>(parameter.field) ? "BOOL" : "NAME";
}

std::string range_text(const FieldDescription& description) {
  std::string text = description.odd ? "odd" : description.power_of_two ? "a power of two" : "";
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  const bool has_min = std::isfinite(description.min);
  const bool has_max = std::isfinite(description.max);
  if (has_min && has_max) add(to_string(description.min) + " to " + to_string(description.max));
  if (has_min && !has_max) add("at least " + to_string(description.min));
  if (!has_min && has_max) add("at most " + to_string(description.max));
  return text;
}

// CLI11 adds the limits of a check behind a colon.
std::string value_name(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

OptionHelp option_help(const CLI::Option& option, const Parameters& parameters) {
  OptionHelp help;
  help.is_positional = option.get_positional();
  help.names = help.is_positional ? std::vector<std::string>{option.get_name()} : option.get_lnames();
  if (!option.get_snames().empty()) help.short_name = option.get_snames().front();
  help.meaning = option.get_description();
  help.group = option.get_group();
  const bool has_value = option.get_items_expected_max() > 0;
  if (has_value && !help.is_positional) help.value = value_name(option);
  const Parameter* parameter = help.names.empty() ? nullptr : find(parameters, help.names.front());
  if (parameter == nullptr) return help;
  const FieldDescription& description = parameter->description;
  help.is_parameter = true;
  help.is_basic = description.basic;
  help.value = placeholder(*parameter);
  help.unit = description.unit == "1" ? "" : description.unit;
  help.default_value = to_string(parameter->value());
  if (const auto* choice = std::get_if<ChoiceRef>(&parameter->field)) {
    help.choices = choice->names;
  } else if (std::holds_alternative<bool*>(parameter->field)) {
    help.choices = {"true", "false"};
  } else {
    help.range = range_text(description);
  }
  for (const auto& [alias, name] : description.aliases) {
    help.aliases += (help.aliases.empty() ? "" : "; ") + alias + " is accepted for " + name;
  }
  return help;
}

std::string usage_of(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name() + (option->get_items_expected_max() > 1 ? "..." : "");
    text += option->get_required() ? name + " " : "[" + name + "] ";
  }
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() || !option->get_required()) continue;
    const bool has_short_name = !option->get_snames().empty();
    text += has_short_name ? "-" + option->get_snames().front() : "--" + option->get_lnames().front();
    text += " " + value_name(*option) + " ";
  }
  return text + "[OPTIONS]";
}

}  // namespace

std::vector<OptionHelp> options_help(const CLI::App& command) {
  Experiment defaults;
  const Parameters parameters = describe(defaults);
  std::vector<OptionHelp> options;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) options.push_back(option_help(*option, parameters));
  }
  // Beside parameters, --help lists no options of figures, no further files, and none that plan has of tune.
  const bool has_parameters = std::ranges::any_of(options, &OptionHelp::is_parameter);
  for (OptionHelp& option : options) {
    const bool is_advanced =
        option.group == figure_group || option.group == files_group || option.group == tuning_group;
    if (has_parameters && is_advanced) option.is_basic = false;
  }
  // Arguments first, then the command's own options, then parameters.
  const auto place = [](const OptionHelp& option) { return option.is_positional ? 0 : option.is_parameter ? 2 : 1; };
  std::ranges::stable_sort(options, [&](const OptionHelp& a, const OptionHelp& b) { return place(a) < place(b); });
  return options;
}

// Only what the command reads is among its most used options; --help-all lists every parameter.
bool is_read(std::string_view command, std::string_view parameter) {
  const bool is_of_technique =
      parameter.starts_with("shadow.") || parameter.starts_with("ao.") || parameter.starts_with("shading.");
  if (command == "raster") return !parameter.starts_with("truth.");
  if (command != "trace" && command != "evaluate") return true;
  if (parameter.starts_with("engine.")) return false;
  // The reference of AO looks as far as ao.radius.
  if (!is_of_technique || parameter == "ao.radius") return true;
  constexpr Stage of_reference[] = {Stage::counted, Stage::binary_reference, Stage::area_reference,
                                    Stage::pixel_reference, Stage::ao_reference};
  return std::ranges::any_of(of_reference, [&](Stage stage) { return depends_on(stage, parameter); });
}

CommandHelp command_help(const CLI::App& command) {
  CommandHelp help{command.get_name(), command.get_description(), usage_of(command), command.get_footer(),
                   options_help(command)};
  for (OptionHelp& option : help.options) {
    if (option.is_parameter && !is_read(help.name, option.names.front())) option.is_basic = false;
  }
  return help;
}

ProgramHelp program_help(const CLI::App& app) {
  ProgramHelp help{app.get_description(), options_help(app), {}};
  for (const CLI::App* command : app.get_subcommands({})) {
    if (!command->get_group().empty()) help.commands.push_back(command_help(*command));
  }
  return help;
}

std::string meaning_of(const OptionHelp& option) {
  std::string text = option.aliases.empty() ? option.meaning : option.meaning + " (" + option.aliases + ")";
  for (std::size_t i = 0; i < option.choices.size(); ++i) text += (i == 0 ? ": " : ", ") + option.choices[i];
  return text;
}

const CommandHelp* command_with_most_parameters(const ProgramHelp& program) {
  const CommandHelp* most = nullptr;
  std::size_t best = 0;
  for (const CommandHelp& command : program.commands) {
    std::size_t count = 0;
    for (const OptionHelp& option : command.options) count += option.is_parameter ? 1 : 0;
    if (count > best) most = &command;
    best = std::max(best, count);
  }
  return most;
}

}  // namespace umbrameter
