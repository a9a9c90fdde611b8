#include "core/parameters.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/lists.h"
#include "core/suggestion.h"

namespace umbrameter {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::string number_text(double number) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, number);
  return {buffer, result.ptr};
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  return parsed<Number>(text.starts_with('+') ? text.substr(1) : text);
}

std::optional<Size> parse_size(std::string_view text) {
  const auto cross = text.find_first_of("xX");
  if (cross == std::string_view::npos) return std::nullopt;
  const auto width = parse_number<int>(text.substr(0, cross));
  const auto height = parse_number<int>(text.substr(cross + 1));
  if (!width || !height) return std::nullopt;
  return Size{*width, *height};
}

std::string join_or(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

[[noreturn]] void reject(const Parameter& parameter, const std::string& given) {
  const std::string& unit = parameter.description.unit;
  const bool has_unit = std::holds_alternative<double*>(parameter.field) && !unit.empty() && unit != "1";
  throw Error(ExitCode::usage, parameter.key, "'" + given + "' is not allowed",
              "expected " + parameter.limits() + (has_unit ? ", in " + unit : ""));
}

// The choice's own name for a word that may be an alias.
std::string name_of_choice(const FieldDescription& description, const std::string& word) {
  for (const auto& [alias, name] : description.aliases) {
    if (word == alias) return name;
  }
  return word;
}

bool fits(const FieldDescription& description, double number) {
  if (!std::isfinite(number) || number < description.min || number > description.max) return false;
  const auto integer = static_cast<std::int64_t>(number);
  if (description.odd && integer % 2 == 0) return false;
  return !description.power_of_two || (integer > 0 && (integer & (integer - 1)) == 0);
}

bool fits(const FieldDescription& description, const Length& length) {
  if (length.unit == LengthUnit::automatic) return description.units.automatic;
  if (length.unit == LengthUnit::texels && !description.units.texels) return false;
  if (length.unit == LengthUnit::map_depth && !description.units.map_depth) return false;
  if (length.unit == LengthUnit::scene_percent && !description.units.scene_size) return false;
  return fits(description, length.number);
}

struct NamedUnit {
  std::string_view suffix;
  LengthUnit unit;
  double factor;  ///< of the number, to get LengthUnit's own
};
// A suffix that ends another one comes after it.
constexpr NamedUnit length_units[] = {
    {"texels", LengthUnit::texels, 1.0},   {"texel", LengthUnit::texels, 1.0},   {"%", LengthUnit::scene_percent, 1.0},
    {"depth", LengthUnit::map_depth, 1.0}, {"mm", LengthUnit::metres, 0.001},    {"cm", LengthUnit::metres, 0.01},
    {"km", LengthUnit::metres, 1000.0},    {"inch", LengthUnit::metres, 0.0254}, {"in", LengthUnit::metres, 0.0254},
    {"foot", LengthUnit::metres, 0.3048},  {"ft", LengthUnit::metres, 0.3048},   {"m", LengthUnit::metres, 1.0},
};

// "2cm" is 0.02: the decimal number is scaled, never the binary one, which would be 0.020000000000000004 for some.
double scaled_decimal(double number, double factor) {
  char digits[40];
  const double product = number * factor;
  const auto end = std::to_chars(digits, digits + sizeof digits, product, std::chars_format::general, 15).ptr;
  double nearest = product;
  std::from_chars(digits, end, nearest);
  return nearest;
}

}  // namespace

std::string_view unit_name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metres:
      return "m";
    case LengthUnit::texels:
      return "texels";
    case LengthUnit::map_depth:
      return "of the map's depth";
    case LengthUnit::scene_percent:
      return "% of the scene's diagonal";
    case LengthUnit::automatic:
      return "";
  }
  return "";
}

double to_metres(const Length& length, double scene_size) {
  assert(length.unit == LengthUnit::metres || length.unit == LengthUnit::scene_percent);
  return length.unit == LengthUnit::scene_percent ? 0.01 * length.number * scene_size : length.number;
}

std::string to_string(const Length& length) {
  switch (length.unit) {
    case LengthUnit::metres:
      return number_text(length.number);
    case LengthUnit::texels:
      return number_text(length.number) + "texels";
    case LengthUnit::map_depth:
      return number_text(length.number) + "depth";
    case LengthUnit::scene_percent:
      return number_text(length.number) + "%";
    case LengthUnit::automatic:
      return "auto";
  }
  return {};
}

std::optional<Length> parse_length(std::string_view text) {
  if (text == "auto") return Length{0.0, LengthUnit::automatic};
  for (const NamedUnit& named : length_units) {
    if (!text.ends_with(named.suffix)) continue;
    text.remove_suffix(named.suffix.size());
    while (text.ends_with(' ')) text.remove_suffix(1);
    const auto number = parse_number<double>(text);
    if (!number) return std::nullopt;
    return Length{named.factor == 1.0 ? *number : scaled_decimal(*number, named.factor), named.unit};
  }
  const auto metres = parse_number<double>(text);
  if (!metres) return std::nullopt;
  return Length{*metres};
}

std::string to_string(const Value& value) {
  return std::visit(
      Overloaded{[](bool truth) { return std::string(truth ? "true" : "false"); },
                 [](std::int64_t integer) { return std::to_string(integer); },
                 [](double number) { return number_text(number); }, [](const std::string& text) { return text; }},
      value);
}

Value Parameter::value() const {
  return std::visit(
      Overloaded{
          [](const bool* truth) -> Value { return *truth; },
          [](const int* integer) -> Value { return std::int64_t{*integer}; },
          [](const double* number) -> Value { return *number; }, [](const std::string* text) -> Value { return *text; },
          [](const Size* size) -> Value { return std::to_string(size->width) + "x" + std::to_string(size->height); },
          [](const ChoiceRef& choice) -> Value { return choice.names.at(static_cast<std::size_t>(*choice.value)); },
          [](const Length* length) -> Value {
            if (length->unit == LengthUnit::metres) return length->number;
            return to_string(*length);
          }},
      field);
}

void Parameter::set(const Value& value) const {
  const auto number = [&]() -> std::optional<double> {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
    if (const auto* real = std::get_if<double>(&value)) return *real;
    return std::nullopt;
  };
  const bool accepted =
      std::visit(Overloaded{[&](bool* truth) {
                              const auto* given = std::get_if<bool>(&value);
                              if (given != nullptr) *truth = *given;
                              return given != nullptr;
                            },
                            [&](int* integer) {
                              const auto given = number();
                              if (!given || *given != std::floor(*given) ||
                                  std::abs(*given) > std::numeric_limits<int>::max() || !fits(description, *given)) {
                                return false;
                              }
                              *integer = static_cast<int>(*given);
                              return true;
                            },
                            [&](double* real) {
                              const auto given = number();
                              if (!given || !fits(description, *given)) return false;
                              *real = *given;
                              return true;
                            },
                            [&](std::string* text) {
                              const auto* given = std::get_if<std::string>(&value);
                              *text = given != nullptr ? *given : to_string(value);
                              return true;
                            },
                            [&](Size* size) {
                              const auto* given = std::get_if<std::string>(&value);
                              const auto parsed = given != nullptr ? parse_size(*given) : std::nullopt;
                              if (!parsed || !fits(description, parsed->width) || !fits(description, parsed->height))
                                return false;
                              *size = *parsed;
                              return true;
                            },
                            [&](const ChoiceRef& choice) {
                              const auto* given = std::get_if<std::string>(&value);
                              if (given == nullptr) return false;
                              const std::string name = name_of_choice(description, *given);
                              const auto found = std::ranges::find(choice.names, name);
                              if (found == choice.names.end()) return false;
                              *choice.value = static_cast<int>(found - choice.names.begin());
                              return true;
                            },
                            [&](Length* length) {
                              const auto metres = number();
                              const auto* text = std::get_if<std::string>(&value);
                              std::optional<Length> given;
                              if (metres) given = Length{*metres};
                              if (text != nullptr) given = parse_length(*text);
                              if (!given || !fits(description, *given)) return false;
                              *length = *given;
                              return true;
                            }},
                 field);
  if (!accepted) reject(*this, to_string(value));
}

void Parameter::set_text(std::string_view text) const {
  const std::string given(text);
  std::visit(Overloaded{[&](bool*) {
                          if (given == "true" || given == "1" || given == "on") return set(true);
                          if (given == "false" || given == "0" || given == "off") return set(false);
                          reject(*this, given);
                        },
                        [&](int*) {
                          const auto integer = parse_number<std::int64_t>(text);
                          if (!integer) reject(*this, given);
                          set(*integer);
                        },
                        [&](double*) {
                          const auto real = parse_number<double>(text);
                          if (!real) reject(*this, given);
                          set(*real);
                        },
                        [&](const auto&) { set(given); }},
             field);
}

std::string Parameter::limits() const {
  const auto range = [&](std::string kind) {
    const bool has_min = std::isfinite(description.min);
    const bool has_max = std::isfinite(description.max);
    if (description.odd) kind = "an odd integer";
    if (has_min && has_max) kind += " from " + number_text(description.min) + " to " + number_text(description.max);
    if (has_min && !has_max) kind += ", at least " + number_text(description.min);
    if (!has_min && has_max) kind += ", at most " + number_text(description.max);
    if (description.power_of_two) kind += ", a power of two";
    return kind;
  };
  return std::visit(
      Overloaded{[](bool*) { return std::string("true or false"); }, [&](int*) { return range("an integer"); },
                 [&](double*) { return range("a number"); }, [](std::string*) { return std::string("text"); },
                 [&](Size*) { return "WIDTHxHEIGHT, each " + range("an integer"); },
                 [&](const ChoiceRef& choice) {
                   std::string names = join_or(choice.names);
                   for (const auto& [alias, name] : description.aliases)
                     names += "; " + alias + " is accepted for " + name;
                   return names;
                 },
                 [&](Length*) {
                   std::string text = range("a length") + " in m (2cm, 20mm)";
                   if (description.units.texels) text += ", texels (1.5texels)";
                   if (description.units.map_depth) text += ", the map's depth from 0 to 1 (0.0005depth)";
                   if (description.units.scene_size) text += ", % of the scene's diagonal (2%)";
                   if (description.units.automatic) text += ", or auto";
                   return text;
                 }},
      field);
}

bool Parameter::is_number() const {
  return std::holds_alternative<int*>(field) || std::holds_alternative<double*>(field) ||
         std::holds_alternative<Length*>(field);
}

const Parameter* find(const Parameters& parameters, std::string_view key) {
  const auto found = std::ranges::find(parameters, key, &Parameter::key);
  return found == parameters.end() ? nullptr : &*found;
}

const Parameter& require(const Parameters& parameters, std::string_view key) {
  if (const Parameter* parameter = find(parameters, key)) return *parameter;
  std::vector<std::string> names;
  for (const bool basic : {true, false}) {
    for (const Parameter& parameter : parameters) {
      if (parameter.description.basic == basic) names.push_back(parameter.key);
    }
  }
  std::string remedy = suggestion(similar_names(key, names));
  if (remedy.empty()) remedy = "'umbrameter parameters' lists all parameters";
  throw Error(ExitCode::usage, std::string(key), "unknown parameter", remedy);
}

Parameters concatenate(std::vector<Parameters> groups) {
  Parameters all;
  for (Parameters& group : groups) {
    all.insert(all.end(), std::make_move_iterator(group.begin()), std::make_move_iterator(group.end()));
  }
  return all;
}

std::string shader_defines(const Parameters& parameters) {
  const auto macro = [](std::string_view key) {
    std::string name;
    for (const char c : key) {
      name += std::isalnum(static_cast<unsigned char>(c)) != 0
                  ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                  : '_';
    }
    return name;
  };
  std::string text;
  for (const Parameter& parameter : parameters) {
    const std::string name = macro(parameter.key);
    std::visit(Overloaded{[&](bool* truth) { text += "#define " + name + (*truth ? " 1\n" : " 0\n"); },
                          [&](int* integer) { text += "#define " + name + " " + std::to_string(*integer) + "\n"; },
                          [&](double* number) {
                            std::string digits = number_text(*number);
                            if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
                            text += "#define " + name + " " + digits + "\n";
                          },
                          [&](const ChoiceRef& choice) {
                            text += "#define " + name + " " + std::to_string(*choice.value) + "\n";
                            for (std::size_t i = 0; i < choice.names.size(); ++i) {
                              text += "#define " + name + "_" + macro(choice.names[i]) + " " + std::to_string(i) + "\n";
                            }
                          },
                          [](const auto&) {}},
               parameter.field);
  }
  return text;
}

}  // namespace umbrameter
