// Suggestions for a mistyped name.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

/// Edit distance by insertion, deletion, substitution (Levenshtein 1966).
int edit_distance(std::string_view a, std::string_view b);

/// The names that a mistyped one may mean, at most three, all equally near, in the given order. Nearest are names that
/// differ by a few letters as a whole; then names whose last part, after the dot, has the same words ("bias" in
/// "shadow.constant-bias") or all of whose words are given ("shadow.slope-scaled-bias"), then those whose last part
/// differs by a few letters; each first in the same group.
std::vector<std::string> similar_names(std::string_view given, std::span<const std::string> names);

/// "did you mean 'a', 'b' or 'c'?"; empty for no names.
std::string suggestion(const std::vector<std::string>& names);

}  // namespace umbrameter
