#include "experiments/settings/tune_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr int most_whole_numbers = 4096;

// Ends of a range without a count; nothing for any other text.
bool is_range(std::string_view text) {
  const auto colons = std::ranges::count(text, ':');
  return colons == 1 || (colons == 2 && text.ends_with(":log"));
}

// To the power of ten at or below the step, so that the value has few digits.
double rounded(double value, double step) {
  const double digits = std::pow(10.0, std::floor(std::log10(step)));
  return std::stod(fmt::format("{:.12g}", std::round(value / digits) * digits));
}

// All whole numbers between the ends that the parameter accepts: odd ones, powers of two.
std::vector<Value> whole_numbers(const Parameter& parameter, double first, double last) {
  std::vector<Value> values;
  const Value before = parameter.value();
  for (auto number = static_cast<std::int64_t>(first); number <= static_cast<std::int64_t>(last); ++number) {
    try {
      parameter.set(number);
      values.emplace_back(number);
    } catch (const Error&) {
      continue;
    }
  }
  parameter.set(before);
  return values;
}

// parse_axis() of a text that the user did not write: messages show the written one.
SweepAxis parse_ends(const Parameters& parameters, std::string_view key, std::string_view text,
                     const std::string& with_count) {
  try {
    return parse_axis(parameters, key, with_count);
  } catch (const Error& error) {
    const std::string_view message = error.what();
    const std::string prefix = fmt::format("--vary {}={}: ", key, with_count);
    if (!message.starts_with(prefix)) throw;
    throw Error(error.code(), fmt::format("--vary {}={}", key, text), std::string(message.substr(prefix.size())));
  }
}

}  // namespace

bool TuneAxis::is_word() const {
  return std::holds_alternative<std::string>(axis.values.front()) || std::holds_alternative<bool>(axis.values.front());
}

TuneAxis parse_tune_axis(const Parameters& parameters, std::string_view key, std::string_view text) {
  const Parameter& parameter = require(parameters, key);
  if (!is_range(text)) return {parse_axis(parameters, key, text)};
  const bool is_log = text.ends_with(":log");
  const std::string_view ends = is_log ? text.substr(0, text.size() - 4) : text;
  const std::string with_count = fmt::format("{}:2{}", ends, is_log ? ":log" : "");
  TuneAxis axis{parse_ends(parameters, key, text, with_count), true, is_log};
  axis.axis.text = text;
  if (to_number(axis.axis.values.front()) > to_number(axis.axis.values.back())) {
    throw Error(ExitCode::usage, fmt::format("--vary {}={}", key, text), "the first end is larger than the last",
                "exchange them");
  }
  if (!std::holds_alternative<int*>(parameter.field)) return axis;
  const double first = to_number(axis.axis.values.front()), last = to_number(axis.axis.values.back());
  if (last - first > most_whole_numbers && !parameter.description.power_of_two) return axis;
  axis.is_continuous = false;
  axis.axis.values = whole_numbers(parameter, first, last);
  return axis;
}

Value value_at(const TuneAxis& axis, double position) {
  const std::vector<Value>& values = axis.axis.values;
  position = std::clamp(position, 0.0, 1.0);
  if (!axis.is_continuous) {
    return values[static_cast<std::size_t>(std::llround(position * static_cast<double>(values.size() - 1)))];
  }
  const double first = to_number(values.front()), last = to_number(values.back());
  if (position == 0.0 || position == 1.0) return position == 0.0 ? values.front() : values.back();
  const double exact =
      axis.is_logarithmic ? first * std::pow(last / first, position) : first + (last - first) * position;
  // A ten-thousandth of the axis; on a logarithmic one of the value.
  const double value = rounded(exact, axis.is_logarithmic ? 1e-3 * std::abs(exact) : 1e-4 * (last - first));
  if (std::holds_alternative<std::int64_t>(values.front())) return static_cast<std::int64_t>(std::llround(value));
  return std::clamp(value, first, last);
}

double position_of(const TuneAxis& axis, const Value& value) {
  const std::vector<Value>& values = axis.axis.values;
  if (axis.is_word() || std::holds_alternative<std::string>(value)) {
    const auto found = std::ranges::find(values, value);
    if (found == values.end()) return -1.0;
    return values.size() < 2 ? 0.0
                             : static_cast<double>(found - values.begin()) / static_cast<double>(values.size() - 1);
  }
  const double number = to_number(value);
  if (axis.is_continuous) {
    const double first = to_number(values.front()), last = to_number(values.back());
    if (first == last) return number == first ? 0.0 : -1.0;
    return axis.is_logarithmic ? std::log(number / first) / std::log(last / first) : (number - first) / (last - first);
  }
  // Between its neighbours in the list.
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (to_number(values[i]) == number) {
      return values.size() < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(values.size() - 1);
    }
  }
  return -1.0;
}

Value present_value(const Parameters& parameters, const TuneAxis& axis) {
  const Parameter& parameter = require(parameters, axis.key());
  if (const auto* const* length = std::get_if<Length*>(&parameter.field)) {
    if ((*length)->unit == axis.axis.length_unit) return (*length)->number;
    return (*length)->number == 0.0 ? Value(0.0) : Value(to_string(**length));
  }
  return parameter.value();
}

}  // namespace umbrameter
