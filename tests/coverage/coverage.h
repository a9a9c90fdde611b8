// How often intervals hold what they are about: the rows of the table, and what is measured.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/statistics.h"

namespace umbrameter::coverage {

struct Options {
  int seeds = 300;
  int rays = 16384;  ///< of the value that the intervals of sampled references should hold
  std::string only;  ///< part of a case's name

  bool selects(const std::string& name) const { return name.find(only) != std::string::npos; }
};

/// One statistic over all seeds, or over all views.
inline void print_row(const std::string& name, const std::string& statistic, const std::vector<Estimate>& estimates,
                      double truth) {
  int low = 0;
  int high = 0;
  double sum = 0.0;
  double squares = 0.0;
  double width = 0.0;
  for (const Estimate& each : estimates) {
    low += each.upper < truth ? 1 : 0;
    high += each.lower > truth ? 1 : 0;
    sum += each.value - truth;
    squares += (each.value - truth) * (each.value - truth);
    width += 0.5 * (each.upper - each.lower);
  }
  if (!(width > 0.0)) return;  // nothing of it is sampled
  const auto count = static_cast<double>(estimates.size());
  const double mean = sum / count;
  const double scatter = std::sqrt(std::max(squares / count - mean * mean, 0.0));
  fmt::print("| {} | `{}` | {:.5f} | {:+.5f} | {:.5f} | {:.5f} | {} | {:.1f} % | {} | {} |\n", name, statistic, truth,
             mean, 1.96 * scatter, width / count, estimates.size(), 100.0 * (1.0 - (low + high) / count), low, high);
  std::fflush(stdout);
}

/// `measure` returns a struct of statistics from the rays of a seed; `truth` is that of very many rays.
template <class Measure>
void print_seeds(const std::string& name, int seeds, Statistics truth, const Measure& measure) {
  std::erase_if(truth, [](const Statistic& each) { return !each.has_interval(); });
  std::vector<std::vector<Estimate>> estimates(truth.size());
  for (int seed = 1; seed <= seeds; ++seed) {
    auto measured = measure(static_cast<std::uint32_t>(seed));
    std::size_t t = 0;
    for (const Statistic& each : describe(measured)) {
      if (each.has_interval()) estimates[t++].push_back(*std::get<Estimate*>(each.field));
    }
  }
  for (std::size_t t = 0; t < truth.size(); ++t) {
    print_row(name, truth[t].name, estimates[t], std::get<Estimate*>(truth[t].field)->value);
  }
}

/// Intervals of `compare`: the same surfels with other rays. Needs no OpenGL.
void measure_rays(const Options& options);
/// The same of results that the GPU draws: the stages of ambient occlusion and the shaded image.
void measure_rays_of_drawn(const Options& options);
/// Intervals of `report` and `tune`: other views of one kind of scene.
void measure_views(const Options& options);

}  // namespace umbrameter::coverage
