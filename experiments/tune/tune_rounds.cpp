#include "experiments/tune/tune_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.h"

namespace umbrameter {
namespace {

constexpr std::uint32_t scenarios = 32;
constexpr std::size_t horizon = 1024;      // unknown points of a scenario
constexpr double least_probability = 0.3;  // of a point that is measured although it may not be needed
constexpr double spread_of_guesses = 0.2;  // standard deviation, as a share of the range of the samples around
constexpr double unknown_spread = 0.1;     // standard deviation where there are too few samples
constexpr double word_distance = 1.0;      // between points that differ in a word, on the scale of whole axes

// A value at a place of the search, measured or guessed.
struct Sample {
  std::vector<double> position;  // of each axis, 0 to 1
  double number = 0.0;           // to_number() of its score
};

// Solves a x = b for symmetric, positive a; returns x[0].
double first_unknown(std::vector<std::vector<double>> a, std::vector<double> b) {
  for (std::size_t i = b.size(); i-- > 1;) {
    for (std::size_t row = 0; row < i; ++row) {
      const double factor = a[row][i] / a[i][i];
      for (std::size_t column = 0; column <= i; ++column) a[row][column] -= factor * a[i][column];
      b[row] -= factor * b[i];
    }
  }
  return b[0] / a[0][0];
}

// What the search may find where nothing is known: the plane through the nearest samples, give or take their spread.
class Guesser {
 public:
  explicit Guesser(const SearchInput& input) : in_(input) {}

  void learn(const std::vector<Value>& values, double number) { samples_.push_back({position_at(values), number}); }

  // `chance` is normally distributed. The guess is learnt.
  double guess(const std::vector<Value>& values, double chance) {
    Sample sample{position_at(values), 0.5};
    std::vector<std::pair<double, const Sample*>> near;
    for (const Sample& each : samples_) near.emplace_back(squared_distance(sample.position, each.position), &each);
    const std::size_t count = std::min(near.size(), 2 * sample.position.size() + 2);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    near.resize(count);
    if (!near.empty()) sample.number = plane_at(sample.position, near);
    sample.number += chance * (near.empty() || near.size() < sample.position.size() ? unknown_spread : spread_of(near));
    sample.number = std::clamp(sample.number, 0.001, 1.999);
    samples_.push_back(sample);
    return sample.number;
  }

 private:
  std::vector<double> position_at(const std::vector<Value>& values) const {
    std::vector<double> position;
    for (std::size_t a = 0; a < in_.axes.size(); ++a) {
      if (a != in_.exact) position.push_back(position_of(in_.axes[a], values[a]));
    }
    return position;
  }

  double squared_distance(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    std::size_t i = 0;
    for (std::size_t axis = 0; axis < in_.axes.size(); ++axis) {
      if (axis == in_.exact) continue;
      const double difference = a[i] - b[i];
      ++i;
      sum += in_.axes[axis].is_word() ? (difference != 0.0 ? word_distance : 0.0) : difference * difference;
    }
    return sum;
  }

  // Weighted least squares; the slopes are drawn to 0, so that few samples are enough.
  static double plane_at(const std::vector<double>& position,
                         const std::vector<std::pair<double, const Sample*>>& near) {
    const std::size_t unknowns = position.size() + 1;
    std::vector<std::vector<double>> a(unknowns, std::vector<double>(unknowns, 0.0));
    std::vector<double> b(unknowns, 0.0);
    const double scale = near.back().first + 1e-12;
    for (const auto& [squared, sample] : near) {
      const double weight = 1.0 / (squared + 1e-3 * scale);
      std::vector<double> row = {1.0};
      for (std::size_t i = 0; i < position.size(); ++i) row.push_back(sample->position[i] - position[i]);
      for (std::size_t i = 0; i < unknowns; ++i) {
        for (std::size_t k = 0; k < unknowns; ++k) a[i][k] += weight * row[i] * row[k];
        b[i] += weight * row[i] * sample->number;
      }
    }
    for (std::size_t i = 1; i < unknowns; ++i) a[i][i] += 1e-3;
    return first_unknown(std::move(a), std::move(b));
  }

  static double spread_of(const std::vector<std::pair<double, const Sample*>>& near) {
    const auto [least, most] = std::ranges::minmax_element(
        near, [](const auto& x, const auto& y) { return x.second->number < y.second->number; });
    return spread_of_guesses * (most->second->number - least->second->number);
  }

  const SearchInput& in_;
  std::vector<Sample> samples_;
};

// One repetition of the search, with guesses where nothing is known.
struct Repetition {
  std::vector<TuneQuery> unknown{};  // in the order in which the search asks for them
  std::size_t used = 0;
  std::size_t searched = 0;
  std::size_t limit = 0;
};

Repetition repeat(const SearchInput& input, const KnownPoints& known, Guesser guesser, std::uint32_t scenario) {
  struct FarEnough {};
  Repetition repetition;
  const AskPoint ask = [&](const TuneQuery& query, const TuneGoal& goal) {
    const bool is_point = query.kind == TuneQuery::Kind::point;
    if (const auto found = known.find(key_of(query, input.exact)); found != known.end()) {
      if (repetition.unknown.empty()) {
        ++repetition.used;
        if (is_point) ++repetition.searched;
      }
      return scored(found->second, goal);
    }
    if (repetition.unknown.size() == horizon) throw FarEnough{};
    repetition.unknown.push_back(query);
    TunePoint guessed{query.values, {}, {}};
    if (!is_point) return guessed;
    // A sum of three is almost normally distributed; twice that has the variance 1.
    double chance = -3.0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      chance += 2.0 * to_unit_float(hash(scenario, static_cast<std::uint32_t>(repetition.unknown.size()), i));
    }
    guessed.score = score_from(guesser.guess(query.values, chance));
    return guessed;
  };
  try {
    TuneResult result =
        search_points(input, ask, [&](std::size_t, std::size_t all, const TuneScore&) { repetition.limit = all; });
    // Around a best point that is only guessed nothing needs to be known.
    if (!result.best.cases.empty()) scan_axes(input, result, ask);
  } catch (const FarEnough&) {
    // The rest of this scenario is too improbable.
  }
  return repetition;
}

}  // namespace

NextRound next_round(const SearchInput& input, const KnownPoints& known, std::size_t wanted) {
  TuneGoal goal = input.goal;
  if (const auto before = known.find("before"); before != known.end()) goal = relative_to(goal, before->second.cases);
  Guesser guesser(input);
  for (const auto& [key, record] : known) {
    if (key.starts_with("point")) guesser.learn(record.point, to_number(scored(record, goal).score));
  }
  struct Candidate {
    TuneQuery query;
    std::size_t count = 0;  // scenarios that ask for it
    std::size_t first = 0;  // its earliest place in one of them
  };
  std::map<std::string, Candidate> candidates;
  NextRound round;
  for (std::uint32_t scenario = 0; scenario < scenarios; ++scenario) {
    const Repetition repetition = repeat(input, known, guesser, scenario);
    round.used = repetition.used;
    round.searched = repetition.searched;
    round.limit = repetition.limit;
    if (repetition.unknown.empty()) return round;
    for (std::size_t i = 0; i < repetition.unknown.size(); ++i) {
      const TuneQuery& query = repetition.unknown[i];
      Candidate& candidate = candidates.try_emplace(key_of(query, input.exact), Candidate{query, 0, i}).first->second;
      ++candidate.count;
      candidate.first = std::min(candidate.first, i);
    }
  }
  std::vector<Candidate> sorted;
  for (auto& [key, candidate] : candidates) sorted.push_back(std::move(candidate));
  std::ranges::stable_sort(sorted, [](const Candidate& a, const Candidate& b) {
    return a.count != b.count ? a.count > b.count : a.first < b.first;
  });
  for (Candidate& each : sorted) {
    const bool is_certain = each.count == scenarios;
    const bool is_probable = static_cast<double>(each.count) >= least_probability * scenarios;
    if (!is_certain && (!is_probable || round.points.size() >= wanted)) break;
    round.points.push_back(std::move(each.query));
  }
  // Which constant bias is the best for a relative cost depends on the default's costs.
  const bool waits = input.exact && goal.is_relative && goal.of_default.empty();
  if (waits) round.points = {{TuneQuery::Kind::before, input.given}};
  return round;
}

}  // namespace umbrameter
