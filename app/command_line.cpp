#include "app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <list>

#include "app/experiment.h"
#include "core/error.h"

namespace umbrameter {
namespace {

constexpr const char* about =
    "Umbrameter measures how wrong real-time shadows and ambient occlusion are: the same glTF scene goes through\n"
    "an OpenGL rasteriser and through Embree, and the difference is taken apart by cause.";

constexpr const char* first_steps =
    "First steps:\n"
    "  umbrameter compare courtyard -o out               measure a built-in scene; open out/index.html\n"
    "  umbrameter sweep my.glb -o out --light sun \\\n"
    "      --vary shadow.constant-bias=0:0.2:65 --vary shadow.resolution=512,1024,2048\n"
    "  umbrameter info my.glb                            what is in a file, and which GL devices there are\n"
    "\n"
    "Exit codes: 0 fine, 1 a check failed, 2 usage or configuration, 3 no usable OpenGL or Embree,\n"
    "            4 input unreadable, 5 partial result, 130 and 143 stopped by a signal.\n"
    "'umbrameter COMMAND --help' tells more, with an example.";

struct CommandDescription {
  const char* name;
  const char* summary;
  const char* example;
};

constexpr CommandDescription image_commands[] = {
    {"compare", "Measure one configuration: images, error maps, causes, statistics, a page",
     "Example: umbrameter compare courtyard -o out --light sun --shadow.resolution 2048 --shadow.constant-bias 0.01\n"
     "Then open out/index.html; the layers are in out/images.exr."},
    {"sweep", "Measure every cell of a grid over any parameters",
     "Example: umbrameter sweep courtyard -o out --light sun \\\n"
     "             --vary shadow.constant-bias=0:0.2:65 --vary shadow.resolution=512,1024,2048\n"
     "An axis is first:last:count, first:last:count:log, or a list a,b,c. Rows go to out/sweep.csv."},
    {"trace", "The reference alone: Embree, no OpenGL",
     "Example: umbrameter trace courtyard -o out --truth.spp 1024 --truth.ao-distance 2"},
    {"raster", "The techniques alone: OpenGL, no Embree",
     "Example: umbrameter raster courtyard -o out --shadow.filter box --shadow.filter-size 5"},
};

constexpr std::pair<const char*, const char*> short_names[] = {
    {"view.size", "--size"}, {"view.scene", "--scene"},    {"view.camera", "--camera"}, {"view.light", "--light"},
    {"run.seed", "--seed"},  {"run.classes", "--classes"}, {"run.measure", "--measure"}};

constexpr std::pair<const char*, const char*> group_titles[] = {{"scene", "Scene"},
                                                                {"view", "View"},
                                                                {"light", "Extent of the measured lights"},
                                                                {"shadow", "Shadow technique"},
                                                                {"ao", "Ambient-occlusion technique"},
                                                                {"truth", "Reference"},
                                                                {"run", "Run"}};

// All parameters, or the one of that name.
void add_parameters(CLI::App& command, CommandLine& line, std::string_view only = {}) {
  Experiment defaults;
  for (const Parameter& parameter : describe(defaults)) {
    if (!only.empty() && parameter.key != only) continue;
    std::string names = "--" + parameter.key;
    for (const auto& [key, name] : short_names) {
      if (parameter.key == key) names += std::string(",") + name;
    }
    const std::string group = parameter.key.substr(0, parameter.key.find('.'));
    std::string title = group;
    for (const auto& [key, text] : group_titles) {
      if (group == key) title = text;
    }
    std::string meaning = parameter.description.meaning;
    if (!parameter.description.unit.empty()) meaning += " [" + parameter.description.unit + "]";
    if (!std::holds_alternative<std::string*>(parameter.field)) meaning += "; " + parameter.limits();
    const std::string value = to_string(parameter.value());
    if (!value.empty()) meaning += " (default " + value + ")";
    command
        .add_option_function<std::string>(
            names, [&line, key = parameter.key](const std::string& text) { line.settings.emplace_back(key, text); },
            meaning)
        ->type_name("VALUE")
        ->trigger_on_parse()
        ->group(title);
  }
}

void add_output_flags(CLI::App& command, CommandLine& line) {
  CLI::Option* quiet = command.add_flag("--quiet", line.quiet, "Print the answer only");
  command.add_flag("--verbose", line.verbose, "Print diagnostics too: rays, times, reclassified taps")->excludes(quiet);
  command.add_flag("--json", line.json, "Print the summary as JSON on stdout, and nothing else there");
}

void add_threads(CLI::App& command, CommandLine& line) {
  command.add_option("--threads", line.threads, "Threads; 0 uses all cores. Results do not depend on it")
      ->check(CLI::Range(0, 4096));
}

void add_image_command(CLI::App& app, CommandLine& line, const CommandDescription& description) {
  CLI::App& command = *app.add_subcommand(description.name, description.summary);
  command.footer(description.example);
  command.add_option("SCENE", line.scene, "A .gltf or .glb file, or the name of a built-in scene");
  command.add_option("-o,--output", line.output, "Folder for the results; made if it is not there")->required();
  command.add_option("-c,--config", line.experiment_file, "Experiment file (TOML); flags override it");
  if (std::string(description.name) == "compare") {
    command.add_flag_callback(
        "--shimmer", [&line] { line.settings.emplace_back("run.shimmer", "true"); }, "The same as --run.shimmer true");
  }
  if (std::string(description.name) == "sweep") {
    command.add_option("--vary", line.vary, "Axis: parameter=first:last:count[:log] or parameter=a,b,c; repeatable")
        ->take_all();
  }
  command.add_flag("--force", line.force,
                   std::string(description.name) == "sweep"
                       ? "Replace the results of an earlier run in the folder, and measure every cell again"
                       : "Replace the results of an earlier run in the folder");
  if (std::string(description.name) != "trace") {
    command.add_option("--gl-device", line.gl_device, "OpenGL device: index, part of its name, or 'software'");
  }
  if (std::string(description.name) != "raster") {
    command.add_flag("--no-cache", line.no_cache, "Trace the reference anew, and do not keep it ('umbrameter cache')");
  }
  add_threads(command, line);
  add_output_flags(command, line);
  add_parameters(command, line);
}

std::string nearest_flag(const CLI::App& command, const std::string& given) {
  std::string nearest;
  int least = 4;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const int distance = edit_distance("--" + name, given);
      if (distance < least) {
        least = distance;
        nearest = "--" + name;
      }
    }
  }
  return nearest;
}

std::string nearest_command(const CLI::App& app, const std::string& given) {
  for (const CLI::App* command : app.get_subcommands({})) {
    if (edit_distance(command->get_name(), given) <= 2) return command->get_name();
  }
  return {};
}

[[noreturn]] void reject_extras(const CLI::App& app) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::vector<std::string> extras = app.remaining(true);
  const std::string given = extras.empty() ? "" : extras.front().substr(0, extras.front().find('='));
  const std::string help = "'umbrameter" + (command == &app ? "" : " " + command->get_name()) + " --help' lists ";
  if (given.starts_with('-')) {
    const std::string nearest = nearest_flag(*command, given);
    throw Error(ExitCode::usage, given, "there is no such flag",
                nearest.empty() ? help + "the flags" : "did you mean '" + nearest + "'?");
  }
  const std::string nearest = command == &app ? nearest_command(app, given) : "";
  throw Error(ExitCode::usage, "'" + given + "'",
              command == &app ? "there is no such command" : "one argument too many",
              nearest.empty() ? help + "what there is" : "did you mean '" + nearest + "'?");
}

}  // namespace

std::variant<CommandLine, Information> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  CLI::App app{about, "umbrameter"};
  app.footer(first_steps);
  app.set_version_flag("--version", std::string("umbrameter ") + UMBRAMETER_VERSION);
  app.require_subcommand(1);
  for (const CommandDescription& description : image_commands) add_image_command(app, line, description);

  CLI::App& scenes = *app.add_subcommand("scenes", "List the built-in scenes, or draw them on a contact sheet");
  scenes.footer("Example: umbrameter scenes --sheet scenes.pdf");
  scenes.add_option("NAMES", line.names, "Only these scenes");
  scenes.add_option("--sheet", line.sheet, "Draw a picture of each onto one sheet: .png, .svg or .pdf");
  scenes.add_option("--size", line.tile_size, "Size of each picture on the sheet, WxH pixels (default 480x300)");
  scenes.add_flag("--markdown", line.markdown, "As a Markdown page");
  add_threads(scenes, line);
  add_output_flags(scenes, line);

  CLI::App& scene = *app.add_subcommand("scene", "Write a built-in scene as a .glb file");
  scene.footer("Example: umbrameter scene courtyard -o courtyard.glb");
  scene.add_option("NAME", line.scene, "Name of the built-in scene, name:NUMBER for one of another size")->required();
  scene.add_option("-o,--output", line.output, "File to write, .glb")->required();
  for (const char* name : {"scene.unit", "scene.blend", "view.scene"}) add_parameters(scene, line, name);
  add_output_flags(scene, line);

  CLI::App& cache = *app.add_subcommand("cache", "List the references that are kept between runs, or remove them");
  cache.footer(
      "Example: umbrameter cache --clear\n"
      "The limit is 2 GB; UMBRAMETER_CACHE_SIZE sets another one (500M, 10G; 0 keeps nothing).");
  cache.add_flag("--clear", line.clear, "Remove all of them");
  add_output_flags(cache, line);

  CLI::App& info = *app.add_subcommand("info", "Versions, OpenGL devices and, with a scene, what is in it");
  info.footer("Example: umbrameter info courtyard");
  info.add_option("SCENE", line.scene, "A .gltf or .glb file, or the name of a built-in scene");
  for (const char* name : {"scene.unit", "scene.blend", "view.scene"}) add_parameters(info, line, name);
  info.add_flag("--measure-memory", line.measure_memory,
                "Build the ray tracer's structure however large, to tell what it takes");
  add_output_flags(info, line);

  CLI::App& parameters = *app.add_subcommand("parameters", "List every parameter with default, unit and limits");
  parameters.footer("Example: umbrameter parameters --markdown > docs/parameters.md");
  parameters.add_flag("--markdown", line.markdown, "As a Markdown page");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    return Information{chosen.empty() ? app.help() : chosen.front()->help("umbrameter")};
  } catch (const CLI::CallForVersion& version) {
    return Information{std::string(version.what()) + "\n"};
  } catch (const CLI::ExtrasError&) {
    reject_extras(app);
  } catch (const CLI::ParseError& error) {
    // A stray word also trips "a subcommand is required"; the word is the better message.
    if (app.get_subcommands().empty() && !app.remaining().empty()) reject_extras(app);
    const std::string help = app.get_subcommands().empty()
                                 ? "umbrameter --help"
                                 : "umbrameter " + app.get_subcommands().front()->get_name() + " --help";
    throw Error(ExitCode::usage, "command line", error.what(), "see '" + help + "'");
  }
  line.command = app.get_subcommands().front()->get_name();
  return line;
}

}  // namespace umbrameter
