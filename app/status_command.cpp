#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>

#include "app/planned_folder.h"
#include "app/print_json.h"
#include "core/standard_streams.h"
#include "present/shard_page.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "store/shard_state.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Kind = ShardState::Kind;

nlohmann::ordered_json json_of(const ShardPlan& plan, const std::vector<ShardState>& states, double left) {
  nlohmann::ordered_json json;
  for (const char* name : {"done", "running", "waiting", "lost", "failed"}) json[name] = nlohmann::json::array();
  for (std::size_t i = 0; i < states.size(); ++i) json[name_of(states[i].kind)].push_back(i);
  json["seconds_left"] = left < 0.0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(left);
  if (plan.tuning) json["round"] = plan.tuning->rounds.size();
  return json;
}

std::string clock_text(std::time_t time) { return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(time)); }

std::string end_text(double left) {
  return left < 0.0 ? "" : clock_text(std::time(nullptr) + static_cast<std::time_t>(left));
}

void write_status_page(const fs::path& file, const fs::path& folder, const ShardPlan& plan,
                       const std::vector<ShardState>& states, double left) {
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].kind == Kind::failed || states[i].kind == Kind::lost) again.push_back(i);
  }
  ShardProgress progress{fs::absolute(folder).lexically_normal().filename().string(), clock_text(std::time(nullptr)),
                         end_text(left), left, again.empty() ? "" : command_of(folder, shards_text(again))};
  if (progress.name.empty()) progress.name = fs::absolute(folder).lexically_normal().parent_path().filename().string();
  if (file.has_parent_path()) prepare_output_folder(file.parent_path());
  write_page_to(file, shard_report(plan, states, progress));
}

void print_status(const Console& console, const ShardPlan& plan, const std::vector<ShardState>& states, double left) {
  std::array<std::size_t, 5> counts{};
  for (const ShardState& state : states) ++counts[static_cast<std::size_t>(state.kind)];
  const auto count = [&](Kind kind) { return counts[static_cast<std::size_t>(kind)]; };
  const std::string round = plan.tuning ? fmt::format("round {}; ", plan.tuning->rounds.size()) : "";
  std::string text = fmt::format("{}{} of {} shards done", round, count(Kind::done), states.size());
  for (const Kind kind : {Kind::running, Kind::failed, Kind::lost, Kind::waiting}) {
    if (count(kind) > 0) text += fmt::format(", {} {}", count(kind), name_of(kind));
  }
  if (left >= 0.0) text += fmt::format("; about {} left, until {}", time_text(std::ceil(left)), end_text(left));
  if (plan.tuning && count(Kind::done) == states.size()) text += "; merge ends the tuning or plans the next round";
  print_line(console, text);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const ShardState& state = states[i];
    if (state.kind == Kind::running) {
      add_line(console, fmt::format("running {}: {:.0f} % on {}", i, 100.0 * state.share, state.host));
    } else if (const std::string problem = problem_of(state); !problem.empty()) {
      add_line(console, fmt::format("{} {}: {}", name_of(state.kind), i, problem));
    }
  }
}

}  // namespace

ExitCode run_status(const CommandLine& line, const Console& console) {
  const fs::path& folder = line.plan.folder;
  const ShardPlan plan = read_plan(folder);
  const std::vector<ShardState> states = shard_states(folder, plan);
  const double left = seconds_left(plan, states);
  if (!line.output.empty()) write_status_page(line.output, folder, plan, states, left);
  if (line.plan.commands) {
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i].kind != Kind::done) write_to(stdout, command_of(folder, std::to_string(i)) + "\n");
    }
  } else {
    print_json(console, json_of(plan, states, left));
    print_status(console, plan, states, left);
  }
  return ExitCode::ok;
}

}  // namespace umbrameter
