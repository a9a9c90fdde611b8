// The subcommands. Each returns the program's exit code and throws Error.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "core/error.h"
#include "experiments/settings/experiment.h"
#include "experiments/stages/cache_folder.h"
#include "experiments/stages/stages.h"
#include "reports/files/console.h"
#include "results/run_results.h"
#include "scenes/load_options.h"
#include "store/gate.h"

namespace umbrameter {

/// Defaults, then the experiment file, then the flags; axes likewise.
Experiment make_experiment(const CommandLine& line);

/// Which scene of a file to read, and how, as the flags say.
struct SceneChoice {
  std::string part;          ///< view.scene
  SceneParams scene_params;  ///< scene.*
};
SceneChoice chosen_scene(const CommandLine& line);

/// What --memory says; `materials` for a shaded image. Throws Error (usage) where it is no size.
LoadOptions load_options(const CommandLine& line, bool materials = false);

/// The user's cache of references, unless --no-cache is given or nothing is traced.
std::optional<CacheFolder> chosen_cache(const CommandLine& line, const Console& console);

/// The stages' options as the flags say.
StageOptions stage_options(const CommandLine& line, const Console& console, const Experiment& experiment,
                           const dvec3& origin = dvec3(0.0));

/// Throws Error (usage) if run.for is given, but no bias of our own techniques is measured.
void check_bias_engines(const Experiment& experiment, bool measures_shadows);

/// Notes the lights without the extent that the technique takes its kernel from.
void add_technique_notes(Stages& stages, const Experiment& experiment, const std::vector<std::uint32_t>& lights);

/// Notes the factors of cascades, and each preset: what differs in its engine, and which of the lights it is not for.
void add_setting_notes(Stages& stages, const CommandLine& line, const Experiment& experiment,
                       const std::vector<std::uint32_t>& lights);

/// Names what drew: the engine, or the OpenGL device.
void set_renderer(RunResults& results, Stages& stages);

/// Prints what fails and the answer; ExitCode::check_failed if a bound is broken.
ExitCode show_checks(const Console& console, const std::vector<GateCheck>& checks);

/// Writes the reply to each line of stdin, until its end. Throws Error when SIGINT or SIGTERM arrives.
ExitCode serve_lines(const std::function<std::string(const std::string&)>& reply);

ExitCode run_image_command(const CommandLine& line, const Console& console);  ///< compare, evaluate, trace, raster
ExitCode run_sweep_command(const CommandLine& line, const Console& console);
ExitCode run_tune_command(const CommandLine& line, const Console& console);
ExitCode run_plan(const CommandLine& line, const Console& console);
ExitCode run_shards(const CommandLine& line, const Console& console);
ExitCode run_merge(const CommandLine& line, const Console& console);
ExitCode run_status(const CommandLine& line, const Console& console);
ExitCode run_diff(const CommandLine& line, const Console& console);
ExitCode run_report(const CommandLine& line, const Console& console);
ExitCode run_check(const CommandLine& line, const Console& console);
ExitCode run_scenes(const CommandLine& line, const Console& console);
ExitCode run_scene(const CommandLine& line, const Console& console);
ExitCode run_cache(const CommandLine& line, const Console& console);
ExitCode run_presets(const Console& console);
ExitCode run_convert(const CommandLine& line, const Console& console);
ExitCode run_engine(const CommandLine& line, const Console& console);
ExitCode run_serve(const CommandLine& line, const Console& console);
ExitCode run_info(const CommandLine& line, const Console& console);
ExitCode run_parameters(const CommandLine& line);

}  // namespace umbrameter
