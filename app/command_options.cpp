#include "app/command_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "app/command_descriptions.h"
#include "experiments/settings/experiment.h"
#include "experiments/settings/stage_inputs.h"
#include "reports/files/image_file.h"
#include "reports/files/text_layout.h"
#include "store/experiment_file.h"

namespace umbrameter {
namespace {

constexpr std::pair<const char*, const char*> short_names[] = {
    {"view.size", "size"},      {"view.scene", "scene"},    {"view.camera", "camera"},
    {"view.light", "light"},    {"run.seed", "seed"},       {"run.classes", "classes"},
    {"run.measure", "measure"}, {"run.overlay", "overlay"}, {"run.for", "for"}};

// A list to which each flag adds, as to that of convert's --to.
constexpr std::string_view repeatable = "run.for";

constexpr std::pair<const char*, const char*> group_titles[] = {
    {"scene", "Scene"},     {"view", "View"},       {"light", "Size of lights"}, {"shadow", "Shadow technique"},
    {"ao", "AO technique"}, {"shading", "Shading"}, {"engine", "Engine"},        {"frame", "Frame from files"},
    {"truth", "Reference"}, {"run", "Run"}};

template <class Number>
CLI::Validator number_check(Number min, Number max, const char* kind) {
  return CLI::Validator(
      [=](const std::string& text) {
        Number number{};
        const bool is_number = CLI::detail::lexical_cast(text, number);
        if (is_number && number >= min && number <= max) return std::string();
        return fmt::format("'{}' is not allowed; expected {} from {} to {}", shortened(text, 40), kind, min, max);
      },
      "");
}

}  // namespace

CLI::Validator number_between(int min, int max) { return number_check(min, max, "an integer"); }
CLI::Validator number_between(double min, double max) { return number_check(min, max, "a number"); }

CLI::App& add_command(CLI::App& app, const CommandDescription& description) {
  CLI::App& command = *app.add_subcommand(description.name, description.summary);
  command.footer(description.example);
  return command;
}

void add_output_flags(CLI::App& command, CommandLine& line) {
  CLI::Option* quiet = command.add_flag("--quiet", line.quiet, "print only the answer");
  command.add_flag("--verbose", line.verbose, "print diagnostics too: rays, times, reclassified taps")->excludes(quiet);
  command.add_flag("--json", line.json, "print the summary as JSON on stdout, and nothing else");
}

void add_threads(CLI::App& command, CommandLine& line) {
  add_value(command, "--threads", line.threads, "N", "threads; 0 for all cores; results do not depend on it")
      ->check(number_between(0, 4096));
}

void add_memory(CLI::App& command, CommandLine& line) {
  add_value(command, "--memory", line.memory, "SIZE", "max memory for a glTF file: 512M, 8G (1 GiB + 64 × its size)")
      ->group(files_group);
}

void add_gl_device(CLI::App& command, CommandLine& line) {
  add_value(command, "--gl-device", line.gl_device, "NAME", "OpenGL device: index, part of its name, or 'software'");
}

void add_page_cells(CLI::App& command, CommandLine& line) {
  add_value(command, "--page-cells", line.page_cells, "N", "max number of cells whose images the page has (6)");
}

void add_no_cache(CLI::App& command, CommandLine& line) {
  command.add_flag("--no-cache", line.no_cache, "trace the reference again and do not cache it");
}

void add_page_options(CLI::App& command, CommandLine& line) {
  command.add_flag("--no-figures", line.no_figures, "draw no figures; the page has no pictures");
  command
      .add_flag("--full-images", line.full_images, "keep every pixel of images above 1920x1080 in the page's viewer")
      ->group(files_group);
}

void add_diff_options(CLI::App& command, CommandLine& line) {
  DiffOptions& diff = line.diff;
  command.add_option("TEST", diff.test, "image to judge: " + image_format_names())->required();
  command.add_option("REFERENCE", diff.reference, "image to compare with, of the same size")->required();
  add_value(command, "-o,--output", line.output, "FILE", "write an error map, .png, with a fixed colour scale");
  add_value(command, "--metrics", diff.metrics, "LIST", "metrics to measure, comma-separated; all by default");
  add_value(command, "--map", diff.map, "NAME", "metric of the error map (hdr-flip for linear files, else ldr-flip)");
  add_value(command, "--layer", diff.layer, "NAME", "layer of EXR files: truth_ao, truth_ao.Y");
  add_value(command, "--reference-layer", diff.reference_layer, "NAME",
            "layer of the reference, if it has another name");
  add_value(command, "--mask", diff.mask, "FILE", "count only the pixels where this image is not black");
  add_value(command, "--crop", diff.crop, "X,Y,W,H", "compare only this rectangle [px]");
  add_value(command, "--pixels-per-degree", diff.pixels_per_degree, "X",
            "resolution seen by the viewer, for FLIP (67.02)")
      ->check(number_between(1.0, 1000.0));
  add_value(command, "--exposure", diff.exposure, "EV",
            "exposure of linear files for metrics of displayed images [EV] (0)")
      ->check(number_between(-100.0, 100.0));
  add_value(command, "--exposures", diff.exposures, "RANGE",
            "exposures of HDR-FLIP [EV], START:STOP[:COUNT]; automatic by default");
  command.add_flag("--data", diff.data, "the values are data from 0 to 1 (visibility, AO), compared as they are");
  command.add_flag("--exit-code", diff.exit_code, "exit with 1 if a counted pixel differs");
}

void add_frame_options(CLI::App& command, CommandLine& line) {
  FrameParams frame;
  for (const Parameter& parameter : file_parameters(frame)) {
    const std::string name = parameter.key.substr(parameter.key.find('.') + 1);
    command
        .add_option_function<std::string>(
            "--" + name,
            [&line, key = parameter.key](const std::string& file) { line.settings.emplace_back(key, file); },
            parameter.description.meaning)
        ->trigger_on_parse()
        ->type_name("FILE");
  }
  std::vector<std::string> names;
  for (const FrameConvention& each : frame_conventions) names.emplace_back(each.name);
  command
      .add_option_function<std::string>(
          "--convention",
          [&line](const std::string& name) {
            const auto found = std::ranges::find(frame_conventions, name, &FrameConvention::name);
            const std::string_view kind = depth_conventions[static_cast<std::size_t>(found->depth_kind)];
            line.settings.emplace_back("frame.depth-kind", std::string(kind));
            line.settings.emplace_back("frame.rows", found->rows == FrameRows::top ? "top" : "bottom");
            line.settings.emplace_back("frame.axes", std::string(found->axes));
          },
          "how the files are to be read: opengl, direct3d, vulkan, reversed-z or blender")
      ->trigger_on_parse()
      ->check(CLI::IsMember(names))
      ->type_name("NAME");
}

std::string named_engine(int argc, const char* const* argv) {
  std::string engine, file;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto value_of = [&](std::string_view name, std::string& value) {
      if (word == name && i + 1 < argc) value = argv[i + 1];
      if (word.starts_with(name) && word.substr(name.size()).starts_with('=')) value = word.substr(name.size() + 1);
    };
    for (const std::string_view name : {"--engine", "--engine.adapter"}) value_of(name, engine);
    for (const std::string_view name : {"-c", "--config"}) value_of(name, file);
  }
  // What comes through a pipe can be read once only, and names no engine.
  if (!engine.empty() || !std::filesystem::is_regular_file(file)) return engine;
  return engine_in(file);
}

void add_settings_options(CLI::App& command, CommandLine& line) {
  add_value(command, "-c,--config", line.experiment_file, "FILE", "experiment file (TOML); flags override it");
  add_value(command, "--preset", line.presets, "NAME",
            "an engine's settings ('umbrameter presets'); flags override them")
      ->take_all();
}

void add_parameters(CLI::App& command, CommandLine& line, const std::function<bool(std::string_view)>& is_wanted) {
  Experiment defaults;
  for (const Parameter& parameter : describe(defaults)) {
    if (!is_wanted(parameter.key)) continue;
    std::string names = "--" + parameter.key;
    for (const auto& [key, name] : short_names) {
      if (parameter.key == key) names += std::string(",--") + name;
    }
    const std::string group = parameter.key.substr(0, parameter.key.find('.'));
    std::string title = group;
    for (const auto& [key, text] : group_titles) {
      if (group == key) title = text;
    }
    const auto set = [&line, key = parameter.key](const std::string& text) {
      const auto earlier = std::ranges::find(line.settings, key, &std::pair<std::string, std::string>::first);
      if (key == repeatable && earlier != line.settings.end()) {
        earlier->second += "," + text;
      } else {
        line.settings.emplace_back(key, text);
      }
    };
    CLI::Option* option = command.add_option_function<std::string>(names, set, parameter.description.meaning);
    option->trigger_on_parse()->group(title);
    // Without a value: true.
    if (std::holds_alternative<bool*>(parameter.field)) option->expected(0, 1)->default_str("true");
  }
}

void add_parameters(CLI::App& command, CommandLine& line, std::string_view prefix) {
  add_parameters(command, line, [&](std::string_view key) { return key.starts_with(prefix); });
}

void add_convert_options(CLI::App& command, CommandLine& line) {
  add_value(command, "--from", line.convert.from, "SPEC",
            "engine or unit, and its numbers: godot:bias=0.1,normal_bias=2");
  add_value(command, "--to", line.convert.to, "LIST",
            "engines and units: three:near=1,far=80,metres; all by default; repeatable")
      ->take_all();
  add_settings_options(command, line);
  command.add_flag("--markdown", line.markdown, "print the engines, their formulas and sources as a Markdown page");
  // What lays out the map, whoever draws into it.
  add_parameters(command, line, [](std::string_view key) {
    const bool is_ours = !key.starts_with("engine.") && !key.starts_with("frame.") && key != "view.surfels";
    return key.starts_with("scene.") || (is_ours && depends_on(Stage::layout, key));
  });
}

void add_check_options(CLI::App& command, CheckOptions& check) {
  command.add_option("DIR", check.folders, "folder of a finished compare, sweep or evaluate; repeatable")->required();
  add_value(command, "--budget", check.budget, "FILE", "budget file (TOML)")->required();
  command.add_flag("--update", check.update, "set the bounds to the present values with head room");
  add_value(command, "--junit", check.junit, "FILE", "write the result as JUnit XML");
  add_value(command, "--summary", check.summary, "FILE", "append the result as Markdown: \"$GITHUB_STEP_SUMMARY\"");
}

void add_report_options(CLI::App& command, CommandLine& line) {
  command.add_option("DIR", line.report.folders, "folder of a finished run; the first is the base of all differences")
      ->required();
  add_value(command, "-o,--output", line.output, "DIR", "folder for the report, created if missing")->required();
  command.add_flag("--latex", line.report.latex, "write the tables as LaTeX (booktabs) to figures/*.tex, too");
  command.add_flag("--force", line.force, "replace an earlier report in the folder");
  command.add_flag("--no-figures", line.no_figures, "draw no figures");
}

void add_engine_choice(CLI::App& command, CommandLine& line) {
  command
      .add_option_function<std::string>(
          "--engine", [&line](const std::string& name) { line.settings.emplace_back(std::string(engine_key), name); },
          "engine to measure in place of our techniques: a name or a command")
      ->trigger_on_parse()
      ->type_name("NAME");
}

void add_serve_options(CLI::App& command, CommandLine& line) {
  command.add_option("SCENE", line.scene, "a .gltf or .glb file, or a built-in scene ('umbrameter scenes')");
  add_settings_options(command, line);
  add_engine_choice(command, line);
  add_gl_device(command, line);
  add_no_cache(command, line);
  command.add_flag("--quiet", line.quiet, "no notes and no progress on stderr");
  add_parameters(command, line, [](std::string_view key) { return !key.starts_with("frame."); });
}

void add_engine_options(CLI::App& command, CommandLine& line) {
  command.add_option("ACTION", line.action, "list, check or serve (our own rasteriser as an adapter)")
      ->check(CLI::IsMember({"list", "check", "serve"}));
  command.add_option("COMMAND", line.names, "adapter to check: a name or a command")->expected(0, 1);
  add_value(command, "--gl-device", line.gl_device, "NAME", "OpenGL device of serve")->group("");
}

void add_figure_options(CLI::App& command, FigureOptions& figures) {
  const auto add = [&](const char* name, auto& value, const char* placeholder, const char* meaning) {
    return add_value(command, name, value, placeholder, meaning)->group(figure_group);
  };
  add("--figure-style", figures.style, "STYLE", "figures for print: column (84 mm), page (176 mm) or slide (300 mm)");
  add("--figure-size", figures.size, "W[xH]", "width of figures in print, and height of plots [mm]");
  add("--figure-font", figures.font, "NAME", "font family of figures (DejaVu Sans)");
  add("--figure-font-size", figures.font_size, "PT", "size of labels in print [pt] (8; slide 20)")
      ->check(number_between(4.0, 72.0));
  command.add_flag("--figure-title", figures.title, "draw titles into the figures")->group(figure_group);
  add("--inset", figures.insets, "REGION", "draw X,Y,W,H [px] or the region of most error, worst, enlarged; repeatable")
      ->take_all();
}

void add_tune_options(CLI::App& command, CommandLine& line) {
  TuneOptions& tune = line.tune;
  add_value(command, "--minimize", tune.minimize, "COST", "cost: a statistic, or a sum like 'acne + 0.5*rmse' (mae)");
  add_value(command, "--constraint", tune.constraints, "CONDITION",
            "condition that every case must keep: 'acne<0.1%'; repeatable")
      ->take_all();
  add_value(command, "--over", tune.over, "PARAM=LIST",
            "measure all these values: view.camera=all, light.angle=0,0.5; repeatable")
      ->take_all();
  command.add_flag("--worst-case", tune.worst_case, "minimize the largest cost of all cases, not their mean");
  command.add_flag("--relative", tune.relative, "minimize each case's cost in multiples of its cost at the default");
  add_value(command, "--held-out", tune.held_out, "PARAM=LIST",
            "check the result on view.camera=LIST or scene=NAME; repeatable (default: a camera that no case uses)")
      ->take_all();
  add_value(command, "--evaluations", tune.evaluations, "N",
            "max evaluations of the search, before each axis is measured (30 for each axis, more with words)")
      ->check(number_between(1, 1000000));
  add_value(command, "--minutes", tune.minutes, "X", "end the search after this time")
      ->check(number_between(0.001, 1e6));
}

}  // namespace umbrameter
