#include "store/preset.h"

#include <algorithm>

#include "core/error.h"
#include "core/suggestion.h"
#include "reports/files/data.h"
#include "reports/files/data_folder.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;

bool is_one_of(const std::string& word, std::span<const std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

Preset read_preset(const fs::path& path) {
  Preset preset;
  preset.name = path.stem().string();
  preset.file = path;
  const std::pair<std::string_view, std::string*> texts[] = {
      {"preset.engine", &preset.engine},  {"preset.meaning", &preset.meaning},     {"preset.kind", &preset.kind},
      {"preset.source", &preset.source},  {"preset.confirmed", &preset.confirmed}, {"preset.numbers", &preset.numbers},
      {"preset.differs", &preset.differs}};
  for (auto& [key, value] : read_experiment(path).values) {
    const auto* text = std::ranges::find(texts, key, &std::pair<std::string_view, std::string*>::first);
    if (text != std::end(texts)) {
      *text->second = to_string(value);
    } else {
      preset.values.emplace_back(key, value);
    }
  }
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw Error(ExitCode::usage, path.string(), what, "see presets/README.md");
  };
  require(!preset.engine.empty() && !preset.meaning.empty() && !preset.source.empty(),
          "[preset] needs engine, meaning and source");
  require(is_one_of(preset.kind, preset_kinds), "preset.kind must be directional, spot, point or ao");
  require(is_one_of(preset.confirmed, preset_confirmations), "preset.confirmed must be run, source or second-hand");
  const std::string group = preset.kind == "ao" ? "ao." : "shadow.";
  require(std::ranges::all_of(preset.values, [&](const auto& value) { return value.first.starts_with(group); }),
          "a preset sets parameters of [shadow], or of [ao] if that is its kind");
  return preset;
}

}  // namespace

std::vector<Preset> installed_presets() {
  std::vector<Preset> presets;
  const fs::path folder = data_folder() / "presets";
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error) {
    throw Error(ExitCode::unreadable_input, folder.string(), error.message(), "set UMBRAMETER_DATA to its folder");
  }
  for (const fs::directory_entry& entry : entries) {
    if (entry.path().extension() == ".toml") presets.push_back(read_preset(entry.path()));
  }
  std::ranges::sort(presets, {}, &Preset::name);
  return presets;
}

Preset require_preset(const std::string& name) {
  const std::vector<Preset> presets = installed_presets();
  const auto found = std::ranges::find(presets, name, &Preset::name);
  if (found == presets.end()) {
    std::vector<std::string> names;
    for (const Preset& each : presets) names.push_back(each.name);
    const std::string similar = suggestion(similar_names(name, names));
    throw Error(ExitCode::usage, "--preset '" + name + "'", "there is no such preset",
                similar.empty() ? "'umbrameter presets' lists them" : similar);
  }
  return *found;
}

void apply_preset(const Preset& preset, const Parameters& parameters) {
  for (const auto& [key, value] : preset.values) require(parameters, key).set(value);
}

}  // namespace umbrameter
