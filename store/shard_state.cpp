#include "store/shard_state.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "reports/files/output.h"
#include "store/merge_shards.h"
#include "store/run_record.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::chrono::seconds renewed_after{5};
constexpr const char* running = "running";
constexpr const char* failed = "failed";

ShardState state_of(const fs::path& folder, const ShardPlan& plan, std::size_t shard) {
  using Kind = ShardState::Kind;
  const fs::path result = shard_file(folder, shard);
  std::string problem;
  if (is_there(result)) {
    try {
      const ShardManifest manifest = read_manifest(result);
      problem = objection_to(manifest, plan, shard);
      if (problem.empty()) return {Kind::done, 1.0, manifest.seconds, manifest.host};
      problem = result.string() + ": " + problem;
    } catch (const Error& error) {
      problem = error.what();
    }
  }
  std::error_code error;
  const fs::path mark = shard_file(folder, shard, running);
  const auto renewed = fs::last_write_time(mark, error);
  if (!error) {
    const Json json = Json::parse(text_of_file(mark).value_or(""), nullptr, false);
    const bool is_whole = json.is_object() && json.contains("host") && json["host"].is_string() &&
                          json.contains("share") && json["share"].is_number();
    const bool is_lost = fs::file_time_type::clock::now() - renewed > lost_after;
    return {is_lost ? Kind::lost : Kind::running, is_whole ? json["share"].get<double>() : 0.0, 0.0,
            is_whole ? json["host"].get<std::string>() : ""};
  }
  if (const std::optional<std::string> why = text_of_file(shard_file(folder, shard, failed))) problem = *why;
  if (!problem.empty()) return {Kind::failed, 0.0, 0.0, {}, problem.substr(0, problem.find('\n'))};
  return {};
}

}  // namespace

RunningMark::RunningMark(const fs::path& folder, std::size_t shard) : folder_(folder), shard_(shard) {
  std::error_code ignored;
  fs::remove(shard_file(folder_, shard_, failed), ignored);
  show(0.0);
}

RunningMark::~RunningMark() {
  std::error_code ignored;
  fs::remove(shard_file(folder_, shard_, running), ignored);
}

void RunningMark::show(double share) {
  const auto now = std::chrono::steady_clock::now();
  if (share > 0.0 && now - shown_ < renewed_after) return;
  shown_ = now;
  const Json json = {{"host", host_name()}, {"process", getpid()}, {"share", share}};
  write_text(shard_file(folder_, shard_, running), json.dump() + "\n");
}

void RunningMark::fail(const std::string& why) { write_text(shard_file(folder_, shard_, failed), why + "\n"); }

std::vector<ShardState> shard_states(const fs::path& folder, const ShardPlan& plan) {
  std::vector<ShardState> states;
  for (std::size_t shard = 0; shard < plan.shards.size(); ++shard) states.push_back(state_of(folder, plan, shard));
  return states;
}

double seconds_left(const ShardPlan& plan, const std::vector<ShardState>& states) {
  double planned = 0.0;   // of those that are done
  double measured = 0.0;  // the same shards in fact
  double left = 0.0;
  std::size_t running_now = 0;
  for (std::size_t shard = 0; shard < states.size(); ++shard) {
    const ShardState& state = states[shard];
    if (state.kind == ShardState::Kind::done) {
      planned += plan.shards[shard].seconds;
      measured += state.seconds;
    } else {
      left += plan.shards[shard].seconds * (1.0 - state.share);
    }
    if (state.kind == ShardState::Kind::running) ++running_now;
  }
  if (running_now == 0) return -1.0;
  const double pace = planned > 0.0 && measured > 0.0 ? measured / planned : 1.0;
  return left * pace / static_cast<double>(running_now);
}

}  // namespace umbrameter
