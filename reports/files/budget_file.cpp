#include "reports/files/budget_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/parameters.h"
#include "core/suggestion.h"
#include "reports/files/output.h"
#include "reports/files/toml_text.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 3> kinds = {"shadow", "ao", "image"};

class EntryReader {
 public:
  EntryReader(const std::filesystem::path& path, const toml::table& table)
      : path_(path), table_(table), place_(place_of(path, table)) {}

  BudgetEntry read() {
    static const std::vector<std::string> known = {"statistic", "bound", "scene", "kind", "light"};
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::ranges::find(known, name) != known.end()) continue;
      const std::string similar = suggestion(similar_names(name, known));
      throw Error(ExitCode::usage, place_of(path_, node), fmt::format("unknown key '{}'", name),
                  similar.empty() ? "a budget has statistic, bound, scene, kind and light" : similar);
    }
    BudgetEntry entry;
    entry.place = place_;
    entry.statistic = text("statistic");
    if (entry.statistic.empty()) throw Error(ExitCode::usage, place_, "a budget needs 'statistic', such as \"acne\"");
    if (entry.statistic.size() > 2 && entry.statistic.front() == '|' && entry.statistic.back() == '|') {
      entry.is_magnitude = true;
      entry.statistic = entry.statistic.substr(1, entry.statistic.size() - 2);
    }
    entry.bound = bound();
    entry.scene = text("scene");
    entry.kind = text("kind");
    if (!entry.kind.empty() && std::ranges::find(kinds, entry.kind) == kinds.end()) {
      throw Error(ExitCode::usage, place_of(path_, *table_.get("kind")), fmt::format("'{}' is no kind", entry.kind),
                  "choose shadow, ao or image");
    }
    entry.light = light();
    return entry;
  }

 private:
  std::string text(const char* key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return {};
    if (const auto* value = node->as_string()) return value->get();
    throw Error(ExitCode::usage, place_of(path_, *node), fmt::format("'{}' must be a string", key),
                "write it in quotes");
  }

  // A name, or the number of a light.
  std::string light() const {
    const toml::node* node = table_.get("light");
    if (node != nullptr && node->is_integer()) return std::to_string(node->as_integer()->get());
    return text("light");
  }

  Bound bound() const {
    const toml::node* node = table_.get("bound");
    if (node == nullptr) throw Error(ExitCode::usage, place_, "a budget needs 'bound', such as \"< 0.1%\"");
    if (const auto* value = node->as_string()) return parse_bound(value->get(), place_of(path_, *node));
    if (const auto number = node->value<double>(); node->is_number() && number) {
      if (std::isfinite(*number)) return {Relation::at_most, {*number, {}}};
      throw Error(ExitCode::usage, place_of(path_, *node), "the bound must be a finite number");
    }
    throw Error(ExitCode::usage, place_of(path_, *node), "'bound' must be a number or a string",
                "write it like 0.001 or \"< 0.1%\"");
  }

  const std::filesystem::path& path_;
  const toml::table& table_;
  std::string place_;
};

std::string bound_text(const Bound& bound) {
  const std::string& unit = bound.quantity.unit;
  return fmt::format("{} {}{}{}", relation_text(bound.relation), to_string(Value(bound.quantity.number)),
                     unit.empty() || unit == "%" ? "" : " ", unit);
}

}  // namespace

std::vector<BudgetEntry> read_budget(const std::filesystem::path& path) {
  const toml::table file = parse_toml_file(path, "a budget file");
  for (const auto& [key, node] : file) {
    if (key.str() == "budget") continue;
    throw Error(ExitCode::usage, place_of(path, node), fmt::format("unknown key '{}'", key.str()),
                "a budget file holds only [[budget]] tables");
  }
  const toml::node* node = file.get("budget");
  const toml::array* list = node != nullptr ? node->as_array() : nullptr;
  if (node != nullptr && list == nullptr) {
    throw Error(ExitCode::usage, place_of(path, *node), "'budget' must be a list of tables", "write [[budget]]");
  }
  if (list == nullptr || list->empty()) {
    throw Error(ExitCode::usage, path.string(), "it holds no [[budget]]",
                "'umbrameter check DIR --budget FILE --update' writes one");
  }
  std::vector<BudgetEntry> entries;
  for (const toml::node& each : *list) {
    const toml::table* table = each.as_table();
    if (table == nullptr) {
      throw Error(ExitCode::usage, place_of(path, each), "'budget' must be a list of tables", "write [[budget]]");
    }
    entries.push_back(EntryReader(path, *table).read());
  }
  return entries;
}

void write_budget(const std::filesystem::path& path, const std::vector<BudgetEntry>& entries) {
  std::string text =
      "# Bounds for `umbrameter check DIR --budget FILE`; `--update` sets them to the present values and some head "
      "room.\n";
  for (const BudgetEntry& entry : entries) {
    text += "\n[[budget]]\n";
    const auto line = [&](const char* key, const std::string& value) {
      if (!value.empty()) text += fmt::format("{} = {}\n", key, toml_string(value));
    };
    line("scene", entry.scene);
    line("kind", entry.kind);
    line("light", entry.light);
    line("statistic", entry.is_magnitude ? fmt::format("|{}|", entry.statistic) : entry.statistic);
    line("bound", bound_text(entry.bound));
  }
  write_text(path, text);
}

}  // namespace umbrameter
