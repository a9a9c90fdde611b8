// umbrameter presets: lists the engines' settings that --preset takes.
#include <cstdio>

#include "app/commands.h"
#include "app/print_json.h"
#include "reports/files/text_layout.h"
#include "store/preset.h"

namespace umbrameter {

using Json = nlohmann::ordered_json;

ExitCode run_presets(const Console& console) {
  Json json = Json::array();
  std::vector<std::vector<std::string>> rows = {{"preset", "for", "engine", "confirmed by", "what it sets"}};
  for (const Preset& preset : installed_presets()) {
    rows.push_back({preset.name, preset.kind, preset.engine, preset.confirmed, preset.meaning});
    Json values;
    for (const auto& [key, value] : preset.values) {
      std::visit([&, &k = key](const auto& number) { values[k] = number; }, value);
    }
    json.push_back({{"name", preset.name},
                    {"kind", preset.kind},
                    {"engine", preset.engine},
                    {"meaning", preset.meaning},
                    {"confirmed", preset.confirmed},
                    {"source", preset.source},
                    {"numbers", preset.numbers},
                    {"differs", preset.differs},
                    {"file", preset.file.string()},
                    {"values", values}});
  }
  for (const std::string& text : aligned(rows)) print_line(console, text);
  add_line(console,
           "confirmed by: run, compared with the running engine (differences: docs/engine-presets.md); source, its "
           "source says so; "
           "second-hand, a copy or a description of it does.");
  add_line(
      console,
      "Measure one: umbrameter compare courtyard --light sun --preset NAME -o out, with --light spot or lantern for "
      "those of spot and point lights, and --measure ao for those of ambient occlusion. Flags override a preset.");
  print_json(console, json);
  return ExitCode::ok;
}

}  // namespace umbrameter
