#include "present/bias_advice_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "present/plateau_text.h"
#include "present/presentation.h"
#include "present/presentation_parts.h"
#include "present/summary.h"

namespace umbrameter {
namespace {

std::array<double, cause_count> shares_of(const BiasCell& cell) {
  return {cell.acne, cell.false_occlusion, cell.peter_panning, cell.leak};
}

BiasInUnits in_units(const BiasAdvice& advice, const BiasCell& cell) {
  return in_units(Length{cell.constant, advice.unit}, advice.mean_texel, advice.depth_unit);
}

std::string short_bias_text(const BiasAdvice& advice, const BiasCell& cell) {
  return length_text(Length{cell.constant, advice.unit});
}

// In the unit in use first, then in texels or metres.
std::string bias_text(const BiasAdvice& advice, const BiasCell& cell) {
  const BiasInUnits bias = in_units(advice, cell);
  const std::string texels = length_text({bias.texels, LengthUnit::texels});
  const char* average = advice.texels_differ ? " on average" : "";
  if (advice.unit == LengthUnit::texels) {
    return fmt::format("{} ({}{})", texels, metres_text(bias.metres), average);
  }
  if (advice.unit == LengthUnit::map_depth) {
    return fmt::format("{} ({}, {}{})", short_bias_text(advice, cell), metres_text(bias.metres), texels, average);
  }
  return fmt::format("{} ({}{})", metres_text(bias.metres), texels, average);
}

}  // namespace

std::string named_bias_text(const BiasAdvice& advice) { return bias_text(advice, named_bias(advice)); }

std::string advice_text(const BiasAdvice& advice) {
  const BiasCell& used = advice.used;
  const BiasCell& recommended = advice.plateau.recommended;
  if (advice.withheld) {
    const std::optional<BiasCell>& little = advice.line.little_acne;
    const bool shows_acne = advice.evidence.lit >= enough_pixels && advice.evidence.pixels >= enough_pixels;
    return fmt::format("no bias recommended: {}; error {} at {}{}", withheld_text(*advice.withheld, advice.evidence),
                       percent(used.mae), bias_text(advice, used),
                       shows_acne && little ? ", acne at most 0.1 % from " + bias_text(advice, *little) : "");
  }
  const std::string range = range_text(advice.plateau, advice.unit, "error", percent(advice.plateau.least.mae));
  const auto less_acne = [&](const BiasCell& cell) {
    if (cell.acne <= little_acne_share) return std::string();
    const std::optional<BiasCell>& little = advice.line.little_acne;
    return less_acne_text(little, little ? bias_text(advice, *little) : "");
  };
  if (keeps_bias(advice)) {
    const bool is_in_range =
        used.constant >= advice.plateau.first.constant && used.constant <= advice.plateau.last.constant;
    return fmt::format("keep bias {}: error {}{}; {}{}{}", bias_text(advice, used), percent(used.mae),
                       used.acne > little_acne_share ? ", acne " + percent(used.acne) : "", range,
                       is_in_range ? "" : ", and so has this one", less_acne(used));
  }
  // A bias with as little error changes for its acne alone.
  const bool is_for_acne = used.mae <= advice.plateau.limit;
  const char* reason = used.acne > little_acne_share ? reason_text(advice.plateau, is_for_acne) : "";
  // Where the run has no acne, the bias is not there to remove it.
  const bool says_where = *reason == '\0' && *reason_text(advice.plateau, false) != '\0';
  const std::string little_from =
      says_where ? fmt::format("; of these, acne is at most 0.1 % from {} on", short_bias_text(advice, recommended))
                 : "";
  const bool shows_acne =
      is_for_acne || *reason != '\0' || recommended.acne > used.acne || recommended.acne > little_acne_share;
  return fmt::format("use bias {}{}{}: {}error {} → {}; {}{}", bias_text(advice, recommended), reason,
                     least_error_text(advice.plateau),
                     shows_acne ? fmt::format("acne {} → {}, ", percent(used.acne), percent(recommended.acne)) : "",
                     percent(used.mae), percent(recommended.mae), range + little_from, less_acne(recommended));
}

ReportTable advice_table(const BiasAdvice& advice) {
  // Where texels grow with the distance, a bias in the unit in use is several lengths in the other.
  const bool is_in_metres = advice.unit == LengthUnit::metres;
  const auto on_average = [&](const char* unit, bool is_own) {
    if (!advice.texels_differ || is_own) return std::string(unit);
    return std::string(unit) == "1" ? std::string("on average") : std::string(unit) + ", on average";
  };
  Table table{{{"constant bias", "", "all other parameters as in this run"},
               {"along the light", on_average("m", is_in_metres),
                "length along the light; texels are converted at the mean texel size"},
               {"in texels", on_average("texels", advice.unit == LengthUnit::texels),
                "multiple of the texel size at each receiver; metres are converted at the mean texel size"},
               {"in depth", on_average("1", advice.unit == LengthUnit::map_depth),
                "share of the depth that the map stores, from 0 to 1"},
               {"error", "%", "mean absolute error of visibility"}},
              {}};
  for (std::size_t c = 0; c < cause_count; ++c) {
    const auto cause = static_cast<Cause>(c);
    table.columns.push_back({std::string(cause_title(cause)), "%", std::string(cause_meaning(cause))});
  }
  const auto add_row = [&](const std::string& name, const BiasCell& cell) {
    const BiasInUnits bias = in_units(advice, cell);
    std::vector<Value> row = {name, digits_text(bias.metres), digits_text(bias.texels), depth_text(bias.depth),
                              share_text(cell.mae)};
    for (const double share : shares_of(cell)) row.emplace_back(share_text(share));
    table.rows.push_back(std::move(row));
  };
  // One row alone is recommended, and it is that of the answer.
  const bool is_kept = !advice.withheld && keeps_bias(advice);
  add_row(is_kept ? "in this run: keep it" : "in this run", advice.used);
  if (!advice.withheld && !is_kept) add_row("recommended", advice.plateau.recommended);
  add_row(formula_names[0], advice.plateau.least);
  // Beyond a worse stretch of biases there may be others that are as good.
  const std::string limit =
      (advice.plateau.is_by_pixels ? tolerance_text(true) + " more than" : times_text(1.0 + plateau_tolerance)) +
      " the least error";
  const std::string good = " with at most " + limit;
  add_row(advice.plateau.open_below ? "smallest bias tested" : "smallest" + good, advice.plateau.first);
  add_row(advice.plateau.open_above ? "largest bias tested" : "largest" + good, advice.plateau.last);
  if (advice.line.little_acne) add_row(formula_names[1], *advice.line.little_acne);
  if (advice.line.acne_free) add_row(formula_names[2], *advice.line.acne_free);
  ReportTable biases{"Recommended bias", std::move(table), {"in texels", "in depth"}};
  if (is_kept) {
    std::string above;
    if (const auto& cell = advice.line.little_acne) {
      const bool looks_equal = share_text(cell->mae) == share_text(advice.plateau.last.mae);
      above = fmt::format(". In the row '{}' the error is more than {}{}", formula_names[1], limit,
                          looks_equal ? ", by less than rounding shows" : "");
    }
    biases.remarks.push_back("The bias of this run is kept: its " + good_error_text() +
                             (advice.used.acne <= little_acne_share
                                  ? ", and its acne is at most 0.1 %."
                                  : ", and no bias with such an error has acne of at most 0.1 %" + above + "."));
  } else if (!advice.withheld) {
    biases.remarks.push_back(rule_text());
  }
  if (advice.texels_differ) biases.remarks.push_back(average_text(advice.unit));
  return biases;
}

nlohmann::ordered_json to_json(const BiasAdvice& advice) {
  using Json = nlohmann::ordered_json;
  const auto cell_json = [&](const BiasCell& cell) {
    Json object = {{"constant_bias", to_json(in_units(advice, cell))}, {"mae", cell.mae}};
    const std::array<double, cause_count> shares = shares_of(cell);
    for (std::size_t c = 0; c < cause_count; ++c) object[std::string(cause_names[c])] = shares[c];
    return object;
  };
  Json object = {{"used", cell_json(advice.used)},
                 {"keep", !advice.withheld && keeps_bias(advice)},
                 {"least_error", cell_json(advice.plateau.least)}};
  add_plateau(object, advice.plateau, advice.evidence, advice.withheld, cell_json);
  object["acne_at_most_0.1_percent"] = advice.line.little_acne ? cell_json(*advice.line.little_acne) : Json(nullptr);
  object["acne_free"] = advice.line.acne_free ? cell_json(*advice.line.acne_free) : Json(nullptr);
  if (!advice.engines.empty()) object["engines"] = to_json(advice.engines);
  return object;
}

}  // namespace umbrameter
