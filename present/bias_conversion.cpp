#include "present/bias_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/lists.h"
#include "reports/files/text_layout.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

// For code: three significant digits without zeros at the end, and a minus that a compiler reads.
std::string code_number(double number) {
  std::string text = fmt::format("{:.{}f}", number, std::max(decimals_of(number, 3), 0));
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text += '0';
  return number == 0.0 ? "0.0" : text;
}

// The same for a table.
std::string table_number(double number) { return number == 0.0 ? "0" : with_minus(code_number(number)); }

std::string code_line(std::string text, double value, std::size_t cascade, bool is_one_of_several) {
  if (is_one_of_several && text.starts_with("light.")) text = fmt::format("csm.lights[{}].", cascade) + text.substr(6);
  return text.replace(text.find("{}"), 2, code_number(value));
}

// Whether a number of the engine is another length there with another value of the setting.
bool enters_formulas(const BiasSpec& spec, std::size_t setting, const std::vector<MapPlace>& places) {
  BiasSettings other = spec.settings;
  other.values[setting] = 1.5 * other.values[setting] + 0.25;
  return std::ranges::any_of(spec.engine->numbers, [&](const BiasNumber& number) {
    return std::ranges::any_of(places, [&](const MapPlace& place) {
      return number.per_unit(place, spec.settings) != number.per_unit(place, other);
    });
  });
}

// "quality = low, blur = 1": the settings that enter the formulas at these places, and other faces than the engine's.
std::string settings_text(const BiasSpec& spec, const std::vector<MapPlace>& places, bool has_factors) {
  std::string text;
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    const BiasSetting& setting = spec.engine->settings[i];
    const double value = spec.settings.values[i];
    if (setting.is_faces ? value == setting.value : std::isnan(value) || !enters_formulas(spec, i, places)) continue;
    std::string shown;  // several choices may have one factor
    for (const auto& [name, factor] : setting.choices) {
      if (factor == value) shown += (shown.empty() ? "" : " or ") + std::string(name);
    }
    const std::string number = fmt::format("{:.6g}{}", value, setting.unit == "m" ? " m" : "");
    const bool is_factor = has_factors && setting.unit == "1" && !setting.is_faces;
    shown = shown.empty() ? number : is_factor ? fmt::format("{} (factor {})", shown, number) : shown;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.name, shown);
  }
  return text;
}

std::string numbers_text(const BiasSpec& spec, LightKind light) {
  std::string text;
  for (std::size_t i = 0; i < spec.numbers.size(); ++i) {
    const BiasNumber& number = spec.engine->numbers[i];
    const std::string unit = number.unit == "1" ? "" : fmt::format(" (unit: {})", number.unit);
    const char* usual = spec.numbers[i] == number.default_of(light) ? ", its default" : "";
    text += fmt::format("{}{} = {:.6g}{}{}", text.empty() ? "" : "; ", number.name, spec.numbers[i], usual, unit);
  }
  return text;
}

bool any_term(const ConvertedBias& bias, double BiasTerms::*term) {
  return std::ranges::any_of(bias.terms, [&](const BiasTerms& each) { return each.*term != 0.0; });
}

bool is_cascade(const MapPlace& place) { return place.name.starts_with("cascade"); }

// "cascade 2", "the nearest receiver".
std::string with_article(const MapPlace& place) { return (is_cascade(place) ? "" : "the ") + place.name; }

bool has_word(std::string_view text, std::string_view word) {
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

// What one unit of the source's numbers is, by its own t and R.
std::vector<std::string> unit_lines(const ConvertedBias& bias) {
  std::vector<std::string> lines;
  const BiasEngine& engine = *bias.source.engine;
  for (std::size_t i = 0; i < engine.numbers.size(); ++i) {
    const BiasNumber& number = engine.numbers[i];
    if (engine.is_unit || number.term == BiasTerm::slope || bias.source.numbers[i] == 0.0) continue;
    const auto metres = [&](const MapPlace& place) {
      return table_number(number.per_unit(place, bias.source.settings).value_or(0.0)) + " m";
    };
    const std::vector<MapPlace>& places = bias.source_places;
    const std::string first = metres(places.front());
    const bool are_equal = std::ranges::all_of(places, [&](const MapPlace& place) { return metres(place) == first; });
    const std::string text = are_equal ? first : joined(places, ", ", [&](const MapPlace& place) {
      return metres(place) + (is_cascade(place) ? " in " : " at ") + with_article(place);
    });
    lines.push_back(fmt::format("one unit of {} is {}; formula: {}", number.name, text,
                                number.formula_for(bias.places.front().light)));
  }
  const auto names = [&](const char* symbol) {
    return std::ranges::any_of(lines, [&](const std::string& line) { return has_word(line, symbol); });
  };
  std::string symbols;
  for (const auto& [symbol, meaning] : {std::pair{"t", "t is the size of a texel"},
                                        {"R", "R is the depth range"},
                                        {"d", "d is the depth of the receiver"}}) {
    if (names(symbol)) symbols += (symbols.empty() ? "" : ", ") + std::string(meaning);
  }
  if (!symbols.empty()) lines.push_back("in the formulas " + symbols + ", as in the table:");
  return lines;
}

std::vector<std::vector<std::string>> place_rows(const ConvertedBias& bias) {
  const bool has_depth = bias.places.front().light != LightKind::directional;
  const bool has_normal = any_term(bias, &BiasTerms::normal);
  const bool has_slope = any_term(bias, &BiasTerms::slope);
  std::vector<std::string> head{""};
  if (has_depth) head.emplace_back("depth d [m]");
  head.insert(head.end(), {"texel t [m]", "depth range R [m]", "bias [m]", "[texels]", "[of R]"});
  if (has_normal) head.emplace_back("normal offset [m]");
  if (has_slope) head.emplace_back("by slope [texels × slope]");
  std::vector<std::vector<std::string>> rows{head};
  for (std::size_t i = 0; i < bias.places.size(); ++i) {
    const MapPlace& place = bias.places[i];
    const BiasTerms& terms = bias.terms[i];
    std::vector<std::string>& row = rows.emplace_back(std::vector<std::string>{place.name});
    if (has_depth) row.push_back(table_number(place.depth));
    for (const double number :
         {place.texel, place.range, terms.constant, terms.constant / place.texel, terms.constant / place.range}) {
      row.push_back(table_number(number));
    }
    if (has_normal) row.push_back(table_number(terms.normal));
    if (has_slope) row.push_back(table_number(terms.slope));
  }
  return rows;
}

// Of a unit, 0 is the default: nothing to say. An engine's own default may be another number.
bool is_idle(const ConvertedTarget& target, std::size_t number) {
  return target.spec.engine->is_unit && std::ranges::all_of(target.conversions, [&](const BiasConversion& each) {
           return each.numbers[number].value == 0.0;
         });
}

// Our own offset is one of two parameters.
std::string number_name(const ConvertedTarget& target, std::size_t number) {
  const std::string& code = target.conversions.front().numbers[number].code;
  return code.find("--shadow.caster-offset") == std::string::npos
             ? std::string(target.spec.engine->numbers[number].name)
             : "caster-offset";
}

// A row for each number, a column for each place: as many engines as there are fit on a terminal.
std::vector<std::vector<std::string>> number_rows(const ConvertedBias& bias) {
  std::vector<std::vector<std::string>> rows{{"engine", "parameter", "unit"}};
  for (const MapPlace& place : bias.places) rows.front().push_back(bias.places.size() == 1 ? "value" : place.name);
  for (const ConvertedTarget& target : bias.targets) {
    const BiasEngine& engine = *target.spec.engine;
    for (std::size_t n = 0; n < engine.numbers.size(); ++n) {
      if (is_idle(target, n)) continue;
      std::vector<std::string>& row = rows.emplace_back(
          std::vector<std::string>{std::string(engine.name), number_name(target, n),
                                   std::string(engine.numbers[n].unit == "1" ? "factor" : engine.numbers[n].unit)});
      for (const BiasConversion& each : target.conversions) {
        row.push_back(each.numbers[n].value ? table_number(*each.numbers[n].value) : "none");
      }
    }
  }
  return rows;
}

void add_engine_notes(const BiasSpec& spec, bool of_lamp, std::vector<std::string>& notes) {
  const BiasEngine& engine = *spec.engine;
  if (!engine.note.empty()) notes.push_back(fmt::format("{}: {}", engine.name, engine.note));
  if (!engine.unverified.empty()) notes.push_back(fmt::format("{}, not verified: {}", engine.name, engine.unverified));
  if (of_lamp && !engine.note_of_lamps.empty()) {
    notes.push_back(fmt::format("{}: {}", engine.name, engine.note_of_lamps));
  }
}

bool is_lamp(const MapPlace& place) { return place.light != LightKind::directional; }

// `is_chosen`: one number of each unit is shown as well, not one for each place.
void add_number_notes(const ConvertedTarget& target, bool is_chosen, std::vector<std::string>& notes) {
  const BiasEngine& engine = *target.spec.engine;
  const auto add = [&](const std::string& text) {
    if (std::ranges::find(notes, text) == notes.end()) notes.push_back(text);
  };
  for (const BiasConversion& each : target.conversions) {
    for (std::size_t n = 0; n < each.numbers.size(); ++n) {
      if (!each.numbers[n].value) {
        add(fmt::format("{} {}: no equivalent: {}", engine.name, number_name(target, n), each.numbers[n].reason));
      }
    }
    // Of a unit, the table of places has the other parts in metres.
    for (const std::string& missing : engine.is_unit ? std::vector<std::string>() : each.missing)
      add(fmt::format("{}: {}", engine.name, missing));
  }
  for (std::size_t n = 0; n < engine.numbers.size(); ++n) {
    const BiasNumber& number = engine.numbers[n];
    const std::optional<ChosenValue> chosen = choose_value(target, n);
    if (!chosen) continue;
    const double value = std::clamp(chosen->value, number.min, number.max);
    const bool is_one_for_all =
        target.conversions.size() > 1 && (is_chosen || !number.code.empty()) && !sets_each_place(target);
    const bool is_cut = std::abs(value - chosen->value) > 1e-9 * std::abs(chosen->value);
    const std::string decider =
        chosen->is_of_another ? "another case of the light" : with_article(target.places[chosen->place]);
    if (is_one_for_all && !is_cut && chosen->excess > 1.005) {
      add(
          fmt::format("{} {}: chosen for {}, which needs the largest number; elsewhere it acts as up to {} times "
                      "the bias that is needed",
                      engine.name, number_name(target, n), decider, digits_text(chosen->excess, 2)));
    }
    if (is_cut) {
      const double share = value / chosen->value;
      add(fmt::format(
          "{} {}: {} is outside its limits {} to {}{}", engine.name, number.name, table_number(chosen->value),
          number.min, number.max,
          share > 0.0
              ? fmt::format("; {:.6g} acts as {} times the bias that {}", value, digits_text(share, 2),
                            target.places.size() > 1 || chosen->is_of_another ? decider + " needs" : "is needed")
              : ""));
    }
    const double rounded = set_values(target, n)->front();
    if (number.step > 0.0 && std::abs(rounded - value) > 0.05 * std::abs(value)) {
      add(fmt::format("{} {}: the inspector's step of {} rounds {} to {}", engine.name, number.name, number.step,
                      table_number(value), table_number(rounded)));
    }
  }
}

// Why the number is not known at one of the places.
std::string reason_of(const ConvertedTarget& target, std::size_t number) {
  for (const BiasConversion& each : target.conversions) {
    if (!each.numbers[number].value) return each.numbers[number].reason;
  }
  return {};
}

std::string range_of(double min, double max) {
  return std::isfinite(max) ? fmt::format(", {:.6g} to {:.6g}", min, max) : "";
}

}  // namespace

std::string title_of(const BiasSpec& spec, const std::vector<MapPlace>& places, bool has_factors) {
  const std::string settings = settings_text(spec, places, has_factors);
  return std::string(spec.engine->title) + (settings.empty() ? "" : ", " + settings);
}

std::vector<std::string> code_lines(const ConvertedTarget& target, bool has_remarks) {
  std::vector<std::string> lines, lost;
  const BiasEngine& engine = *target.spec.engine;
  for (std::size_t n = 0; n < engine.numbers.size(); ++n) {
    const BiasNumber& number = engine.numbers[n];
    const std::optional<std::vector<double>> values = set_values(target, n);
    if (number.code.empty() || is_idle(target, n)) continue;
    if (!values) {
      lost.push_back(fmt::format("{} {}: no number everywhere: {}", engine.comment, number.name, reason_of(target, n)));
      continue;
    }
    const ConvertedNumber& first = target.conversions.front().numbers[n];
    const std::string code = first.code.empty() ? std::string(number.code) : first.code;
    const bool is_each = sets_each_place(target);
    const bool has_equivalent = std::ranges::all_of(
        target.conversions, [&](const BiasConversion& each) { return each.numbers[n].value.has_value(); });
    const std::optional<ChosenValue> chosen = choose_value(target, n);
    std::string remark = has_equivalent ? first.code_remark : "no equivalent";
    if (chosen && (chosen->value < number.min || chosen->value > number.max)) {
      remark = fmt::format("its limit; the bias would need {}", code_number(chosen->value));
    }
    remark = has_remarks && !remark.empty() ? fmt::format("  {} {}", engine.comment, remark) : "";
    for (std::size_t i = 0; i < (is_each ? values->size() : 1); ++i) {
      lines.push_back(code_line(code, (*values)[i], i, is_each) + remark);
    }
  }
  // Zeros alone would look like an answer.
  if (has_remarks && !lines.empty()) {
    lines.insert(lines.end(), lost.begin(), lost.end());
    for (const std::string& missing : target.conversions.front().missing) {
      lines.push_back(fmt::format("{} {}: it is lost", engine.comment, missing));
    }
  }
  return lines;
}

std::vector<std::string> notes_of(const ConvertedTarget& target) {
  std::vector<std::string> notes;
  add_engine_notes(target.spec, is_lamp(target.places.front()), notes);
  if (is_complete(target)) add_number_notes(target, true, notes);
  return notes;
}

std::vector<std::string> to_lines(const ConvertedBias& bias) {
  std::vector<std::string> lines;
  const std::string settings = settings_text(bias.source, bias.source_places, true);
  lines.push_back(fmt::format("from {}: {}{}", bias.source.engine->title,
                              numbers_text(bias.source, bias.places.front().light),
                              settings.empty() ? "" : "; with " + settings));
  for (const std::string& line : unit_lines(bias)) lines.push_back(line);
  lines.emplace_back();
  for (const std::string& line : aligned(place_rows(bias))) lines.push_back(line);
  lines.emplace_back();
  for (const std::string& line : aligned(number_rows(bias))) lines.push_back(line);
  for (const ConvertedTarget& target : bias.targets) {
    const std::vector<std::string> code = code_lines(target);
    if (code.empty()) continue;
    lines.emplace_back();
    lines.push_back(title_of(target.spec, target.places, true) + ", rounded up:");
    for (const std::string& line : code) lines.push_back("  " + line);
  }
  return lines;
}

std::vector<std::string> conversion_notes(const ConvertedBias& bias) {
  std::vector<std::string> notes;
  const auto add_engine = [&](const BiasSpec& spec, const std::vector<MapPlace>& places) {
    const BiasEngine& engine = *spec.engine;
    add_engine_notes(spec, is_lamp(places.front()), notes);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].texel == bias.places[i].texel && places[i].range == bias.places[i].range) continue;
      notes.push_back(fmt::format("{}, {}: with t = {} m and R = {} m as given", engine.name, places[i].name,
                                  digits_text(places[i].texel), digits_text(places[i].range)));
    }
  };
  add_engine(bias.source, bias.source_places);
  for (const ConvertedTarget& target : bias.targets) {
    if (target.spec.engine != bias.source.engine) add_engine(target.spec, target.places);
    add_number_notes(target, false, notes);
  }
  std::vector<std::string_view> left_out;
  for (const BiasEngine& engine : bias_engines()) {
    const bool is_target =
        std::ranges::any_of(bias.targets, [&](const ConvertedTarget& target) { return target.spec.engine == &engine; });
    if (engine.no_numbers.empty() && &engine != bias.source.engine && !is_target) left_out.push_back(engine.name);
  }
  if (bias.takes_all && !left_out.empty()) {
    notes.push_back("no part of this bias has an equivalent in: " + joined(left_out, ", "));
  }
  return notes;
}

std::string bias_engines_markdown() {
  std::string text = "| engine | number | default | one unit is | what it does |\n| --- | --- | --- | --- | --- |\n";
  for (const BiasEngine& engine : bias_engines()) {
    std::string name = fmt::format("`{}`", engine.name);
    for (const BiasNumber& number : engine.numbers) {
      const std::string what = number.term == BiasTerm::constant ? "moves the receiver towards the light"
                               : number.term == BiasTerm::slope  ? "draws casters with a polygon offset factor"
                                                                 : text_of(number.offset);
      std::string value = std::isnan(number.value) ? "" : fmt::format("{:.6g}", number.value);
      if (!std::isnan(number.value_of_point)) value += fmt::format("; of a point light {:.6g}", number.value_of_point);
      text += fmt::format("| {} | `{}` | {}{} | {} | {} |\n", name, number.name, value,
                          range_of(number.min, number.max), number.formula, what);
      name.clear();
    }
    if (!engine.no_numbers.empty()) text += fmt::format("| {} | none | | | {} |\n", name, engine.no_numbers);
  }
  text += "\n| engine | settings | besides | source | not verified |\n| --- | --- | --- | --- | --- |\n";
  for (const BiasEngine& engine : bias_engines()) {
    if (engine.source.empty()) continue;
    const std::string settings = joined(engine.settings, "; ", [](const BiasSetting& setting) {
      return fmt::format("`{}`: {}", setting.name, setting.meaning);
    });
    const std::string besides = fmt::format(
        "{}{}{}", engine.note, engine.note.empty() || engine.note_of_lamps.empty() ? "" : "; ", engine.note_of_lamps);
    text += fmt::format("| `{}`: {} | {} | {} | {} | {} |\n", engine.name, engine.title, settings, besides,
                        engine.source, engine.unverified);
  }
  return text;
}

}  // namespace umbrameter
