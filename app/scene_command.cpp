#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/commands.h"
#include "app/print_json.h"
#include "core/standard_streams.h"
#include "experiments/stages/byte_size.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "reports/files/value_json.h"
#include "scenes/builtin.h"
#include "scenes/gltf.h"

namespace umbrameter {

SceneChoice chosen_scene(const CommandLine& line) {
  Experiment experiment;
  const Parameters parameters = describe(experiment);
  for (const auto& [key, text] : line.settings) require(parameters, key).set_text(text);
  return {experiment.view.scene, experiment.scene_params};
}

LoadOptions load_options(const CommandLine& line, bool materials) {
  LoadOptions options;
  options.materials = materials;
  if (!line.memory.empty()) {
    options.memory = parse_bytes(line.memory, "--memory " + line.memory, "write it like 512M or 8G");
  }
  return options;
}

ExitCode run_scene(const CommandLine& line, const Console& console) {
  std::string ending = line.output.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".glb") {
    throw Error(ExitCode::usage, "-o " + line.output.string(), "a scene is written as binary glTF", "name a .glb file");
  }
  const SceneChoice choice = chosen_scene(line);
  const Scene scene = load_scene(line.scene, choice.part, choice.scene_params, load_options(line));
  for (const std::string& text : scene.notes) note(console, text);
  const std::vector<unsigned char> glb = to_glb(scene);
  write_text(line.output, {reinterpret_cast<const char*>(glb.data()), glb.size()});
  print_line(console, fmt::format("{}: {} triangles, {}", line.output.string(), grouped(count(scene).triangles),
                                  bytes_text(glb.size())));
  print_json(console, {{"file", line.output.string()}, {"bytes", glb.size()}, {"triangles", count(scene).triangles}});
  return ExitCode::ok;
}

ExitCode run_parameters(const CommandLine& line) {
  if (line.json) {
    Experiment experiment;
    nlohmann::ordered_json json = {{"version", UMBRAMETER_VERSION}, {"parameters", nlohmann::ordered_json::array()}};
    for (const Parameter& parameter : describe(experiment)) json["parameters"].push_back(to_json(parameter, "default"));
    write_to(stdout, json.dump(1) + "\n");
    return ExitCode::ok;
  }
  if (line.markdown) {
    write_to(stdout, parameter_reference());
    return ExitCode::ok;
  }
  Experiment experiment;
  std::vector<std::vector<std::string>> rows = {{"parameter", "default", "unit", "meaning; limits"}};
  for (const Parameter& parameter : describe(experiment)) {
    const std::string value = to_string(parameter.value());
    const FieldDescription& description = parameter.description;
    rows.push_back({parameter.key, value.empty() ? "—" : value, description.unit == "1" ? "" : description.unit,
                    description.meaning + "; " + parameter.limits()});
  }
  for (const std::string& text : aligned(rows)) write_to(stdout, text + "\n");
  return ExitCode::ok;
}

}  // namespace umbrameter
