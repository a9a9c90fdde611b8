#include "store/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "reports/files/output.h"
#include "results/known_statistics.h"
#include "store/summary_version.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

double number_of(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// The numbers of the blocks "statistics" and "metrics". A described statistic hides a metric of the same name.
void read_part(const Json& part, const MeasuredStatistic& of_part, std::vector<MeasuredStatistic>& all) {
  const Json statistics = part.value("statistics", Json::object());
  const int degrees_of_freedom = part.value("/truth/degrees_of_freedom"_json_pointer, 0);
  const double pixels = statistics.contains("pixels") ? number_of(statistics["pixels"]) : 0.0;
  const std::size_t first = all.size();
  for (const char* block : {"statistics", "metrics"}) {
    if (!part.contains(block) || !part[block].is_object()) continue;
    const Json& values = part[block];
    for (const auto& [name, value] : values.items()) {
      const bool is_end =
          (name.ends_with("_lo") || name.ends_with("_hi")) && values.contains(name.substr(0, name.size() - 3));
      const bool is_repeated = std::any_of(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                                           [&n = name](const MeasuredStatistic& each) { return each.name == n; });
      if (is_end || is_repeated || !(value.is_number() || value.is_null())) continue;
      MeasuredStatistic& measured = all.emplace_back(of_part);
      measured.name = name;
      const KnownStatistic* known = find_known(measured.kind, name);
      if (known != nullptr) measured.unit = known->unit;
      measured.value = measured.lower = number_of(value);
      measured.degrees_of_freedom = degrees_of_freedom;
      if (values.contains(name + "_lo") && values.contains(name + "_hi")) {
        measured.lower = number_of(values[name + "_lo"]);
        // Below the value, bounds also hold what its noise may have added.
        measured.half_width = number_of(values[name + "_hi"]) - measured.value;
      } else if (known != nullptr && known->is_share && pixels > 0.0) {
        measured.pixel_share = 1.0 / pixels;
      }
    }
  }
}

bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

// Whether the entry is of the part of a run, a light or AO, that has the statistic.
bool names_part(const BudgetEntry& entry, const MeasuredStatistic& measured) {
  const StatisticName name = parse_statistic_name(entry.statistic);
  const std::string& kind = name.kind.empty() ? entry.kind : name.kind;
  const bool is_light = entry.light.empty() || equal_words(entry.light, measured.light) ||
                        (measured.light_index >= 0 && entry.light == std::to_string(measured.light_index));
  return (kind.empty() || kind == measured.kind) && (entry.scene.empty() || entry.scene == measured.scene) && is_light;
}

bool names(const BudgetEntry& entry, const MeasuredStatistic& measured) {
  return parse_statistic_name(entry.statistic).name == measured.name && names_part(entry, measured);
}

bool is_same_part(const MeasuredStatistic& a, const MeasuredStatistic& b) {
  return a.run == b.run && a.scene == b.scene && a.kind == b.kind && a.light == b.light;
}

// Some run reports it, or some run could.
void require_known(const BudgetEntry& entry, const std::vector<MeasuredStatistic>& measured) {
  StatisticName name = parse_statistic_name(entry.statistic);
  if (name.kind.empty()) name.kind = entry.kind;
  const bool is_measured = std::ranges::any_of(measured, [&](const MeasuredStatistic& each) {
    return each.name == name.name && (name.kind.empty() || each.kind == name.kind);
  });
  if (!is_measured) require_statistic(name, entry.place);
}

double value_for(const BudgetEntry& entry, const MeasuredStatistic& measured) {
  return entry.is_magnitude ? std::abs(measured.value) : measured.value;
}

GateCheck check(const BudgetEntry& entry, const MeasuredStatistic& measured) {
  GateCheck result{entry, measured};
  const std::string unit = measured.unit.empty() ? entry.bound.quantity.unit : measured.unit;
  result.bound = in_unit(entry.bound.quantity, unit, measured.name, entry.place);
  const double value = value_for(entry, measured);
  result.is_kept = holds(value, entry.bound.relation, result.bound);  // false for NaN
  result.excess = is_upper(entry.bound.relation) ? value - result.bound : result.bound - value;
  // The half of the interval that lies towards the bound; the lower one is longer where noise adds to an error. The
  // magnitude of a negative value falls where the value rises.
  const bool is_mirrored = value != measured.value;
  const bool is_lower = is_mirrored ? value < result.bound : value > result.bound;
  const double half = is_lower ? measured.value - measured.lower : measured.half_width;
  result.intervals = half > 0.0 ? result.excess / half : std::numeric_limits<double>::quiet_NaN();
  return result;
}

// To two significant digits of the head room, away from the value.
double rounded_out(double bound, double room, bool up) {
  if (!(room > 0.0)) return bound;
  const double step = std::pow(10.0, std::floor(std::log10(room)) - 1.0);
  const double steps = up ? std::ceil(bound / step - 1e-9) : std::floor(bound / step + 1e-9);
  return std::stod(fmt::format("{:.12g}", steps * step));
}

void set_bound(BudgetEntry& entry, const std::vector<const MeasuredStatistic*>& measured) {
  const bool up = is_upper(entry.bound.relation);
  const MeasuredStatistic& worst =
      **std::ranges::max_element(measured, [&](const MeasuredStatistic* a, const MeasuredStatistic* b) {
        return up ? value_for(entry, *a) < value_for(entry, *b) : value_for(entry, *a) > value_for(entry, *b);
      });
  const double value = value_for(entry, worst);
  const double room = worst.head_room();
  const double scale = worst.unit == "1" ? 100.0 : 1.0;
  const double bound = rounded_out(scale * (up ? value + room : value - room), scale * room, up);
  entry.bound.relation = up ? Relation::at_most : Relation::at_least;
  entry.bound.quantity = {bound, worst.unit == "1" ? "%" : ""};
}

std::vector<BudgetEntry> budget_for(const std::vector<MeasuredStatistic>& measured) {
  std::vector<BudgetEntry> budget;
  for (const MeasuredStatistic& each : measured) {
    const KnownStatistic* known = find_known(each.kind, each.name);
    if (known == nullptr || !known->is_error || !std::isfinite(each.value)) continue;
    const bool is_repeated = std::ranges::any_of(budget, [&](const BudgetEntry& other) {
      return other.statistic == each.name && other.scene == each.scene && other.kind == each.kind &&
             other.light == each.light;
    });
    if (is_repeated) continue;  // of another run of the scene
    BudgetEntry entry;
    entry.statistic = each.name;
    entry.is_magnitude = is_signed_error(each.name);
    entry.bound.relation = known->is_higher_better ? Relation::at_least : Relation::at_most;
    entry.scene = each.scene;
    entry.kind = each.kind;
    entry.light = each.light;
    budget.push_back(std::move(entry));
  }
  return budget;
}

}  // namespace

std::vector<MeasuredStatistic> read_statistics(const std::string& text, const std::string& file) {
  const Json summary = Json::parse(text, nullptr, false);
  const auto refuse = [&](const char* why) {
    throw Error(ExitCode::unreadable_input, file, why, "give the folder of a finished compare or sweep");
  };
  require_known_schema(summary, file);
  if (!summary.is_object() || !summary.contains("scene") || !summary["scene"].is_object()) refuse("is no summary");
  std::vector<MeasuredStatistic> all;
  try {
    MeasuredStatistic part;
    part.scene = summary["scene"].value("name", "");
    const Json cell = summary.value("cell", Json::object());
    for (const auto& [key, value] : cell.items()) {
      if (!key.starts_with("view.") && !key.starts_with("scene.")) continue;
      part.view +=
          (part.view.empty() ? "" : ", ") + key + " " + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    for (const Json& shadow : summary.value("shadows", Json::array())) {
      part.kind = "shadow";
      part.light = shadow.value("light", "");
      part.light_index = shadow.value("index", -1);
      read_part(shadow, part, all);
    }
    part.light.clear();
    part.light_index = -1;
    for (const char* kind : {"ao", "image"}) {
      part.kind = kind;
      if (summary.contains(kind)) read_part(summary[kind], part, all);
    }
  } catch (const Json::exception&) {
    refuse("is damaged");
  }
  if (all.empty() && summary.contains("tuning")) {
    throw Error(ExitCode::unreadable_input, file, "is of a tuning, whose points are not compared here",
                "measure its result first, for each scene and camera: umbrameter compare -c tuned.toml -o DIR");
  }
  if (all.empty()) refuse("holds no statistics, because the run compared nothing");
  return all;
}

std::string run_name(const std::filesystem::path& folder) {
  return std::filesystem::absolute(folder / ".").lexically_normal().parent_path().filename().string();
}

std::vector<MeasuredStatistic> read_run(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "summary.json";
  const std::optional<std::string> text = text_of_file(path);
  if (!text) {
    throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), "there is no such file",
                "give the folder of a finished compare or sweep");
  }
  std::vector<MeasuredStatistic> statistics = read_statistics(*text, path.string());
  for (MeasuredStatistic& each : statistics) each.run = run_name(folder);
  return statistics;
}

std::vector<GateCheck> check_budget(const std::vector<BudgetEntry>& budget,
                                    const std::vector<MeasuredStatistic>& measured) {
  std::vector<GateCheck> checks;
  for (const BudgetEntry& entry : budget) {
    require_known(entry, measured);
    const std::size_t before = checks.size();
    for (const MeasuredStatistic& each : measured) {
      if (names(entry, each)) checks.push_back(check(entry, each));
    }
    if (checks.size() == before) checks.push_back({entry, {}, entry.bound.quantity.number});
  }
  return checks;
}

std::vector<BudgetEntry> budgets_of(const std::vector<std::string>& fail_if) {
  std::vector<BudgetEntry> budget;
  for (const std::string& text : fail_if) {
    const Condition condition = parse_condition(text, "--fail-if");
    BudgetEntry entry;
    entry.statistic = condition.name;
    entry.is_magnitude = condition.is_magnitude;
    entry.bound = condition.bound;
    entry.place = "--fail-if '" + text + "'";
    switch (condition.bound.relation) {
      case Relation::less:
        entry.bound.relation = Relation::at_least;
        break;
      case Relation::at_most:
        entry.bound.relation = Relation::greater;
        break;
      case Relation::greater:
        entry.bound.relation = Relation::at_most;
        break;
      case Relation::at_least:
        entry.bound.relation = Relation::less;
        break;
    }
    const std::vector<KnownStatistic> known = require_statistic(parse_statistic_name(entry.statistic), entry.place);
    in_unit(entry.bound.quantity, known.front().unit, known.front().name, entry.place);
    budget.push_back(std::move(entry));
  }
  return budget;
}

std::vector<MeasuredStatistic> unbounded(const std::vector<BudgetEntry>& budget,
                                         const std::vector<MeasuredStatistic>& measured) {
  const auto is_same_run = [](const MeasuredStatistic& a, const MeasuredStatistic& b) {
    return a.run == b.run && a.scene == b.scene;
  };
  std::vector<MeasuredStatistic> all;
  for (const MeasuredStatistic& each : measured) {
    const bool is_bounded = std::ranges::any_of(measured, [&](const MeasuredStatistic& other) {
      return is_same_run(each, other) &&
             std::ranges::any_of(budget, [&](const BudgetEntry& entry) { return names(entry, other); });
    });
    if (!is_bounded) all.push_back(each);
  }
  return all;
}

std::vector<UncheckedBounds> unchecked_bounds(const std::vector<BudgetEntry>& budget,
                                              const std::vector<MeasuredStatistic>& measured) {
  std::vector<UncheckedBounds> all;
  std::vector<const MeasuredStatistic*> parts;
  for (const MeasuredStatistic& each : measured) {
    if (std::ranges::any_of(parts, [&](const MeasuredStatistic* other) { return is_same_part(*other, each); }))
      continue;
    parts.push_back(&each);
    UncheckedBounds left{each.run, each.scene + (each.light.empty() ? "" : ", ") + each.light, {}};
    for (const BudgetEntry& entry : budget) {
      const auto is_named = [&](const MeasuredStatistic& other) { return names(entry, other); };
      // What no run has fails.
      const bool could_have = find_known(each.kind, parse_statistic_name(entry.statistic).name) != nullptr;
      if (!could_have || !names_part(entry, each) || std::ranges::none_of(measured, is_named)) continue;
      const bool is_here = std::ranges::any_of(
          measured, [&](const MeasuredStatistic& other) { return is_same_part(other, each) && is_named(other); });
      if (!is_here) left.statistics.push_back(entry.statistic);
    }
    if (!left.statistics.empty()) all.push_back(std::move(left));
  }
  return all;
}

std::vector<BudgetEntry> update_budget(std::vector<BudgetEntry> budget,
                                       const std::vector<MeasuredStatistic>& measured) {
  std::ranges::copy(budget_for(unbounded(budget, measured)), std::back_inserter(budget));
  for (BudgetEntry& entry : budget) {
    if (!entry.place.empty()) require_known(entry, measured);
    std::vector<const MeasuredStatistic*> named;
    for (const MeasuredStatistic& each : measured) {
      if (names(entry, each) && std::isfinite(each.value)) named.push_back(&each);
    }
    if (!named.empty()) set_bound(entry, named);
  }
  return budget;
}

}  // namespace umbrameter
