#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/lists.h"
#include "present/bias_conversion.h"
#include "present/presentation_parts.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

// A number that the engine has, but not for this bias at every place.
const ConvertedNumber* missing_number(const EngineAdvice& advice) {
  for (const BiasConversion& place : advice.target.conversions) {
    for (const ConvertedNumber& number : place.numbers) {
      if (!number.value && !number.is_other_kind) return &number;
    }
  }
  return nullptr;
}

// Why an engine's numbers cannot say this bias.
std::string no_number_text(const EngineAdvice& advice) {
  const ConvertedNumber* missing = missing_number(advice);
  if (missing == nullptr) return "has no number for this bias";
  const char* what = missing->reason.starts_with(no_formula) ? "not converted: " : "has no number for this bias: ";
  return what + missing->reason;
}

const std::string note_mark = "    note: ";

std::string engine_error_text(const EngineAdvice& advice) {
  const auto acne_of = [](const BiasCell& cell) { return ", acne " + percent(cell.acne); };
  std::string usual;
  bool keeps_default = false;
  if (advice.by_default) {
    const BiasCell& usually = *advice.by_default;
    const std::string error = percent(usually.mae);
    const bool is_less =
        advice.measured && usually.mae < advice.measured->mae && error != percent(advice.measured->mae);
    keeps_default = is_less && usually.acne <= std::max(advice.measured->acne, little_acne_share);
    usual = fmt::format("{} {}{}",
                        keeps_default ? "keep its default numbers: error"
                        : is_less     ? "its default numbers have less error,"
                                      : "with its default numbers error",
                        error, acne_of(usually));
  }
  const std::string after = usual.empty() ? "" : "; " + usual;
  if (!is_complete(advice.target)) return no_number_text(advice) + after;
  if (!advice.measured) return "error with the numbers below not measured: " + advice.why_not_measured + after;
  const std::string set = fmt::format("with the numbers below, rounded up, error {}{}", percent(advice.measured->mae),
                                      acne_of(*advice.measured));
  return keeps_default ? usual + "; " + set : set + after;
}

// Lines of the engine's code, or the number in a unit. None where a part of the bias is left out: zeros would look like
// a recommendation.
std::vector<std::string> shown_numbers(const EngineAdvice& advice, bool has_remarks) {
  if (!is_complete(advice.target)) return {};
  std::vector<std::string> lines = code_lines(advice.target, has_remarks);
  const std::vector<BiasNumber>& numbers = advice.target.spec.engine->numbers;
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const auto values = set_values(advice.target, n);
    if (numbers[n].code.empty() && values) {
      lines.push_back(
          fmt::format("{} = {}", numbers[n].name, with_unit(digits_text(values->front()), numbers[n].unit)));
    }
  }
  return lines;
}

bool is_of_distances(const EngineAdvice& advice) { return advice.target.places.front().name == nearest_receiver; }

// How the engine differs from the run: "casts back faces and adds polygon offset factor 2.5, units 1".
std::string own_drawing_text(const EngineAdvice& advice) {
  const BiasEngine& engine = *advice.target.spec.engine;
  std::vector<std::string> parts;
  if (advice.has_one_number)
    parts.emplace_back(is_of_distances(advice) ? "has one number for all distances"
                                               : "has one number for all cascades");
  if (advice.own_faces) {
    parts.push_back(fmt::format("casts {}", *advice.own_faces == CasterFaces::all ? "front and back faces"
                                            : *advice.own_faces == CasterFaces::back
                                                ? "back faces of single-sided surfaces"
                                                : "front faces of single-sided surfaces"));
  }
  if (advice.has_own_offset) {
    // Where it has no fixed factor, its numbers may set one.
    const std::string factor = engine.polygon_factor == 0.0 ? "" : fmt::format("factor {:g}, ", engine.polygon_factor);
    parts.push_back(factor.empty() && engine.polygon_units == 0.0
                        ? "draws without this polygon offset"
                        : fmt::format("adds polygon offset {}units {:g}", factor, engine.polygon_units));
  }
  if (!advice.lost_offset.empty())
    parts.push_back(fmt::format("has no equivalent of this normal offset ({})", advice.lost_offset));
  if (advice.left_out_slope != 0.0) {
    parts.push_back(fmt::format("has no number for shadow.slope-bias {:.3g}", advice.left_out_slope));
  }
  return joined(parts, " and ");
}

// Whether a polygon offset of this light could be said in the engine's number for the slope, and is not there yet.
bool lacks_slope(const EngineAdvice& advice) {
  const ConvertedTarget& target = advice.target;
  const auto has_equivalent = [](const BiasConversion& each) { return each.has_equivalent; };
  BiasTerms slope;
  slope.slope = 1.0;
  return std::ranges::none_of(target.conversions, has_equivalent) &&
         std::ranges::all_of(target.places, [&](const MapPlace& place) {
           // The constant that acts besides the numbers is known of suns and left out of point lights.
           const bool is_known = target.spec.engine->constant_of_range == 0.0 || place.light != LightKind::spot;
           return is_known && has_equivalent(convert(slope, target.spec, place));
         });
}

// How to find the numbers of an engine that has none for the constant bias; empty if it has one or no slope either.
std::string search_text(const EngineAdvice& advice) {
  const BiasEngine& engine = *advice.target.spec.engine;
  const auto slope = std::ranges::find(engine.numbers, BiasTerm::slope, &BiasNumber::term);
  if (has_number(engine, BiasTerm::constant) || slope == engine.numbers.end() || !lacks_slope(advice)) return {};
  return fmt::format(
      "{0}: its {1} is a polygon offset factor; 'umbrameter tune' with the scene, light and flags of this run and "
      "--vary shadow.polygon-offset-factor=0:10 --for {0} finds it",
      engine.name, slope->name);
}

// What no_number_text() does not say.
std::vector<std::string> notes_of_advice(const EngineAdvice& advice) {
  std::vector<std::string> notes = notes_of(advice.target);
  const std::string search = search_text(advice);
  if (!is_complete(advice.target) && !search.empty()) notes.push_back(search);
  if (advice.is_shared) {
    notes.push_back(fmt::format("{}: one light has the same numbers in all cases, the largest that one of them needs",
                                advice.target.spec.engine->name));
  }
  const std::string own = own_drawing_text(advice);
  if (own.empty() || (!is_complete(advice.target) && !advice.by_default)) return notes;
  std::string searched;
  if (is_complete(advice.target) && advice.own_bias) {
    searched = ": the bias was searched again for this and is " + length_text(*advice.own_bias) +
               (advice.own_bias->unit == LengthUnit::texels ? " of our map" : "") +
               (advice.has_one_number && !is_of_distances(advice) ? " in cascade 1" : "");
  }
  const std::string errors = advice.measured     ? "; the errors are those of the numbers shown"
                             : advice.by_default ? "; the error is that of its default numbers"
                                                 : "";
  const bool draws_otherwise = advice.own_faces || advice.has_own_offset;
  notes.push_back(fmt::format("{}: it {}{}{}{}", advice.target.spec.engine->name, own, searched, errors,
                              !errors.empty() && draws_otherwise ? ", with a map drawn that way" : ""));
  return notes;
}

std::vector<std::string> engine_lines(const std::vector<EngineAdvice>& engines, const std::string& what,
                                      const std::string& bias) {
  std::vector<std::string> lines;
  for (const EngineAdvice& each : engines) {
    const bool has_that_bias =
        has_number(*each.target.spec.engine, BiasTerm::constant) && own_drawing_text(each).empty();
    const std::string of_bias = bias.empty() ? "" : has_that_bias ? fmt::format(", {},", bias) : ",";
    lines.push_back(fmt::format("  {}{} in {}: {}", what, of_bias, title_of(each.target.spec, each.target.places),
                                engine_error_text(each)));
    for (const std::string& code : shown_numbers(each, true)) lines.push_back("    " + code);
    for (const std::string& note : notes_of_advice(each)) lines.push_back(note_mark + note);
  }
  return lines;
}

std::vector<std::string> remarks_on(const std::vector<EngineAdvice>& engines) {
  std::vector<std::string> remarks;
  for (const EngineAdvice& each : engines) {
    if (!each.why_not_measured.empty()) {
      remarks.push_back(fmt::format("{}: the error with these numbers is not measured: {}.",
                                    each.target.spec.engine->name, each.why_not_measured));
    }
    for (const std::string& note : notes_of_advice(each)) remarks.push_back(note + ".");
  }
  return remarks;
}

ReportTable engine_table(const std::vector<EngineAdvice>& engines, const std::string& what) {
  Table table{{{"engine", "", "with the settings that enter its formulas"},
               {"set", "", "rounded up to three digits and to the engine's steps, within its limits"},
               {"error", "%", "mean absolute error of visibility with these numbers, in our rasteriser"},
               {"acne", "%", std::string(cause_meaning(Cause::acne))},
               {"error by default", "%", "the same with the engine's default numbers"}},
              {}};
  const auto share = [](const std::optional<BiasCell>& cell, double BiasCell::*value) {
    return share_text(cell ? (*cell).*value : std::numeric_limits<double>::quiet_NaN());
  };
  for (const EngineAdvice& each : engines) {
    std::string set;
    // Without remarks, which would swallow what follows in one line; the notes say the same.
    for (const std::string& code : shown_numbers(each, false)) {
      if (!set.empty()) set += set.ends_with(';') || set.ends_with(',') ? " " : "; ";
      set += code;
    }
    table.rows.push_back({title_of(each.target.spec, each.target.places), set.empty() ? no_number_text(each) : set,
                          share(each.measured, &BiasCell::mae), share(each.measured, &BiasCell::acne),
                          share(each.by_default, &BiasCell::mae)});
  }
  ReportTable engine_numbers{"In the numbers of engines: " + what, std::move(table)};
  engine_numbers.remarks = remarks_on(engines);
  return engine_numbers;
}

}  // namespace

void add_engines(Presentation& presentation, const std::vector<EngineAdvice>& engines, const std::string& what,
                 const std::string& bias) {
  if (engines.empty()) return;
  for (std::string& line : engine_lines(engines, what, bias)) presentation.lines.push_back(std::move(line));
  presentation.section.tables.push_back(engine_table(engines, what));
}

void say_engine_notes_once(std::vector<Presentation>& parts) {
  std::set<std::string> said_in_lines, said_below;
  for (Presentation& part : parts) {
    std::erase_if(part.lines, [&](const std::string& line) {
      return line.starts_with(note_mark) && !said_in_lines.insert(line).second;
    });
    for (ReportTable& table : part.section.tables) {
      std::erase_if(table.remarks, [&](const std::string& remark) { return !said_below.insert(remark).second; });
    }
  }
}

nlohmann::ordered_json to_json(const std::vector<EngineAdvice>& engines) {
  using Json = nlohmann::ordered_json;
  const auto error_json = [](const std::optional<BiasCell>& cell) { return cell ? Json(cell->mae) : Json(nullptr); };
  Json list = Json::array();
  for (const EngineAdvice& each : engines) {
    Json engine = to_json(each.target);
    engine["mae"] = error_json(each.measured);
    engine["mae_of_defaults"] = error_json(each.by_default);
    list.push_back(std::move(engine));
  }
  return list;
}

}  // namespace umbrameter
