#include "app/tune_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "experiments/stages/reference_key.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

// A case that the search sees proves nothing of the result.
void require_unseen(const TuneJob& job, const std::vector<TuneCase>& cases, const std::vector<TuneCase>& held_out) {
  for (const TuneCase& unseen : held_out) {
    for (const TuneCase& each : cases) {
      if (each.title != unseen.title || each.experiment.scene != unseen.experiment.scene) continue;
      std::string given;
      for (const auto& [key, text] : job.held_out) given += fmt::format(" --held-out {}={}", key, text);
      throw Error(ExitCode::usage, given.empty() ? "held-out case" : given.substr(1),
                  fmt::format("the search uses this case, too: {}", each.title),
                  "hold out a camera or a scene that the search does not use");
    }
  }
}

}  // namespace

TuneRun::TuneRun(const CommandLine& given_line, std::vector<Experiment> experiments)
    : line(given_line), job(make_tune_job(line.tune, std::move(experiments))) {}

// The scenes share an OpenGL context.
Stages& TuneRun::load_stages(const Experiment& experiment, const Console& console) {
  if (!frames && line.engine) frames = stage_options(line, console, experiment).frames;
  if (!cache) cache = chosen_cache(line, console);
  if (!context && !frames) {
    context = std::make_shared<gl::Context>(gl::Context::make({line.gl_device, line.threads}));
  }
  return stages.emplace_back(load_scene(experiment.scene, experiment.view.scene, experiment.scene_params,
                                        load_options(line, job.quantity == SweptQuantity::image)),
                             StageOptions{line.gl_device, line.threads, cache, experiment.scene, context, frames},
                             console);
}

void TuneRun::load(const Console& console) {
  threads.emplace(line.threads);
  bool varies_map = false;
  for (const TuneAxis& axis : job.axes) varies_map = varies_map || depends_on(Stage::map, axis.key());
  for (const Experiment& experiment : job.experiments) {
    Stages& of_scene = load_stages(experiment, console);
    by_scene.push_back(cases_of(of_scene, experiment, job.quantity, job.over));
    of_scene.keep_cases(by_scene.back().size(), !varies_map);
    cases.insert(cases.end(), by_scene.back().begin(), by_scene.back().end());
  }
  require_sense(cases);
  hold_out(console);
  std::vector<TuneCase> all = cases;  // a held-out case may have other lights
  all.insert(all.end(), unseen.begin(), unseen.end());
  require_sense(all);
  require_unseen(job, cases, unseen);
  for (const TuneCase& each : cases) require_statistics(each, job.shown);
}

// The cases that --held-out names; by default, a camera of the first scene that has one left.
void TuneRun::hold_out(const Console& console) {
  const auto add = [&](Stages& of_scene, const Experiment& experiment, const CaseAxes& over) {
    const std::vector<TuneCase> more = cases_of(of_scene, experiment, job.quantity, over);
    unseen.insert(unseen.end(), more.begin(), more.end());
  };
  CaseAxes over = job.over;
  for (const auto& [key, text] : job.held_out) {
    if (key == "scene") continue;
    std::erase_if(over, [&, &k = key](const auto& each) { return each.first == k; });
    over.emplace_back(key, text);
  }
  bool names_scenes = false;
  for (const auto& [key, text] : job.held_out) {
    if (key != "scene") continue;
    names_scenes = true;
    Experiment experiment = job.experiments.front();
    experiment.scene = text;
    CaseAxes without_names = job.held_out;  // cameras and lights of other scenes mean nothing here
    std::erase_if(without_names, [](const auto& each) { return each.first == "scene"; });
    add(load_stages(experiment, console), experiment, without_names);
  }
  if (names_scenes) return;
  for (std::size_t s = 0; s < by_scene.size(); ++s) {
    if (!job.held_out.empty()) {
      add(*by_scene[s].front().stages, job.experiments[s], over);
      continue;
    }
    const std::string camera = unused_camera(by_scene[s]);
    if (camera.empty()) continue;
    std::erase_if(over, [](const auto& each) { return each.first == "view.camera"; });
    Experiment experiment = job.experiments[s];
    experiment.view.camera = camera;
    add(*by_scene[s].front().stages, experiment, over);
  }
}

Identity TuneRun::identity() {
  Identity settings = measuring_identity(stages.front());
  settings.emplace_back("the cost", line.tune.minimize);
  const auto list = [&](const char* name, const auto& texts) {
    std::string all;
    for (const auto& text : texts) all += text + "\n";
    settings.emplace_back(name, all);
  };
  list("a constraint", line.tune.constraints);
  std::vector<std::string> axes;
  for (const TuneAxis& axis : job.axes) axes.push_back(axis.key() + "=" + axis.axis.text);
  list("an axis", axes);
  for (std::size_t s = 0; s < by_scene.size(); ++s) {
    Stages& of_scene = *by_scene[s].front().stages;
    std::string text = scene_content(of_scene.scene());
    for (const TuneCase& each : by_scene[s]) {
      Experiment experiment = each.experiment;
      text += "\n" + each.title + " " + surfel_content(of_scene.surfels(experiment)->gbuffer) + "\n" +
              umbrameter::key_of(describe(experiment));
    }
    settings.emplace_back(fmt::format("scene {}", s + 1), text);
  }
  return settings;
}

std::vector<std::string> TuneRun::notes() const {
  std::vector<std::string> all;
  for (const auto& of_scene : by_scene) {
    for (const std::string& text : of_scene.front().stages->notes()) {
      if (std::ranges::find(all, text) == all.end()) all.push_back(text);
    }
  }
  return all;
}

SearchInput TuneRun::search_input(std::optional<std::size_t> exact) const {
  return {job.axes, job.goal, job.given, line.tune.evaluations, exact};
}

}  // namespace umbrameter
