#include "reports/figures/plot_ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace umbrameter {
namespace {

constexpr std::size_t most = 9;   // ticks that a reader takes in, and that fit beside each other
constexpr std::size_t least = 3;  // that show the scale to be logarithmic
constexpr double slack = 1e-9;    // a tick at an end of the range is within it

const std::vector<double> coarse = {1.0, 2.0, 5.0};
const std::vector<double> fine = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};

// 5 / 100 is the double nearest to 0.05; 5 · 0.01 need not be.
double scaled(double digit, int power) {
  return power < 0 ? digit / std::pow(10.0, -power) : digit * std::pow(10.0, power);
}

int power_of(double value) { return static_cast<int>(std::floor(std::log10(value) + slack)); }

bool is_within(double tick, double lowest, double highest) {
  return tick >= lowest * (1.0 - slack) && tick <= highest * (1.0 + slack);
}

std::vector<double> within(std::vector<double> ticks, double lowest, double highest) {
  std::erase_if(ticks, [&](double tick) { return !is_within(tick, lowest, highest); });
  return ticks;
}

// Of ascending ticks those from the last at or below `lowest` to the first at or above `highest`.
std::vector<double> about(std::vector<double> ticks, double lowest, double highest) {
  const auto last = std::ranges::find_if(ticks, [&](double tick) { return tick >= highest * (1.0 - slack); });
  ticks.erase(last == ticks.end() ? last : last + 1, ticks.end());
  const auto first = std::ranges::find_if(ticks, [&](double tick) { return tick > lowest * (1.0 + slack); });
  ticks.erase(ticks.begin(), first == ticks.begin() ? first : first - 1);
  return ticks;
}

std::vector<double> digits_about(const std::vector<double>& digits, double lowest, double highest) {
  std::vector<double> ticks;
  for (int power = power_of(lowest); power <= power_of(highest) + 1; ++power) {
    for (const double digit : digits) ticks.push_back(scaled(digit, power));
  }
  return about(std::move(ticks), lowest, highest);
}

// At even steps of 1, 2 or 5 times a power of ten: on so short a range a logarithm is nearly straight.
std::vector<double> steps_about(double lowest, double highest) {
  const double longest = (highest - lowest) / static_cast<double>(least);
  const int power = power_of(longest);
  const double digit = longest >= scaled(5.0, power) ? 5.0 : longest >= scaled(2.0, power) ? 2.0 : 1.0;
  const auto first = static_cast<std::int64_t>(std::floor(lowest / scaled(digit, power) * (1.0 + slack)));
  std::vector<double> ticks;
  for (std::int64_t i = std::max<std::int64_t>(1, first); ticks.empty() || ticks.back() < highest * (1.0 - slack);
       ++i) {
    ticks.push_back(scaled(digit * static_cast<double>(i), power));
  }
  return ticks;
}

// Ticks over the range, the first and last of them at its ends or outside.
std::vector<double> ticks_about(double lowest, double highest) {
  std::vector<double> ticks = digits_about(coarse, lowest, highest);
  if (within(ticks, lowest, highest).size() >= least) return ticks;
  ticks = digits_about(fine, lowest, highest);
  return ticks.size() > least ? ticks : steps_about(lowest, highest);
}

// Powers of ten, with steps of as many decades as it takes.
std::vector<double> thinned(const std::vector<double>& ticks) {
  if (ticks.size() <= most) return ticks;
  std::vector<double> powers;
  for (int step = 1; powers.empty() || powers.size() > most; ++step) {
    powers.clear();
    for (int power = power_of(ticks.front()); power <= power_of(ticks.back()); ++power) {
      if (power % step == 0 && is_within(scaled(1.0, power), ticks.front(), ticks.back())) {
        powers.push_back(scaled(1.0, power));
      }
    }
  }
  return powers;
}

}  // namespace

std::vector<double> log_ticks(double lowest, double highest) {
  return thinned(within(ticks_about(lowest, highest), lowest, highest));
}

TickedRange log_range(double lowest, double highest) {
  const std::vector<double> all = ticks_about(lowest, highest);
  // Between 2 and 5 the scale need not go on to 5.
  const std::vector<double> near = digits_about(fine, lowest, highest);
  TickedRange range{std::max(all.front(), near.front()), std::min(all.back(), near.back()), {}};
  range.ticks = within(thinned(all), range.first, range.last);
  // The ends have ticks, too, where these do not crowd their neighbours.
  constexpr double room = 0.07;  // of the axis
  const double decades = std::log10(range.last / range.first);
  if (std::log10(range.ticks.front() / range.first) >= room * decades) {
    range.ticks.insert(range.ticks.begin(), range.first);
  }
  if (std::log10(range.last / range.ticks.back()) >= room * decades) range.ticks.push_back(range.last);
  return range;
}

TickedRange square_root_range(double highest, double length, bool is_horizontal) {
  constexpr double digit_width = 7.5;  // [units]
  constexpr double line_height = 18.0;
  constexpr double gap = 8.0;
  TickedRange range{0.0, digits_about(fine, highest, highest).back(), {0.0}};
  const auto has_room = [&](double a, double b) {
    const double distance = length * (std::sqrt(b / range.last) - std::sqrt(a / range.last));
    const auto digits = static_cast<double>(fmt::format("{:g}{:g}", a, b).size());
    return distance >= (is_horizontal ? 0.5 * digit_width * digits + gap : line_height);
  };
  constexpr double least_share = 1e-4;  // its root has the room of no label
  for (const double tick : digits_about(coarse, least_share * range.last, range.last)) {
    if (tick < range.last && has_room(range.ticks.back(), tick)) range.ticks.push_back(tick);
  }
  while (range.ticks.size() > 1 && !has_room(range.ticks.back(), range.last)) range.ticks.pop_back();
  range.ticks.push_back(range.last);
  return range;
}

const char* log_tick_label(const std::vector<double>& ticks) {
  const auto is_long = [](double tick) { return tick < 0.999e-3 || tick > 0.999e6; };
  return std::ranges::any_of(ticks, is_long) ? "replace(format(datum.value, '~e'), '+', '')"
                                             : "format(datum.value, '~g')";
}

}  // namespace umbrameter
