// The one description of every parameter. Flags, experiment files, CSV columns, settings tables,
// the reference page and shader #defines all come from it.
//
// A parameter struct holds its defaults; a free function describe(Struct&) beside it lists each field
// once and returns the list bound to that object.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/math.h"

namespace umbrameter {

/// A parameter's value as users write it: a choice is the string of its name, a size is "WxH", a length the number of
/// metres or, in another unit, its text.
using Value = std::variant<bool, std::int64_t, double, std::string>;

/// "true", "17", "0.05", "box"; floating-point numbers in the shortest form that reads back the same.
std::string to_string(const Value& value);

/// A closed choice: an enum whose values count from 0, and the name of each.
struct ChoiceRef {
  int* value = nullptr;
  std::vector<std::string> names;
};

/// Image size, pixels.
struct Size {
  int width = 1280;
  int height = 720;
  friend bool operator==(const Size&, const Size&) = default;
};

/// What the number of a Length counts.
enum class LengthUnit : int {
  metres,
  texels,         ///< of the shadow map, as large as they are at the receiver
  map_depth,      ///< of the depth that the shadow map stores, which runs from 0 to 1
  scene_percent,  ///< hundredths of the diagonal of the scene's bounds
  automatic       ///< no number: what reads the field derives it from another one
};

/// A length as users write it: "0.02", "2cm", "1.5texels", "0.0005depth", "2%" (of the scene's diagonal) or "auto".
struct Length {
  double number = 0.0;
  LengthUnit unit = LengthUnit::metres;
  Length& operator=(double metres) { return *this = Length{metres}; }
  friend bool operator==(const Length&, const Length&) = default;
};

/// As a column or label names it: "m", "texels", "% of the scene's size"; empty for automatic.
std::string_view unit_name(LengthUnit unit);

/// In metres. scene_size is the diagonal of the scene's bounds, metres; the unit must be metres or scene_percent.
double to_metres(const Length& length, double scene_size);

/// "0.02" for metres, "1.5texels", "2%", "auto": read back by parse_length() as the same value.
std::string to_string(const Length& length);

/// Nothing where the text is no length. Units: m, mm, cm, km, inch, foot (and in, ft), texels (texel),
/// depth (of the map), % of the scene.
std::optional<Length> parse_length(std::string_view text);

/// The units besides metres that a field accepts.
struct LengthUnits {
  bool texels = false;
  bool map_depth = false;
  bool scene_size = false;
  bool automatic = false;
};

/// What is written down about a field, once.
struct FieldDescription {
  std::string unit{};     ///< "m", "texels", "px", "1"; empty where there is none
  std::string meaning{};  ///< one sentence, no full stop
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool power_of_two = false;
  bool odd = false;
  LengthUnits units{};  ///< of a Length
  bool basic = false;   ///< listed by --help; --help-all lists every parameter
  /// Of a choice: another word that users know, and the name that it means: {"pcf", "box"}.
  std::vector<std::pair<std::string, std::string>> aliases{};
};

/// One described field of one object.
struct Parameter {
  std::string key;  ///< full name, "shadow.constant-bias": flag, TOML key and CSV column
  FieldDescription description;
  std::variant<bool*, int*, double*, std::string*, Size*, ChoiceRef, Length*> field;

  Value value() const;
  /// Throws Error (usage) that names the key and its limits when the value does not fit.
  void set(const Value& value) const;
  /// As set(), from text: "0.05", "true", "box", "1280x720".
  void set_text(std::string_view text) const;
  /// "integer from 1 to 16384, a power of two", "nearest or box": for messages and help.
  std::string limits() const;
  bool is_number() const;
};

using Parameters = std::vector<Parameter>;

/// Collects the fields of one struct under one group name.
class Description {
 public:
  explicit Description(std::string group) : group_(std::move(group)) {}

  template <class Field>
  Description& field(const char* name, Field& member, FieldDescription description) {
    parameters_.push_back({group_ + "." + name, std::move(description), &member});
    return *this;
  }
  /// An enum with underlying type int; names[i] is the name of value i.
  template <class Enum>
  Description& choice(const char* name, Enum& member, std::span<const std::string_view> names,
                      FieldDescription description) {
    static_assert(std::is_same_v<std::underlying_type_t<Enum>, int>);
    parameters_.push_back({group_ + "." + name, std::move(description),
                           ChoiceRef{reinterpret_cast<int*>(&member), {names.begin(), names.end()}}});
    return *this;
  }
  Parameters take() { return std::move(parameters_); }

 private:
  std::string group_;
  Parameters parameters_;
};

/// The parameter of that full name, or nullptr.
const Parameter* find(const Parameters& parameters, std::string_view key);

/// As find(), but an unknown key is an Error (usage) that suggests what may be meant.
const Parameter& require(const Parameters& parameters, std::string_view key);

/// Appends the lists of several groups.
Parameters concatenate(std::vector<Parameters> groups);

/// "#define SHADOW_FILTER 1" and so on: one line a parameter, numbers, truths and choices only.
/// A choice also defines each of its names: "#define SHADOW_FILTER_NEAREST 0".
std::string shader_defines(const Parameters& parameters);

/// How many members an aggregate has; for the test that each is described.
template <class Aggregate>
constexpr int count_fields();

namespace detail {
struct AnyField {
  template <class T>
  constexpr operator T&() const noexcept;
  template <class T>
  constexpr operator T&&() const noexcept;
};
template <class Aggregate, std::size_t... I>
constexpr bool takes_fields(std::index_sequence<I...>) {
  return requires { Aggregate{(static_cast<void>(I), AnyField{})...}; };
}
template <class Aggregate, std::size_t count>
constexpr int count_fields_from() {
  if constexpr (takes_fields<Aggregate>(std::make_index_sequence<count>{})) {
    return static_cast<int>(count);
  } else {
    static_assert(count > 0);
    return count_fields_from<Aggregate, count - 1>();
  }
}
}  // namespace detail

template <class Aggregate>
constexpr int count_fields() {
  return detail::count_fields_from<Aggregate, 64>();
}

}  // namespace umbrameter
