#include "experiments/settings/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_values = 1'000'000;
constexpr std::size_t max_cells = 1'000'000'000;

[[noreturn]] void reject(std::string_view key, std::string_view text, const std::string& why,
                         const char* remedy = "write first:last:count, first:last:count:log or a list a,b,c") {
  throw Error(ExitCode::usage, "--vary " + std::string(key) + "=" + std::string(text), why, remedy);
}

double parse_real(std::string_view key, std::string_view text, const std::string& part) {
  double number = 0.0;
  const Parameter reader{std::string(key), {}, &number};
  try {
    reader.set_text(part);
  } catch (const Error&) {
    reject(key, text, "'" + part + "' is not a number");
  }
  return number;
}

// The nearest number of 15 significant digits: what was meant where steps of 0.1 are no sums of powers of two.
double rounded(double value) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 15).ptr;
  std::from_chars(digits, end, value);
  return value;
}

// Both ends are met exactly.
std::vector<double> spaced(double first, double last, std::size_t count, bool logarithmic) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || i + 1 == count) {
      values[i] = i == 0 ? first : last;
      continue;
    }
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = rounded(logarithmic ? first * std::pow(last / first, t) : first + (last - first) * t);
    // What is left of 0 between a negative and a positive end.
    constexpr double rounding = 1e-14;
    if (std::abs(values[i]) < rounding * std::max(std::abs(first), std::abs(last)) && !logarithmic) values[i] = 0.0;
  }
  return values;
}

std::vector<double> parse_range(std::string_view key, std::string_view text, const std::vector<std::string>& parts,
                                const std::function<double(const std::string&)>& parse_end) {
  if (parts.size() != 3 && !(parts.size() == 4 && parts[3] == "log")) reject(key, text, "not a valid axis");
  const double first = parse_end(parts[0]);
  const double last = parse_end(parts[1]);
  const double count = parse_real(key, text, parts[2]);
  if (count < 1.0 || count != std::floor(count) || count > static_cast<double>(max_values)) {
    reject(key, text, "the count must be an integer from 1 to " + std::to_string(max_values));
  }
  if (count == 1.0 && first != last) reject(key, text, "a count of 1 needs equal ends");
  const bool logarithmic = parts.size() == 4;
  if (logarithmic && !(first * last > 0.0)) reject(key, text, "a log axis needs two positive or two negative ends");
  return spaced(first, last, static_cast<std::size_t>(count), logarithmic);
}

// The numbers of the lengths of one axis, and their unit, which the first that is not a bare 0 decides.
struct LengthReader {
  std::string_view key;
  std::string_view text;
  std::optional<LengthUnit> unit{};

  double operator()(const std::string& part) {
    const std::optional<Length> length = parse_length(part);
    if (!length || length->unit == LengthUnit::automatic) reject(key, text, "'" + part + "' is not a length");
    if (length->number == 0.0 && length->unit == LengthUnit::metres) return 0.0;
    if (unit && *unit != length->unit) {
      reject(key, text,
             fmt::format("'{}' is in {}, but the values before it are in {}", part, unit_name(length->unit),
                         unit_name(*unit)),
             "write the unit at every value");
    }
    unit = length->unit;
    return length->number;
  }
};

// The values of a list; "all" stands for all names of a choice, unless it is one of them.
std::vector<std::string> parts_of(const Parameter& parameter, std::string_view text) {
  const auto* choice = std::get_if<ChoiceRef>(&parameter.field);
  if (choice == nullptr || text != "all") return split(text, ',');
  return std::ranges::find(choice->names, "all") == choice->names.end() ? choice->names : split(text, ',');
}

}  // namespace

void set_value(const Parameters& parameters, const SweepAxis& axis, const Value& value) {
  const Parameter& parameter = require(parameters, axis.key);
  if (std::holds_alternative<Length*>(parameter.field)) {
    parameter.set(to_string(Length{to_number(value), axis.length_unit}));
  } else {
    parameter.set(value);
  }
}

SweepAxis parse_axis(const Parameters& parameters, std::string_view key, std::string_view text) {
  const Parameter& parameter = require(parameters, key);
  SweepAxis axis{std::string(key), std::string(text), {}, parameter.description.unit};
  const Value before = parameter.value();
  const bool is_length = std::holds_alternative<Length*>(parameter.field);
  LengthReader lengths{key, text};
  const auto accept_lengths = [&](const std::vector<double>& numbers) {
    axis.length_unit = lengths.unit.value_or(LengthUnit::metres);
    axis.unit = unit_name(axis.length_unit);
    for (const double number : numbers) {
      axis.values.emplace_back(number);
      set_value(parameters, axis, number);
    }
  };
  const auto accept = [&](const auto& set_value) {
    set_value();
    axis.values.push_back(parameter.value());
  };
  try {
    if (text.find(':') != std::string_view::npos) {
      if (!parameter.is_number()) reject(key, text, "only numeric parameters have ranges");
      const bool whole = std::holds_alternative<int*>(parameter.field);
      const std::vector<double> range = parse_range(key, text, split(text, ':'), [&](const std::string& part) {
        return is_length ? lengths(part) : parse_real(key, text, part);
      });
      if (is_length) {
        accept_lengths(range);
      } else {
        for (const double value : range) accept([&] { parameter.set(whole ? std::round(value) : value); });
      }
    } else if (is_length) {
      accept_lengths(mapped(split(text, ','), lengths));
    } else {
      for (const std::string& part : parts_of(parameter, text)) accept([&] { parameter.set_text(part); });
    }
  } catch (...) {
    parameter.set(before);
    throw;
  }
  parameter.set(before);
  std::set<Value> seen;
  for (const Value& value : axis.values) {
    if (!seen.insert(value).second) reject(key, text, "the value " + to_string(value) + " occurs twice");
  }
  return axis;
}

std::pair<std::string, std::string> split_assignment(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw Error(ExitCode::usage, "--vary " + assignment, "no '='",
                "write --vary parameter=first:last:count or parameter=a,b,c");
  }
  return {assignment.substr(0, equals), assignment.substr(equals + 1)};
}

SweepAxis parse_axis(const Parameters& parameters, const std::string& assignment) {
  const auto [key, text] = split_assignment(assignment);
  return parse_axis(parameters, key, text);
}

std::vector<SweepAxis> parse_axes(const Parameters& parameters,
                                  const std::vector<std::pair<std::string, std::string>>& axes) {
  std::vector<SweepAxis> parsed;
  for (const auto& [key, text] : axes) parsed.push_back(parse_axis(parameters, key, text));
  return parsed;
}

std::size_t count_cells(const std::vector<SweepAxis>& axes) {
  std::size_t cells = 1;
  for (const SweepAxis& axis : axes) {
    if (!axis.values.empty() && cells > max_cells / axis.values.size()) {
      throw Error(ExitCode::usage, "sweep", "more than " + std::to_string(max_cells) + " cells",
                  "make an axis shorter or split the sweep");
    }
    cells *= axis.values.size();
  }
  return cells;
}

}  // namespace umbrameter
