#include "present/shard_page.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

using Kind = ShardState::Kind;

constexpr std::size_t most_warnings = 20;

std::string seconds_text(double seconds) { return time_text(std::ceil(seconds)); }

bool runs_again(const ShardState& state) { return state.kind == Kind::failed || state.kind == Kind::lost; }

// What the machines have done, and how far it went by the plan.
struct Done {
  std::size_t shards = 0;
  double planned = 0.0;
  double measured = 0.0;
};

struct Sums {
  std::array<std::size_t, 5> counts{};  // by Kind
  std::array<double, 5> planned{};      // by Kind, seconds
  double all = 0.0;                     // planned seconds
  double done = 0.0;                    // planned seconds of what is done, running shards in part
  std::map<std::string, Done> by_host{};

  std::size_t count(Kind kind) const { return counts[static_cast<std::size_t>(kind)]; }
};

Sums sums_of(const ShardPlan& plan, const std::vector<ShardState>& states) {
  Sums sums;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ShardState& state = states[i];
    const double planned = plan.shards[i].seconds;
    const auto kind = static_cast<std::size_t>(state.kind);
    ++sums.counts[kind];
    sums.planned[kind] += planned;
    sums.all += planned;
    if (state.kind == Kind::running) sums.done += planned * state.share;
    if (state.kind != Kind::done) continue;
    sums.done += planned;
    Done& done = sums.by_host[state.host];
    ++done.shards;
    done.planned += planned;
    done.measured += state.seconds;
  }
  return sums;
}

ReportSection progress_section(const Sums& sums, const std::vector<ShardState>& states, const ShardProgress& progress) {
  ReportSection section;
  section.title = "Progress";
  const double all = std::max(sums.all, 1e-9);
  const auto share = [&](Kind kind) { return sums.planned[static_cast<std::size_t>(kind)] / all; };
  const double of_running = sums.done / all - share(Kind::done);
  section.bar = {
      {"done", share(Kind::done)}, {"running", of_running}, {"failed", share(Kind::failed) + share(Kind::lost)}};
  section.headlines = {
      {"done", fmt::format("{} of {}", grouped(sums.count(Kind::done)), grouped(states.size())), "shards"},
      {"measured", fmt::format("{:.0f} %", std::floor(100.0 * sums.done / all)), "of the planned time"},
      {"running", grouped(sums.count(Kind::running)), "shards"},
      {"failed or lost", grouped(sums.count(Kind::failed) + sums.count(Kind::lost)), "shards"},
      {"waiting", grouped(sums.count(Kind::waiting)), "shards"},
      {"left", progress.seconds_left < 0.0 ? "—" : seconds_text(progress.seconds_left),
       progress.seconds_left < 0.0 ? "no shard runs" : "until " + progress.end}};
  section.text =
      "The bar shows the planned time: done, running and failed. The time left assumes that as many shards run "
      "as now, each at the mean pace of those that are done.";
  return section;
}

ReportSection problems_section(const std::vector<ShardState>& states) {
  ReportSection section;
  section.title = "Failed and lost";
  Table table{{{"shard", "1", ""}, {"state", "1", ""}, {"host", "1", ""}, {"why", "1", "first line of the error"}}, {}};
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ShardState& state = states[i];
    if (!runs_again(state)) continue;
    table.rows.push_back({std::to_string(i), name_of(state.kind), state.host, problem_of(state)});
  }
  section.tables.push_back({"Shards to run again", std::move(table), {}});
  return section;
}

ReportSection machines_section(const Sums& sums) {
  ReportSection section;
  section.title = "Machines";
  Table table{{{"host", "1", ""},
               {"shards", "1", "that are done"},
               {"measured", "s", "time of these shards"},
               {"planned", "s", "time of these shards on the machine that planned"},
               {"measured / planned", "1", ""}},
              {}};
  for (const auto& [host, done] : sums.by_host) {
    table.rows.push_back({host, static_cast<std::int64_t>(done.shards), fmt::format("{:.0f}", done.measured),
                          fmt::format("{:.0f}", done.planned),
                          done.planned > 0.0 ? fmt::format("{:.2f}", done.measured / done.planned) : ""});
  }
  section.tables.push_back({"Shards that are done, by machine", std::move(table), {}});
  return section;
}

// Those that run first: of many shards a page lists only the first ones.
ReportSection shards_section(const ShardPlan& plan, const std::vector<ShardState>& states) {
  ReportSection section;
  section.title = "Shards";
  Table table{{{"shard", "1", ""},
               {"state", "1", ""},
               {"share", "%", "that is measured"},
               {"planned", "s", ""},
               {"took", "s", ""},
               {"host", "1", ""}},
              {}};
  for (const Kind kind : {Kind::running, Kind::failed, Kind::lost, Kind::done, Kind::waiting}) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const ShardState& state = states[i];
      if (state.kind != kind) continue;
      table.rows.push_back({std::to_string(i), name_of(kind),
                            kind == Kind::waiting ? "" : fmt::format("{:.0f}", 100.0 * state.share),
                            fmt::format("{:.1f}", plan.shards[i].seconds),
                            kind == Kind::done ? fmt::format("{:.1f}", state.seconds) : "", state.host});
    }
  }
  section.tables.push_back({"All shards, those that run first", std::move(table), {}});
  return section;
}

}  // namespace

const char* name_of(ShardState::Kind kind) {
  constexpr std::array names = {"waiting", "running", "done", "failed", "lost"};
  return names[static_cast<std::size_t>(kind)];
}

std::string problem_of(const ShardState& state) {
  return state.kind == Kind::lost ? fmt::format("no sign from {} for 5 minutes", state.host) : state.problem;
}

Report shard_report(const ShardPlan& plan, const std::vector<ShardState>& states, const ShardProgress& progress) {
  const Sums sums = sums_of(plan, states);
  Report report;
  report.title =
      fmt::format("{}: {} of {} shards done", progress.name, grouped(sums.count(Kind::done)), grouped(states.size()));
  const std::string round = plan.tuning ? fmt::format("round {}; ", plan.tuning->rounds.size()) : "";
  report.subtitle = fmt::format("{}{} cells; seen at {}", round, grouped(plan.cells), progress.time);
  report.command = progress.retry;
  report.command_title = "Run failed and lost shards again";
  const std::size_t problems = sums.count(Kind::failed) + sums.count(Kind::lost);
  if (problems > 0) {
    report.warning_title = fmt::format("{} shard{} failed or lost", grouped(problems), problems == 1 ? "" : "s");
    for (std::size_t i = 0; i < states.size() && report.warnings.size() < most_warnings; ++i) {
      if (!runs_again(states[i])) continue;
      report.warnings.push_back(fmt::format("shard {}, {}: {}", i, name_of(states[i].kind), problem_of(states[i])));
    }
    if (problems > most_warnings) {
      report.warnings.push_back(fmt::format("and {} more, in the table below", grouped(problems - most_warnings)));
    }
  }
  report.sections.push_back(progress_section(sums, states, progress));
  if (problems > 0) report.sections.push_back(problems_section(states));
  if (!sums.by_host.empty()) report.sections.push_back(machines_section(sums));
  report.sections.push_back(shards_section(plan, states));
  return report;
}

}  // namespace umbrameter
