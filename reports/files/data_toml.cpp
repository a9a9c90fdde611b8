#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "reports/files/data.h"
#include "reports/files/toml_text.h"

namespace umbrameter {
namespace {

// A comment ends with the line, and TOML allows no control characters in it.
std::string comment_text(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = ' ';
  }
  return text;
}

std::string value_text(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return toml_string(*text);
  std::string text = to_string(value);
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return text;
  if (std::isnan(*number)) return "nan";
  // "1" would read back as an integer, and TOML wants "1.0e+30" or "1e+30" but never "1.".
  if (std::isfinite(*number) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string comment_of(const Parameter& parameter) {
  const FieldDescription& description = parameter.description;
  std::string comment = description.unit.empty() ? "" : "[" + description.unit + "] ";
  comment += description.meaning;
  if (std::holds_alternative<ChoiceRef>(parameter.field)) comment += ": " + parameter.limits();
  return comment_text(comment);
}

Value to_value(const toml::node& node, const std::string& key, const std::filesystem::path& path) {
  if (const auto* truth = node.as_boolean()) return truth->get();
  if (const auto* integer = node.as_integer()) return std::int64_t{integer->get()};
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  throw Error(ExitCode::usage, place_of(path, node), "'" + key + "' must be a number, true, false or a string");
}

std::string text_of(const toml::node& node, const std::string& key, const std::filesystem::path& path) {
  if (const auto* text = node.as_string()) return text->get();
  throw Error(ExitCode::usage, place_of(path, node), "'" + key + "' must be a string", "write it in quotes");
}

}  // namespace

std::string to_toml(const std::string& scene, const Parameters& parameters,
                    const std::vector<std::pair<std::string, std::string>>& axes) {
  // A top-level key and a table cannot have the same name.
  const bool is_table =
      std::ranges::any_of(parameters, [](const Parameter& parameter) { return parameter.key.starts_with("scene."); });
  std::string text = is_table ? "" : "scene = " + toml_string(scene) + "\n";
  std::string group;
  for (const Parameter& parameter : parameters) {
    const std::size_t dot = parameter.key.find('.');
    const std::string of = parameter.key.substr(0, dot);
    if (of != group) {
      group = of;
      text += (text.empty() ? "[" : "\n[") + group + "]\n";
      if (group == "scene") text += "source = " + toml_string(scene) + "  # file, or name of a built-in scene\n";
    }
    text +=
        parameter.key.substr(dot + 1) + " = " + value_text(parameter.value()) + "  # " + comment_of(parameter) + "\n";
  }
  if (axes.empty()) return text;
  text += "\n[vary]  # first:last:count, first:last:count:log, or a list\n";
  for (const auto& [key, axis] : axes) text += toml_string(key) + " = " + toml_string(axis) + "\n";
  return text;
}

ExperimentFile read_experiment(const std::filesystem::path& path) {
  const toml::table table = parse_toml_file(path, "an experiment file such as experiment.toml");
  // toml++ sorts keys; the order of the lines is what the user wrote, and the order of axes means something.
  std::vector<std::pair<toml::source_position, std::pair<std::string, std::string>>> axes;
  ExperimentFile result;
  for (const auto& [name, node] : table) {
    const std::string group(name.str());
    if (group == "scene" && !node.is_table()) {
      result.scene = text_of(node, group, path);
      continue;
    }
    const toml::table* members = node.as_table();
    if (members == nullptr) {
      throw Error(ExitCode::usage, place_of(path, node), "'" + group + "' is outside any table",
                  "only 'scene' may be there; parameters belong under [scene], [view], [shadow], [ao], [truth], [run] "
                  "or [vary]");
    }
    for (const auto& [member, value] : *members) {
      const std::string key(member.str());
      result.lines[group + "." + key] = value.source().begin.line;
      if (group == "scene" && key == "source") {
        result.scene = text_of(value, "scene.source", path);
      } else if (group == "vary") {
        axes.push_back({value.source().begin, {key, text_of(value, "vary." + key, path)}});
      } else {
        result.values.emplace_back(group + "." + key, to_value(value, group + "." + key, path));
      }
    }
  }
  std::ranges::sort(axes, [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [position, axis] : axes) result.axes.push_back(std::move(axis));
  return result;
}

}  // namespace umbrameter
