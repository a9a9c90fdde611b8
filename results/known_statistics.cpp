#include "results/known_statistics.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/error.h"
#include "core/suggestion.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 3> kinds = {"shadow", "ao", "image"};

// Shadows are described in several ways: too dark is a sum of causes for a hard one and an error for a soft one.
void add(std::vector<KnownStatistic>& all, KnownStatistic statistic) {
  const auto known = std::ranges::find_if(
      all, [&](const KnownStatistic& each) { return each.kind == statistic.kind && each.name == statistic.name; });
  if (known == all.end()) {
    all.push_back(std::move(statistic));
  } else if (statistic.is_error && !known->is_error) {
    known->is_error = true;
    known->title = std::move(statistic.title);
  }
}

// That of its figure, or how its meaning begins.
std::string title_of(const Statistic& statistic) {
  if (!statistic.curve.title.empty()) return statistic.curve.title;
  return statistic.meaning.substr(0, statistic.meaning.find_first_of(":;,"));
}

// "Too bright" of "too_bright".
bool is_title(std::string_view title, std::string_view name) {
  return std::ranges::equal(title, name, [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b) || (a == ' ' && b == '_');
  });
}

void add_described(std::vector<KnownStatistic>& all, CellStatistics statistics) {
  const std::string kind(kind_of(quantity_of(statistics)));
  for (const Statistic& each : describe(statistics)) {
    add(all, {kind,
              each.name,
              each.unit,
              each.meaning,
              !each.curve.title.empty(),
              false,
              each.is_share,
              {},
              title_of(each)});
  }
}

template <std::size_t... i>
void add_alternatives(std::vector<KnownStatistic>& all, std::index_sequence<i...>) {
  (add_described(all, CellStatistics(std::in_place_index<i>)), ...);
}

std::vector<KnownStatistic> make_known() {
  std::vector<KnownStatistic> all;
  add_alternatives(all, std::make_index_sequence<std::variant_size_v<CellStatistics>>{});
  for (const std::string_view kind : kinds) {
    for (const Metric& metric : color_metrics()) {
      for (const MetricColumn& column : columns_of(metric, kind == kinds[0])) {
        add(all, {std::string(kind), column.name, column.unit, std::string(metric.title), true, metric.is_higher_better,
                  false, std::string(metric.name), std::string(metric.title)});
      }
    }
  }
  return all;
}

}  // namespace

std::string_view kind_of(SweptQuantity quantity) {
  return quantity == SweptQuantity::ao ? kinds[1] : quantity == SweptQuantity::image ? kinds[2] : kinds[0];
}

const std::vector<KnownStatistic>& known_statistics() {
  static const std::vector<KnownStatistic> all = make_known();
  return all;
}

const KnownStatistic* find_known(std::string_view kind, std::string_view name) {
  for (const KnownStatistic& each : known_statistics()) {
    if (each.kind == kind && each.name == name) return &each;
  }
  return nullptr;
}

bool is_higher_better(std::string_view statistic) {
  return std::ranges::any_of(
      known_statistics(), [&](const KnownStatistic& each) { return each.name == statistic && each.is_higher_better; });
}

bool can_be_negative(std::string_view statistic) { return is_signed_error(statistic) || is_higher_better(statistic); }

bool is_signed_error(std::string_view statistic) {
  constexpr std::array<std::string_view, 5> names = {"mean_error", "shadows", "ao", "gbuffer", "shading"};
  // Metrics, also in texels and metres.
  constexpr std::array<std::string_view, 2> beginnings = {"edge-displacement", "edge-width"};
  return std::ranges::find(names, statistic) != names.end() ||
         std::ranges::any_of(beginnings, [&](std::string_view each) { return statistic.starts_with(each); });
}

StatisticName parse_statistic_name(std::string_view text) {
  for (const std::string_view kind : kinds) {
    if (text.size() > kind.size() && text.starts_with(kind) && text[kind.size()] == '.') {
      return {std::string(kind), std::string(text.substr(kind.size() + 1))};
    }
  }
  return {{}, std::string(text)};
}

std::string metric_to_measure(std::string_view statistic) {
  const StatisticName wanted = parse_statistic_name(statistic);
  std::string metric;
  for (const KnownStatistic& each : known_statistics()) {
    if (each.name != wanted.name || (!wanted.kind.empty() && each.kind != wanted.kind)) continue;
    if (each.metric.empty()) return {};
    metric = each.metric;
  }
  return metric;
}

std::vector<KnownStatistic> require_statistic(const StatisticName& name, const std::string& option,
                                              const std::vector<std::string>& more) {
  std::vector<KnownStatistic> found;
  std::vector<std::string> names;
  for (const KnownStatistic& each : known_statistics()) {
    if (!name.kind.empty() && each.kind != name.kind) continue;
    if (each.name == name.name) found.push_back(each);
    if (std::ranges::find(names, each.name) == names.end()) names.push_back(each.name);
  }
  if (!found.empty()) return found;
  names.insert(names.end(), more.begin(), more.end());
  // The answers call the mean absolute error just so, and the others by their titles.
  std::string own = name.name == "error" ? std::string(error_statistic) : "";
  for (const KnownStatistic& each : known_statistics()) {
    const bool is_of_kind = name.kind.empty() || each.kind == name.kind;
    if (own.empty() && is_of_kind && is_title(each.title, name.name)) own = each.name;
  }
  const std::string similar = own.empty() ? suggestion(similar_names(name.name, names)) : "its name is '" + own + "'";
  std::string list;
  for (const KnownStatistic& each : known_statistics()) {
    const bool is_shown = each.is_error && each.kind != kinds[2];
    if (is_shown && list.find(each.name) == std::string::npos) list += (list.empty() ? "" : ", ") + each.name;
  }
  throw Error(ExitCode::usage, option,
              "there is no statistic '" + name.name + "'" + (name.kind.empty() ? "" : " of kind " + name.kind),
              similar.empty() ? "known errors: " + list : similar);
}

}  // namespace umbrameter
