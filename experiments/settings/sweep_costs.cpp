#include "experiments/settings/sweep_costs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "experiments/settings/shard_cuts.h"

namespace umbrameter {
namespace {

constexpr std::size_t rest = stage_count;  // behind the stages
constexpr std::size_t most_values = 5;     // of an axis of numbers
constexpr std::size_t parts_of_samples = 8;
constexpr double share_of_all = 0.03;  // of the sweep's time, to which the budget grows
constexpr double most_budgets = 6.0;   // it never grows to more than so many times its value

// The times of stages and rest; negative where one did not run.
using Times = std::vector<double>;

using TimesAlong = std::vector<std::map<std::size_t, Times>>;  // by outer axis and index of its value

struct Samples {
  std::size_t count = 0;
  Times first{};                  // of a process
  std::vector<Times> at_first{};  // later, at the first value of each axis
  TimesAlong along{};             // the other axes at their first values
  std::vector<Times> ran{};       // by outer axis: not negative where it made a stage run
  Times of_whole{};               // of the first group; all others are of parts; empty: not measured
  double piece = 1.0;             // the size of those parts, as a share of the group's cells
  // What depends on several axes is predicted best where it takes most: at those values of them.
  std::vector<std::size_t> corner{};  // index of a value of each outer axis
  Times at_corner{};                  // empty: not yet chosen
  TimesAlong from_corner{};           // the other axes at the corner's values
};

bool is_number(const Value& value) {
  return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
}

// Of an axis of numbers the last value, of one of words all but the first.
std::vector<std::size_t> first_values(const SweepAxis& axis) {
  std::vector<std::size_t> places = {axis.values.size() - 1};
  if (is_number(axis.values.front())) return places;
  for (std::size_t i = 1; i + 1 < axis.values.size(); ++i) places.push_back(i);
  return places;
}

// Of an axis of numbers, if there is time, the most telling ones first.
std::vector<std::size_t> further_values(const SweepAxis& axis) {
  const std::size_t count = axis.values.size();
  std::vector<std::size_t> places;
  if (!is_number(axis.values.front())) return places;
  const auto add = [&](std::size_t place) {
    const bool is_new = std::ranges::find(places, place) == places.end();
    if (place > 0 && place + 1 < count && is_new) places.push_back(place);
  };
  for (const std::size_t place : {count / 2, count / 4, count * 3 / 4}) add(place);
  if (count <= most_values) {
    for (std::size_t i = 1; i + 1 < count; ++i) add(i);
  }
  return places;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[(values.size() - 1) / 2];
}

// Between measured values a time follows a power of the parameter, as with the texels of a map, or else a line.
double between(const SweepAxis& axis, const std::map<std::size_t, double>& known, std::size_t place) {
  const auto after = known.lower_bound(place);
  if (after == known.end()) return known.rbegin()->second;
  if (after->first == place || after == known.begin()) return after->second;
  const auto before = std::prev(after);
  const auto number = [&](std::size_t i) { return to_number(axis.values[i]); };
  const bool is_power = number(before->first) > 0.0 && number(after->first) > 0.0 &&
                        number(before->first) != number(after->first) && before->second > 0.0 && after->second > 0.0;
  if (is_power) {
    const double share =
        std::log(number(place) / number(before->first)) / std::log(number(after->first) / number(before->first));
    return before->second * std::pow(after->second / before->second, share);
  }
  const double share = static_cast<double>(place - before->first) / static_cast<double>(after->first - before->first);
  return before->second + (after->second - before->second) * share;
}

std::vector<double> factors_of(const SweepAxis& axis, const std::map<std::size_t, double>& known) {
  std::vector<double> factors;
  double sum = 0.0;
  for (const auto& [place, factor] : known) sum += factor;
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    const auto found = known.find(i);
    factors.push_back(found != known.end()             ? found->second
                      : is_number(axis.values.front()) ? between(axis, known, i)
                                                       : sum / static_cast<double>(known.size()));
  }
  return factors;
}

bool runs_with(std::size_t part, const std::string& key) {
  return part == rest || depends_on(static_cast<Stage>(part), key);
}

// What runs for the same group again depends on what varies within groups.
bool is_within(const Samples& samples, std::size_t part) {
  return part == rest || (!samples.at_first.empty() && samples.at_first.front()[part] >= 0.0);
}

// Where the first group of a process takes longer, that is its start. Negative if the part did not run.
double at_first(const Samples& samples, std::size_t part) {
  std::vector<double> again;
  for (const Times& times : samples.at_first) {
    if (times[part] >= 0.0) again.push_back(times[part]);
  }
  return again.empty() ? samples.first[part] : median(again);
}

// The times of a part at values of an axis, as multiples of that at the corner's, or `seconds` where it took none
// there.
std::map<std::size_t, double> factors_along(const Samples& samples, std::size_t a, std::size_t part, double seconds,
                                            bool is_cornered) {
  std::map<std::size_t, double> known = {{0, std::max(at_first(samples, part), 0.0)}};
  for (const auto& [place, times] : samples.along[a]) known[place] = std::max(times[part], 0.0);
  const double unit = is_cornered ? known[samples.corner[a]] : seconds;
  for (auto& [place, factor] : known) factor /= unit > 0.0 ? unit : seconds;
  if (!is_cornered) return known;
  known[samples.corner[a]] = 1.0;
  for (const auto& [place, times] : samples.from_corner[a]) {
    if (times[part] >= 0.0) known[place] = times[part] / seconds;
  }
  return known;
}

// Nothing if it never ran.
std::optional<SweepCosts::Part> part_of(const SweepPlan& plan, const Samples& samples, std::size_t part) {
  const bool is_cornered = !samples.at_corner.empty() && samples.at_corner[part] > 0.0;
  double seconds = is_cornered ? samples.at_corner[part] : at_first(samples, part);
  // A stage may run only elsewhere, as that of another technique.
  for (const auto& of_axis : samples.along) {
    for (const auto& [place, times] : of_axis) {
      if (seconds <= 0.0) seconds = times[part];
    }
  }
  if (seconds <= 0.0) return {};
  SweepCosts::Part made{seconds, is_within(samples, part), {}};
  for (std::size_t a = 0; a < plan.outer.size(); ++a) {
    const SweepAxis& axis = plan.axes[plan.outer[a]];
    const bool is_measured = !samples.along[a].empty();
    const bool depends = is_measured ? samples.ran[a][part] >= 0.0 : runs_with(part, axis.key);
    if (axis.values.size() == 1 || !depends) {
      made.factors.emplace_back();
    } else {
      made.factors.push_back(factors_of(axis, factors_along(samples, a, part, seconds, is_cornered)));
    }
  }
  return made;
}

Times times_of(GroupTime time) {
  time.of_stage.push_back(time.rest);
  return std::move(time.of_stage);
}

double sum_of(const Times& times) {
  double sum = 0.0;
  for (const double seconds : times) sum += std::max(seconds, 0.0);
  return sum;
}

// Where no sample varies an axis, the declared inputs of the stages say what depends on it.
SweepCosts costs_from(const SweepPlan& plan, const Samples& samples) {
  SweepCosts costs;
  costs.measured = samples.count;
  double within = 0.0;
  double within_piece = 0.0;
  for (std::size_t part = 0; part <= rest; ++part) {
    std::optional<SweepCosts::Part> made = part_of(plan, samples, part);
    if (!made) continue;
    const double first = std::max(at_first(samples, part), 0.0);
    costs.start_seconds += std::max(samples.first[part] - first, 0.0);
    if (made->is_within && samples.piece < 1.0 && first > 0.0) {
      // Without a measurement as if each cell took as long.
      const double whole = samples.of_whole.empty() ? first / samples.piece : std::max(samples.of_whole[part], first);
      made->seconds *= whole / first;
      within_piece += first;
      within += whole;
    }
    costs.parts.push_back(std::move(*made));
  }
  if (within > 0.0) {
    costs.piece = samples.piece;
    costs.share_of_piece = std::clamp(within_piece / within, costs.piece, 1.0);
  }
  return costs;
}

// Measures groups until its time is spent.
class GroupSampler {
 public:
  GroupSampler(SweepPlan plan, double budget, const MeasureGroup& measure)
      : given_(plan), whole_(group_at(plan, 0)), plan_(std::move(plan)), least_budget_(budget), measure_(measure) {
    // Parts of groups take less time, and stages as long as for the whole.
    cut_groups(plan_, parts_of_group(plan_) * parts_of_samples);
    first_ = group_at(plan_, 0);
    samples_.piece = static_cast<double>(first_.size()) / static_cast<double>(whole_.size());
    std::size_t step = parts_of_group(plan_);
    steps_.resize(plan_.outer.size());
    for (std::size_t a = plan_.outer.size(); a-- > 0;) {
      steps_[a] = step;
      step *= axis(a).values.size();
    }
    samples_.along.resize(plan_.outer.size());
    samples_.from_corner.resize(plan_.outer.size());
    samples_.ran.assign(plan_.outer.size(), Times(rest + 1, -1.0));
  }

  Samples take() {
    samples_.first = sample(first_);
    measure_first();
    if (has_time() && samples_.piece < 1.0) samples_.of_whole = sample(whole_);
    // The innermost axis first: its changes are the most frequent ones.
    for (std::size_t a = steps_.size(); a-- > 0;) measure_axis(a);
    measure_first();  // now what depends on the last axis runs there too
    // The rest of the time tells how the axes act on each other. Without it the time of all is a guess.
    set_budget();
    find_corner();
    for (std::size_t i = 0; i < most_values; ++i) {
      set_budget();
      for (std::size_t a = steps_.size(); a-- > 0;) measure_from_corner(a, i);
    }
    return std::move(samples_);
  }

 private:
  const SweepAxis& axis(std::size_t a) const { return plan_.axes[plan_.outer[a]]; }
  bool has_time() const { return spent_ < budget_; }
  void set_budget() {
    const double all = GroupCosts(costs_from(given_, samples_), given_).seconds(0, count_groups(given_));
    budget_ = std::clamp(share_of_all * all, least_budget_, most_budgets * least_budget_);
  }

  Times sample(const CellGroup& group) {
    Times times = times_of(measure_(group));
    spent_ += sum_of(times);
    ++samples_.count;
    return times;
  }
  Times sample_at(std::size_t a, std::size_t place) { return sample(group_at(plan_, place * steps_[a])); }

  void measure_first() {
    if (has_time()) samples_.at_first.push_back(sample(first_));
  }

  void measure_axis(std::size_t a) {
    if (axis(a).values.size() == 1) return;
    for (const std::size_t place : first_values(axis(a))) {
      if (!has_time()) break;
      const Times times = sample_at(a, place);
      Times& ran = samples_.ran[a];
      // A stage that does not depend on the axis runs if the axis before it is at its first value again.
      Times& again = samples_.at_first.emplace_back(times);
      for (std::size_t part = 0; part <= rest; ++part) {
        if (!runs_with(part, axis(a).key)) continue;
        ran[part] = std::max(ran[part], times[part]);
        again[part] = -1.0;
      }
      samples_.along[a][place] = times;
    }
  }

  double seconds_within(const Times& times) const {
    double sum = 0.0;
    for (std::size_t part = 0; part <= rest; ++part)
      sum += is_within(samples_, part) ? std::max(times[part], 0.0) : 0.0;
    return sum;
  }

  // The value of an axis that took longest with the first values of the others, and how long.
  std::pair<std::size_t, double> longest_along(std::size_t a) const {
    std::pair<std::size_t, double> longest{0, 0.0};
    for (const auto& [place, times] : samples_.along[a]) {
      if (seconds_within(times) > longest.second) longest = {place, seconds_within(times)};
    }
    return longest;
  }

  // From one axis to the next, those that take longest first: a value moves the corner there if it takes longer with
  // those that moved it before.
  void find_corner() {
    samples_.corner.assign(steps_.size(), 0);
    samples_.at_corner.resize(rest + 1);
    for (std::size_t part = 0; part <= rest; ++part) samples_.at_corner[part] = at_first(samples_, part);
    std::vector<std::size_t> order;
    for (std::size_t a = 0; a < steps_.size(); ++a) order.push_back(a);
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t a) { return longest_along(a).second; });
    for (const std::size_t a : order) {
      const auto [place, seconds] = longest_along(a);
      if (place == 0 || !has_time()) continue;
      const bool is_known = corner_ == 0;
      const Times times = is_known ? samples_.along[a].at(place) : sample(group_at(plan_, corner_ + place * steps_[a]));
      if (seconds_within(times) <= seconds_within(samples_.at_corner)) {
        if (!is_known) samples_.from_corner[a][place] = times;
        continue;
      }
      for (auto& of_axis : samples_.from_corner) of_axis.clear();
      samples_.from_corner[a][0] = samples_.at_corner;
      samples_.corner[a] = place;
      corner_ += place * steps_[a];
      samples_.at_corner = times;
    }
    measure_corner_again();
  }

  // The time there includes the compilation of its shaders, which a shard does once: where it is cheap, it is measured
  // again without.
  void measure_corner_again() {
    if (!(seconds_within(samples_.at_corner) < 0.1 * (budget_ - spent_))) return;
    const Times again = sample(group_at(plan_, corner_));
    for (std::size_t part = 0; part <= rest; ++part) {
      if (again[part] >= 0.0) samples_.at_corner[part] = again[part];
    }
  }

  // The i-th value besides the corner's, the end of an axis of numbers first.
  void measure_from_corner(std::size_t a, std::size_t i) {
    std::vector<std::size_t> places = first_values(axis(a));
    places.push_back(0);
    for (const std::size_t place : further_values(axis(a))) places.push_back(place);
    std::erase(places, samples_.corner[a]);
    if (axis(a).values.size() == 1 || i >= places.size() || !has_time()) return;
    if (samples_.from_corner[a].contains(places[i])) return;
    const std::size_t group = corner_ - samples_.corner[a] * steps_[a] + places[i] * steps_[a];
    samples_.from_corner[a][places[i]] = sample(group_at(plan_, group));
  }

  SweepPlan given_;
  CellGroup whole_;
  SweepPlan plan_;
  double least_budget_;
  double budget_ = least_budget_;
  const MeasureGroup& measure_;
  CellGroup first_{};
  std::vector<std::size_t> steps_;  // for each outer axis: groups from one value to the next
  std::size_t corner_ = 0;          // index of its group
  double spent_ = 0.0;
  Samples samples_;
};

}  // namespace

SweepCosts measure_costs(const SweepPlan& plan, double budget, const MeasureGroup& measure) {
  return costs_from(plan, GroupSampler(plan, budget, measure).take());
}

}  // namespace umbrameter
