// umbrameter convert: a shadow bias of one engine in the numbers of others, for the map of a scene's light.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/print_json.h"
#include "core/parallel.h"
#include "core/standard_streams.h"
#include "present/bias_conversion.h"
#include "reports/files/text_layout.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

std::uint32_t only_light(const Stages& stages, const Experiment& experiment) {
  const std::vector<std::uint32_t> lights = stages.lights(experiment.view.light);
  if (lights.size() == 1) return lights.front();
  throw Error(ExitCode::usage, "convert",
              fmt::format("the scene has {} lights, and each has its own map", lights.size()),
              fmt::format("add --light NAME, such as --light '{}'", stages.title(lights.front())));
}

std::string map_text(const Stages& stages, const Experiment& experiment, std::uint32_t light, const MapLayout& layout) {
  const std::string cascades = layout.kind == MapKind::orthographic && layout.views.size() > 1
                                   ? fmt::format("{} cascades of {}² texels", layout.views.size(), layout.resolution)
                                   : fmt::format("a map of {}² texels", layout.resolution);
  return fmt::format("{}, {} ({}): {}", experiment.scene, shortened(stages.title(light), 60),
                     kind_of(stages.light(experiment, light)), cascades);
}

}  // namespace

ExitCode run_convert(const CommandLine& line, const Console& console) {
  if (line.markdown) {
    write_to(stdout, bias_engines_markdown());
    return ExitCode::ok;
  }
  if (line.convert.from.empty()) {
    throw Error(ExitCode::usage, "--from", "no bias given", "for example --from godot:bias=0.1 or --from metres:0.05");
  }
  const BiasSpec source = parse_bias_source(line.convert.from);
  std::vector<BiasSpec> targets;
  for (const std::string& text : line.convert.to) {
    for (BiasSpec& target : parse_bias_targets(text)) targets.push_back(std::move(target));
  }
  Experiment given = make_experiment(line);
  given.view.surfels = SurfelSource::traced;  // the layout is the same, and needs no OpenGL
  const ThreadLimit threads(line.threads);
  Scene scene = load_scene(given.scene, given.view.scene, given.scene_params, load_options(line));
  Stages stages(std::move(scene), {{}, line.threads, {}, given.scene}, console);
  const Experiment experiment = stages.in_metres(given);
  const std::uint32_t light = only_light(stages, experiment);
  stages.check_is_meaningful(experiment, {light});
  const MapLayout layout = with_depth_encoding(*stages.layout(experiment, light), experiment.shadow.map_depth);
  const std::vector<MapPlace> places =
      places_of(stages.light(experiment, light), layout, stages.surfels(experiment)->gbuffer);
  if (places.size() < static_cast<std::size_t>(experiment.shadow.map.cascades)) {
    note(console, fmt::format("{} of {} cascades: the others would be no finer than the last", places.size(),
                              experiment.shadow.map.cascades));
  }
  const ConvertedBias bias = convert_bias(source, std::move(targets), places);
  if (places.front().name == nearest_receiver) {
    note(console, fmt::format("the nearest and the farthest receiver are found among the pixels of a {}x{} image: "
                              "another --size or --camera can find others, with texels of another size",
                              experiment.view.size.width, experiment.view.size.height));
  }

  const std::string map = map_text(stages, experiment, light, layout);
  print_line(console, map);
  for (const std::string& text : to_lines(bias)) print_line(console, text);
  for (const std::string& text : conversion_notes(bias)) note(console, text);
  Json json{{"scene", experiment.scene}, {"light", stages.title(light)}, {"resolution", layout.resolution}};
  json.update(to_json(bias));
  print_json(console, json);
  return ExitCode::ok;
}

}  // namespace umbrameter
