#include "core/suggestion.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace umbrameter {
namespace {

constexpr std::size_t max_suggestions = 3;

std::string_view last_part(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

std::vector<std::string_view> words_of(std::string_view part) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t end = part.find_first_of("-_.");
    if (end != 0 && !part.empty()) words.push_back(part.substr(0, end));
    if (end == std::string_view::npos) return words;
    part.remove_prefix(end + 1);
  }
}

// One wrong letter in a short word, three in a long one.
bool is_slip(std::string_view a, std::string_view b) {
  const std::size_t letters = std::min(a.size(), b.size());
  const int most = letters < 5 ? 1 : letters < 12 ? 2 : 3;
  return letters >= 3 && edit_distance(a, b) <= most;
}

bool has_words(const std::vector<std::string_view>& words, const std::vector<std::string_view>& wanted, bool slips) {
  return !wanted.empty() && std::ranges::all_of(wanted, [&](std::string_view want) {
    return std::ranges::any_of(words,
                               [&](std::string_view word) { return slips ? is_slip(word, want) : word == want; });
  });
}

// Smaller is better; nothing for a name that has nothing in common with the given one.
std::optional<int> rank(std::string_view given, std::string_view name) {
  constexpr int max_edits = 3;
  if (is_slip(given, name)) return edit_distance(given, name);
  const std::string_view part = last_part(name);
  const std::string_view given_part = last_part(given);
  const std::string_view group = name.substr(0, name.size() - part.size());
  const bool is_other_group = group != given.substr(0, given.size() - given_part.size());
  const int first = max_edits + 1 + (is_other_group ? max_edits + 1 : 0);
  const auto words = words_of(part);
  const auto wanted = words_of(given_part);
  if (has_words(words, wanted, false)) return first;
  // Every word of the name is given, with others.
  if (words.size() > 1 && has_words(wanted, words, false)) return first;
  if (is_slip(part, given_part)) return first + 1 + edit_distance(part, given_part);
  if (has_words(words, wanted, true)) return first + 2 + max_edits;
  return std::nullopt;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

std::vector<std::string> similar_names(std::string_view given, std::span<const std::string> names) {
  std::vector<std::pair<int, std::string>> ranked;
  for (const std::string& name : names) {
    if (const std::optional<int> r = rank(given, name)) ranked.emplace_back(*r, name);
  }
  std::ranges::stable_sort(ranked, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> best;
  for (const auto& [r, name] : ranked) {
    // Only the best rank: behind a slip of one letter, what merely shares a word is no candidate.
    if (best.size() == max_suggestions || r != ranked.front().first) break;
    best.push_back(name);
  }
  return best;
}

std::string suggestion(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = "did you mean ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "'" + names[i] + "'";
  }
  return text + "?";
}

}  // namespace umbrameter
