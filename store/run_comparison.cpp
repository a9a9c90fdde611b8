#include "store/run_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/lists.h"
#include "results/known_statistics.h"

namespace umbrameter {
namespace {

const MeasuredStatistic* find_same(const StoredRun& run, const MeasuredStatistic& of_base) {
  const auto found = std::ranges::find_if(run.statistics, [&](const MeasuredStatistic& each) {
    return each.kind == of_base.kind && each.light == of_base.light && each.name == of_base.name;
  });
  return found == run.statistics.end() ? nullptr : &*found;
}

// Those of the first run, then what the others have besides; all of one light, of AO or of the image stand together.
std::vector<MeasuredStatistic> statistics_of_all(const std::vector<StoredRun>& runs) {
  std::vector<MeasuredStatistic> all = runs.front().statistics;
  for (const StoredRun& run : runs) {
    for (const MeasuredStatistic& each : run.statistics) {
      const auto is_of_part = [&](const MeasuredStatistic& a) { return a.kind == each.kind && a.light == each.light; };
      const auto is_same = [&](const MeasuredStatistic& a) { return is_of_part(a) && a.name == each.name; };
      if (std::ranges::any_of(all, is_same)) continue;
      const auto last = std::find_if(all.rbegin(), all.rend(), is_of_part);
      all.insert(last == all.rend() ? all.end() : last.base(), each);
    }
  }
  return all;
}

ComparedValue value_of_run(const std::vector<StoredRun>& runs, std::size_t index, const MeasuredStatistic& measured) {
  ComparedValue value{index, measured};
  if (const std::optional<BlockEstimate> over_blocks = estimate_over_blocks(runs[index], measured)) {
    value.half_width = over_blocks->half_width;
    value.noise = over_blocks->added;
    value.interval = IntervalOf::pixels;
  } else if (measured.half_width > 0.0) {
    value.half_width = measured.half_width;
    value.interval = IntervalOf::rays;
  } else if (const std::size_t blocks = count_counted_blocks(runs[index], measured); blocks < fewest_blocks) {
    value.counted_blocks = blocks;
  }
  return value;
}

void compare_to(const ComparedValue& base, const std::vector<StoredRun>& runs, ComparedValue& value) {
  const double difference = value.measured.value - base.measured.value;
  value.difference = {difference, difference, difference};
  value.verdict = Verdict::no_interval;
  if (!std::isfinite(difference)) return;
  const auto paired = paired_difference(runs[base.run], base.measured, runs[value.run], value.measured);
  // Means differ by rounding where the sums have another order. Equal ones may come from images that differ.
  const double rounding = 1e-12 * std::abs(base.measured.value);
  const bool have_equal_blocks = !paired || paired->half_width <= rounding;
  if (std::abs(difference) <= rounding && have_equal_blocks) {
    value.difference = {};
    value.verdict = Verdict::equal;
    return;
  }
  if (paired) {
    value.difference = paired->interval();
    value.blocks = paired->blocks;
  } else if (base.interval != IntervalOf::nothing && value.interval != IntervalOf::nothing) {
    const double half_width = std::hypot(base.half_width, value.half_width);
    value.difference = {difference, difference - half_width - value.noise, difference + half_width + base.noise};
    if (base.interval == IntervalOf::rays || value.interval == IntervalOf::rays) {
      value.verdict = Verdict::rays_only;
      return;
    }
  } else {
    return;
  }
  const bool excludes_0 = value.difference.lower > 0.0 || value.difference.upper < 0.0;
  value.verdict = excludes_0 ? Verdict::significant : Verdict::not_significant;
}

const std::string& value_of(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& key) {
  static const std::string none = "—";
  for (const auto& [name, value] : pairs) {
    if (name == key) return value;
  }
  return none;
}

std::string size_of(const StoredRun& run) { return value_of(run.parameters, "view.size"); }

// What the description says of one value: "the scene's" of −1, by "…; 0: none, -1: the scene's". Empty if it says
// nothing.
std::string meaning_of(const std::string& value, const std::string& meaning) {
  for (const char* before : {"; ", ", "}) {
    const std::size_t start = meaning.find(before + value + ": ");
    if (start == std::string::npos) continue;
    const std::string said = meaning.substr(start + 2 + value.size() + 2);
    return said.substr(0, said.find_first_of(",;"));
  }
  return {};
}

// A number alone is in the parameter's unit.
std::string with_unit(const Parameters& parameters, const std::string& key, const std::string& value) {
  const Parameter* parameter = find(parameters, key);
  if (parameter == nullptr || !parameter->is_number() || value.empty()) return value;
  if (value.back() < '0' || value.back() > '9') return value;
  if (const std::string said = meaning_of(value, parameter->description.meaning); !said.empty())
    return fmt::format("{} ({})", value, said);
  const std::string& unit = parameter->description.unit;
  return unit.empty() || unit == "1" ? value : value + " " + unit;
}

// Six digits of each number, unless some differ only in later ones.
std::vector<std::string> shortened(const std::vector<std::string>& values) {
  std::vector<std::string> texts;
  for (const std::string& value : values) {
    double number = 0.0;
    const char* end = value.data() + value.size();
    const bool is_number = std::from_chars(value.data(), end, number).ptr == end && !value.empty();
    texts.push_back(is_number && value.size() > 7 ? fmt::format("{:.6g}", number) : value);
  }
  const auto count = [](const std::vector<std::string>& of) { return std::set(of.begin(), of.end()).size(); };
  return count(texts) == count(values) ? texts : values;
}

}  // namespace

Estimate estimate_of(const ComparedValue& value) {
  const double number = value.measured.value;
  const double lower = number - value.half_width - value.noise;
  const double upper = number + value.half_width;
  // Visibility and accessibility lie between 0 and 1, and so do their means and errors.
  const bool ends_at_1 = value.measured.kind != "image" && value.measured.unit == "1" && number <= 1.0;
  return {number, can_be_negative(value.measured.name) ? lower : std::max(lower, 0.0),
          ends_at_1 ? std::min(upper, 1.0) : upper};
}

std::vector<ComparedStatistic> compare_runs(const std::vector<StoredRun>& runs) {
  std::vector<ComparedStatistic> all;
  for (const MeasuredStatistic& first : statistics_of_all(runs)) {
    const KnownStatistic* known = find_known(first.kind, first.name);
    ComparedStatistic compared{first.kind, first.light, first.name, first.unit, known != nullptr && known->is_error,
                               {}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const MeasuredStatistic* measured = find_same(runs[i], first);
      if (measured == nullptr) continue;
      ComparedValue value = value_of_run(runs, i, *measured);
      if (i > 0 && (compared.values.empty() || compared.values.front().run > 0)) {
        value.verdict = Verdict::no_base;
      } else if (i > 0) {
        compare_to(compared.values.front(), runs, value);
      }
      compared.values.push_back(std::move(value));
    }
    all.push_back(std::move(compared));
  }
  return all;
}

std::vector<std::string> limits_of_comparison(const std::vector<StoredRun>& runs) {
  std::vector<std::string> limits;
  const StoredRun& base = runs.front();
  const std::vector<MeasuredStatistic> everything = statistics_of_all(runs);
  for (const StoredRun& run : runs) {
    if (run.scene != base.scene) {
      throw Error(ExitCode::usage, "report " + run.name,
                  fmt::format("it shows the scene '{}', but {} shows '{}', so no statistic of both can be compared",
                              run.scene, base.name, base.scene),
                  "compare runs of one scene");
    }
    if (size_of(run) != size_of(base)) {
      limits.push_back(
          fmt::format("{} is {} pixels large, {} {}: no difference is paired over pixels, and errors at "
                      "edges depend on the size",
                      run.name, size_of(run), base.name, size_of(base)));
    } else if (value_of(run.environment, "camera") != value_of(base.environment, "camera")) {
      limits.push_back(fmt::format("{} looks through another camera than {}: differences come from the view, too",
                                   run.name, base.name));
    }
    for (const auto& [what, value] : run.environment) {
      if (what == "camera" || value == value_of(base.environment, what)) continue;
      limits.push_back(fmt::format("{}: {} of {}, {} of {}", what, value.empty() ? "none" : value, run.name,
                                   value_of(base.environment, what), base.name));
    }
    const auto shares = [&](std::string_view kind) {
      return std::ranges::any_of(base.statistics, [&](const MeasuredStatistic& each) {
        return (each.kind == kind || each.kind == "image") && find_same(run, each) != nullptr;
      });
    };
    std::string other_reference;
    for (const auto& [key, value] : run.parameters) {
      const bool is_of_reference = key.starts_with("light.") || key == "truth.shadow" ||
                                   (key.starts_with("truth.ao-") && key != "truth.ao-layers");
      if (is_of_reference && value != value_of(base.parameters, key) &&
          shares(key.starts_with("truth.ao-") ? "ao" : "shadow")) {
        other_reference += (other_reference.empty() ? "" : ", ") + key;
      }
    }
    if (!other_reference.empty()) {
      limits.push_back(
          fmt::format("{} has another reference than {} ({}): differences of what depends on it include that between "
                      "the references",
                      run.name, base.name, other_reference));
    }
    for (const MeasuredStatistic& measured : everything) {
      if (measured.name != pixels_statistic || find_same(run, measured) != nullptr) continue;
      limits.push_back(fmt::format(
          "{} did not measure {}", run.name,
          measured.light.empty() ? (measured.kind == "ao" ? "AO" : measured.kind) : "the shadow of " + measured.light));
    }
  }
  return limits;
}

Table differing_parameters(const std::vector<StoredRun>& runs) {
  Experiment usual;
  const Parameters parameters = describe(usual);
  Table table{{{"parameter", "", ""}}, {}};
  for (const StoredRun& run : runs) table.columns.push_back({run.name, "", ""});
  std::vector<std::string> keys;
  for (const StoredRun& run : runs) {
    for (const auto& [key, value] : run.parameters) {
      if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
  }
  for (const std::string& key : keys) {
    std::vector<Value> row = {key};
    const std::vector<std::string> values =
        mapped(runs, [&](const StoredRun& run) { return value_of(run.parameters, key); });
    for (const std::string& value : shortened(values)) row.emplace_back(with_unit(parameters, key, value));
    if (std::any_of(row.begin() + 2, row.end(), [&](const Value& value) { return value != row[1]; })) {
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace umbrameter
