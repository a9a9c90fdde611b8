#include "app/command_line.h"

#include <algorithm>
#include <string_view>

#include "app/command_descriptions.h"
#include "app/command_help.h"
#include "app/command_options.h"
#include "app/plan_options.h"
#include "core/error.h"
#include "core/suggestion.h"
#include "experiments/settings/experiment.h"

namespace umbrameter {
namespace {

// --NAME for --run.NAME true.
CLI::Option* add_switch(CLI::App& command, CommandLine& line, const std::string& name, const std::string& meaning) {
  const std::string key = "run." + name;
  return command.add_flag_callback(
      "--" + name, [&line, key] { line.settings.emplace_back(key, "true"); }, meaning + " (--" + key + " true)");
}

void add_image_command(CLI::App& app, CommandLine& line, const CommandDescription& description) {
  CLI::App& command = add_command(app, description);
  const bool is_tune = &description == &tune_command;
  const bool is_evaluate = &description == &evaluate_command;
  const bool is_plan = &description == &plan_command;
  const bool is_sweep = &description == &sweep_command;
  if (is_plan) add_planned_command(command, line.plan);
  const char* scene_meaning = "a .gltf or .glb file, or a built-in scene ('umbrameter scenes')";
  if (is_tune || is_plan) {
    command.add_option("SCENE", line.tune.scenes, scene_meaning);
  } else {
    command.add_option("SCENE", line.scene, scene_meaning);
  }
  add_value(command, "-o,--output", line.output, "DIR",
            is_plan ? "folder for the plan" : "folder for the results, created if missing")
      ->required();
  add_settings_options(command, line);
  if (is_sweep || is_tune || is_plan) {
    add_value(command, "--vary", line.vary, "PARAM=AXIS",
              is_tune ? "parameter to tune: first:last[:log], or an axis of sweep; repeatable"
                      : "axis: first:last:count[:log] or a list a,b,c; repeatable")
        ->take_all();
  }
  if (is_tune) add_tune_options(command, line);
  if (is_plan) {
    add_plan_options(command, line.plan);
    const std::string group = command.option_defaults()->get_group();
    command.option_defaults()->group(tuning_group);
    add_tune_options(command, line);
    command.option_defaults()->group(group);
  }
  if (is_sweep) add_page_cells(command, line);
  command.add_flag("--force", line.force,
                   is_sweep  ? "replace an earlier run's results and measure every cell again"
                   : is_plan ? "replace an earlier plan and its results"
                             : "replace an earlier run's results in the folder");
  if (!is_tune && !is_plan) command.add_flag("--dry-run", line.dry_run, "show what would be measured, and stop");
  if (is_evaluate) add_frame_options(command, line);
  if (&description == &compare_command) {
    add_switch(command, line, "shimmer", "measure shimmer under small shifts");
    add_switch(command, line, "ao-stages", "split the error of AO by stage");
  }
  if (&description == &compare_command || is_evaluate) {
    add_value(command, "--fail-if", line.fail_if, "CONDITION", "exit with 1 if this holds: 'acne>0.1%'; repeatable")
        ->take_all();
  }
  const bool writes_files = &description == &compare_command || &description == &raster_command;
  // A sweep accepts them only to say that it writes no such files.
  if (writes_files || is_sweep || is_plan) {
    for (const auto& [name, meaning] : {std::pair{"write-maps", "write each shadow map as an EXR file"},
                                        {"write-ao-inputs", "write what the AO technique reads"}}) {
      add_switch(command, line, name, meaning)->group(writes_files ? files_group : "");
    }
  }
  if (&description != &trace_command && !is_evaluate) {
    add_engine_choice(command, line);
    add_gl_device(command, line);
  }
  if (&description != &raster_command) add_no_cache(command, line);
  if (&description == &compare_command || is_evaluate || is_sweep) add_figure_options(command, line.figures);
  if (!is_plan) add_page_options(command, line);
  add_threads(command, line);
  add_memory(command, line);
  add_output_flags(command, line);
  add_parameters(command, line, "");
}

std::string flag_suggestion(const CLI::App& command, const std::string& given) {
  // Basic parameters go first: a word that many names have means one of these.
  std::vector<std::string> names;
  const std::vector<OptionHelp> options = options_help(command);
  for (const bool basic : {true, false}) {
    for (const OptionHelp& option : options) {
      if (option.is_positional || option.is_basic != basic) continue;
      for (const std::string& name : option.names) names.push_back(name);
    }
  }
  std::vector<std::string> similar =
      similar_names(given.substr(std::min(given.find_first_not_of('-'), given.size())), names);
  for (std::string& name : similar) name.insert(0, "--");
  return suggestion(similar);
}

[[noreturn]] void reject_command(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CommandHelp& command : program_help(app).commands) names.push_back(command.name);
  const std::string similar = suggestion(similar_names(given, names));
  throw Error(ExitCode::usage, "'" + given + "'", "unknown command",
              similar.empty() ? "'umbrameter --help' lists the commands" : similar);
}

[[noreturn]] void reject_extras(const CLI::App& app) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::vector<std::string> extras = app.remaining(true);
  const std::string given = extras.empty() ? "" : extras.front().substr(0, extras.front().find('='));
  const std::string name = command == &app ? "umbrameter" : "umbrameter " + command->get_name();
  if (given.starts_with('-')) {
    const std::string similar = flag_suggestion(*command, given);
    const bool has_more = command->get_options().size() > 12;
    throw Error(
        ExitCode::usage, given, "unknown option",
        similar.empty() ? "'" + name + (has_more ? " --help-all" : " --help") + "' lists the options" : similar);
  }
  if (command == &app) reject_command(app, given);
  throw Error(ExitCode::usage, "'" + given + "'", "one argument too many", "see '" + name + " --help'");
}

Information help_of(const CLI::App& app, const std::string& name) {
  if (name.empty()) return {help_text(program_help(app)), {}};
  for (const CommandHelp& command : program_help(app).commands) {
    if (command.name == name) return {help_text(command, false), {}};
  }
  reject_command(app, name);
}

Information help_asked_for(const CLI::App& app, bool all) {
  const auto chosen = app.get_subcommands();
  if (!chosen.empty()) return {help_text(command_help(*chosen.front()), all), {}};
  return {all ? full_help_text(program_help(app)) : help_text(program_help(app)), {}};
}

Information generated(const CLI::App& app, const std::string& kind, const std::filesystem::path& file) {
  const ProgramHelp help = program_help(app);
  if (kind == "bash") return {bash_completion(help), file};
  if (kind == "zsh") return {zsh_completion(help), file};
  if (kind == "fish") return {fish_completion(help), file};
  return {manual_page(help), file};
}

void add_diff_command(CLI::App& app, CommandLine& line) {
  CLI::App& command = add_command(app, diff_command);
  add_diff_options(command, line);
  add_threads(command, line);
  add_output_flags(command, line);
}

void add_check_command(CLI::App& app, CommandLine& line) {
  CLI::App& command = add_command(app, check_command);
  add_check_options(command, line.check);
  add_output_flags(command, line);
}

void add_report_command(CLI::App& app, CommandLine& line) {
  CLI::App& command = add_command(app, report_command);
  add_report_options(command, line);
  add_figure_options(command, line.figures);
  add_threads(command, line);
  add_output_flags(command, line);
}

void add_other_commands(CLI::App& app, CommandLine& line) {
  CLI::App& scenes = add_command(app, scenes_command);
  scenes.add_option("NAME", line.names, "list only these scenes");
  add_value(scenes, "--sheet", line.sheet, "FILE", "draw the scenes on one sheet: .png, .svg or .pdf");
  add_value(scenes, "--size", line.tile_size, "WxH", "size of each picture on the sheet [px] (480x300)");
  scenes.add_flag("--markdown", line.markdown, "print a Markdown page");
  add_threads(scenes, line);
  add_output_flags(scenes, line);

  CLI::App& scene = add_command(app, scene_command);
  scene
      .add_option("NAME", line.scene,
                  "built-in scene; forest:20M for about 20 million triangles, courtyard:64 for 64 lights")
      ->required();
  add_value(scene, "-o,--output", line.output, "FILE", "file to write, .glb")->required();
  for (const char* name : {"scene.", "view.scene"}) add_parameters(scene, line, name);
  add_memory(scene, line);
  add_output_flags(scene, line);

  CLI::App& convert = add_command(app, convert_command);
  convert.add_option("SCENE", line.scene, "a .gltf or .glb file, or a built-in scene");
  add_convert_options(convert, line);
  add_threads(convert, line);
  add_memory(convert, line);
  add_output_flags(convert, line);

  CLI::App& cache = add_command(app, cache_command);
  cache.add_flag("--clear", line.clear, "remove all cached references");
  add_output_flags(cache, line);

  CLI::App& engine = add_command(app, engine_command_text);
  add_engine_options(engine, line);
  add_threads(engine, line);
  add_output_flags(engine, line);

  CLI::App& serve = add_command(app, serve_command);
  add_serve_options(serve, line);
  add_threads(serve, line);
  add_memory(serve, line);

  add_output_flags(add_command(app, presets_command), line);

  CLI::App& info = add_command(app, info_command);
  info.add_option("SCENE", line.scene, "a .gltf or .glb file, or a built-in scene");
  for (const char* name : {"scene.", "view.scene"}) add_parameters(info, line, name);
  info.add_flag("--measure-memory", line.measure_memory, "build the ray tracer's structure to measure its memory");
  add_memory(info, line);
  add_output_flags(info, line);

  CLI::App& parameters = add_command(app, parameters_command);
  CLI::Option* json = parameters.add_flag("--json", line.json, "print the list as JSON");
  parameters.add_flag("--markdown", line.markdown, "print a Markdown page")->excludes(json);
}

}  // namespace

std::variant<CommandLine, Information> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  if (const std::string engine = named_engine(argc, argv); !engine.empty()) {
    line.engine = std::make_shared<Engine>(engine);
    use_engine(line.engine->parameters());
  }
  CLI::App app{about, "umbrameter"};
  app.set_help_flag("-h,--help", "show the most used options");
  app.set_help_all_flag("--help-all", "show all options");
  app.set_version_flag("-V,--version", std::string("umbrameter ") + UMBRAMETER_VERSION, "show the version");
  app.require_subcommand(1);
  for (const CommandDescription* description : {&compare_command, &sweep_command, &plan_command, &tune_command,
                                                &evaluate_command, &trace_command, &raster_command}) {
    add_image_command(app, line, *description);
  }
  add_diff_command(app, line);
  add_check_command(app, line);
  add_report_command(app, line);
  add_shard_commands(app, line);
  add_other_commands(app, line);
  std::string topic;
  add_command(app, help_command).add_option("COMMAND", topic, "command to explain");
  CLI::App& generate = add_command(app, generate_command);
  generate.group("");
  generate.add_option("KIND", topic)->required()->check(CLI::IsMember({"bash", "zsh", "fish", "man"}));
  generate.add_option("-o,--output", line.output)->type_name("FILE");

  // A dry run writes nothing.
  if (std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--dry-run"; })) {
    for (CLI::App* command : app.get_subcommands({})) {
      if (command->get_option_no_throw("--dry-run") != nullptr) command->get_option("--output")->required(false);
    }
  }
  // As Go, uv and clap do: what to do next, but no success for a script that lost its arguments.
  if (argc <= 1) return Information{help_text(program_help(app)), {}, ExitCode::usage};
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return help_asked_for(app, false);
  } catch (const CLI::CallForAllHelp&) {
    return help_asked_for(app, true);
  } catch (const CLI::CallForVersion& version) {
    return Information{std::string(version.what()) + "\n", {}};
  } catch (const CLI::ExtrasError&) {
    reject_extras(app);
  } catch (const CLI::ParseError& error) {
    // What is unknown is the better message than what is missing: it may be the missing one, mistyped.
    if (!app.remaining(true).empty()) reject_extras(app);
    const std::string help = app.get_subcommands().empty()
                                 ? "umbrameter --help"
                                 : "umbrameter " + app.get_subcommands().front()->get_name() + " --help";
    throw Error(ExitCode::usage, "command line", error.what(), "see '" + help + "'");
  }
  if (line.output == "-") {
    throw Error(ExitCode::usage, "-o -", "results cannot be written to stdout",
                "name a file or folder, or write ./- for one of that name");
  }
  line.command = app.get_subcommands().front()->get_name();
  if (line.command == help_command.name) return help_of(app, topic);
  if (line.command == generate_command.name) return generated(app, topic, line.output);
  return line;
}

}  // namespace umbrameter
