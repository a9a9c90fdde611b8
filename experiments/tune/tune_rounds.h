// The rounds of a tuning whose points are measured elsewhere. A round holds points that the search needs, or probably
// needs, whatever comes out at the others: the search is repeated on what is known with the rest guessed, many times,
// and the points that it asks for most often are measured next.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "experiments/tune/tune_journal.h"
#include "experiments/tune/tune_search.h"

namespace umbrameter {

/// What was measured, by key_of() its query.
using KnownPoints = std::map<std::string, TuneRecord>;

struct NextRound {
  std::vector<TuneQuery> points{};  ///< to measure; empty: the search has ended
  std::size_t used = 0;             ///< known points that the search asks for
  std::size_t searched = 0;         ///< those of them that count as evaluations
  std::size_t limit = 0;            ///< most evaluations
};

/// At least the next point, all those that the search asks for in any case, and as many probable ones as make
/// `wanted`. The same for the same arguments. Throws Error (usage) as search_points() does.
NextRound next_round(const SearchInput& input, const KnownPoints& known, std::size_t wanted);

}  // namespace umbrameter
