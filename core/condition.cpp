#include "core/condition.h"

#include <array>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/parameters.h"

namespace umbrameter {
namespace {

constexpr std::array<std::pair<std::string_view, Relation>, 4> relations = {
    {{"<=", Relation::at_most}, {">=", Relation::at_least}, {"<", Relation::less}, {">", Relation::greater}}};

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

// Reads a text from its beginning.
class Reader {
 public:
  Reader(std::string_view text, const std::string& option, const char* form)
      : text_(text), rest_(text), option_(option), form_(form) {}

  [[noreturn]] void reject(const std::string& why) const {
    throw Error(ExitCode::usage, option_ + " '" + std::string(text_) + "'", why, std::string("write it like ") + form_);
  }

  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }

  bool take(std::string_view token) {
    skip_blanks();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  // "name" or "|name|"
  std::pair<std::string, bool> name() {
    const bool is_magnitude = take("|");
    skip_blanks();
    std::size_t size = 0;
    while (size < rest_.size() && is_name_character(rest_[size])) ++size;
    if (size == 0) reject("there is no name of a statistic");
    std::string name(rest_.substr(0, size));
    rest_.remove_prefix(size);
    if (is_magnitude && !take("|")) reject("the second '|' is missing");
    return {std::move(name), is_magnitude};
  }

  bool number(double& value) {
    skip_blanks();
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) return false;
    if (!std::isfinite(value)) reject("the number must be finite");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  Bound bound(bool needs_relation) {
    Bound bound;
    bool has_relation = false;
    for (const auto& [token, relation] : relations) {
      if (has_relation || !take(token)) continue;
      bound.relation = relation;
      has_relation = true;
    }
    if (needs_relation && !has_relation) reject("there is no <, <=, > or >=");
    if (!number(bound.quantity.number)) reject("there is no number to compare with");
    skip_blanks();
    std::string_view unit = rest_;
    while (!unit.empty() && unit.back() == ' ') unit.remove_suffix(1);
    bound.quantity.unit = unit;
    return bound;
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t')) rest_.remove_prefix(1);
  }

  std::string_view text_;
  std::string_view rest_;
  const std::string& option_;
  const char* form_;
};

}  // namespace

std::string_view relation_text(Relation relation) {
  for (const auto& [token, each] : relations) {
    if (each == relation) return token;
  }
  return "";
}

bool holds(double value, Relation relation, double bound) {
  switch (relation) {
    case Relation::less:
      return value < bound;
    case Relation::at_most:
      return value <= bound;
    case Relation::greater:
      return value > bound;
    case Relation::at_least:
      return value >= bound;
  }
  return false;
}

Condition parse_condition(std::string_view text, const std::string& option) {
  Reader reader(text, option, "'acne<0.1%' or 'psnr>=30'");
  Condition condition;
  std::tie(condition.name, condition.is_magnitude) = reader.name();
  condition.bound = reader.bound(true);
  condition.text = text;
  return condition;
}

Bound parse_bound(std::string_view text, const std::string& option) {
  return Reader(text, option, "'< 0.1%', '>= 30' or '0.001'").bound(false);
}

std::vector<WeightedTerm> parse_weighted_sum(std::string_view text, const std::string& option) {
  Reader reader(text, option, "'mae' or 'acne + 0.5*rmse'");
  std::vector<WeightedTerm> terms;
  do {
    WeightedTerm term;
    if (reader.number(term.weight) && !reader.take("*")) reader.reject("a '*' is missing between weight and name");
    std::tie(term.name, term.is_magnitude) = reader.name();
    terms.push_back(std::move(term));
  } while (reader.take("+"));
  if (!reader.at_end()) reader.reject("only '+' and '*' combine statistics");
  return terms;
}

double in_unit(const Quantity& quantity, std::string_view unit, std::string_view name, const std::string& option) {
  const std::string& written = quantity.unit;
  if (written.empty() || written == unit) return quantity.number;
  if (unit == "1" && written == "%") return quantity.number / 100.0;
  if (unit == "m") {
    const auto length = parse_length(to_string(Value(quantity.number)) + written);
    if (length && length->unit == LengthUnit::metres) return length->number;
  }
  throw Error(
      ExitCode::usage, option,
      std::string(name) + (unit == "1" ? " is a share" : " is in " + std::string(unit)) + ", not in '" + written + "'",
      unit == "1" ? "write 0.001 or 0.1%" : "leave the unit out");
}

}  // namespace umbrameter
