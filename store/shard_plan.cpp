#include "store/shard_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/content_hash.h"
#include "core/error.h"
#include "core/lists.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "reports/files/value_json.h"
#include "store/run_record.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int plan_format = 3;
constexpr const char* plan_key = "umbrameter_plan";
constexpr const char* plan_name = "plan.json";
constexpr const char* experiment_name = "experiment.toml";

std::string hash_of(std::string_view text) { return ContentHash().add(text).hex(); }

Json to_json(const PlannedTuning& tuning) {
  Json costs = Json::array();
  for (const PlannedTuning::Cost& cost : tuning.costs) costs.push_back({cost.reference, cost.evaluation});
  Json rounds = Json::array();
  for (const PlannedRound& round : tuning.rounds) {
    Json points = Json::array();
    for (const PlannedPoint& point : round.points) {
      Json values = Json::array();
      for (const Value& value : point.values) values.push_back(umbrameter::to_json(value));
      points.push_back({point.kind, values});
    }
    rounds.push_back({{"id", round.id}, {"first_shard", round.first_shard}, {"points", points}});
  }
  return {{"options", tuning.options},
          {"cases", tuning.cases},
          {"is_exact", tuning.is_exact},
          {"shards", tuning.shards},
          {"points", tuning.points},
          {"start_seconds", tuning.start_seconds},
          {"costs", costs},
          {"before", tuning.before},
          {"rounds", rounds}};
}

PlannedTuning tuning_of(const Json& json) {
  PlannedTuning tuning;
  tuning.options = json.at("options").get<decltype(tuning.options)>();
  tuning.cases = json.at("cases").get<std::size_t>();
  tuning.is_exact = json.at("is_exact").get<bool>();
  tuning.shards = json.at("shards").get<std::size_t>();
  tuning.points = json.at("points").get<std::size_t>();
  tuning.start_seconds = json.at("start_seconds").get<double>();
  for (const Json& cost : json.at("costs")) {
    tuning.costs.push_back({cost.at(0).get<double>(), cost.at(1).get<double>()});
  }
  tuning.before = json.at("before").get<std::vector<double>>();
  for (const Json& of_round : json.at("rounds")) {
    PlannedRound& round = tuning.rounds.emplace_back();
    round.id = of_round.at("id").get<std::string>();
    round.first_shard = of_round.at("first_shard").get<std::size_t>();
    for (const Json& of_point : of_round.at("points")) {
      PlannedPoint& point = round.points.emplace_back(PlannedPoint{of_point.at(0).get<std::string>()});
      for (const Json& value : of_point.at(1)) point.values.push_back(to_value(value));
    }
  }
  return tuning;
}

Json to_json(const ShardPlan& plan) {
  Json shards = Json::array();
  for (const PlannedShard& shard : plan.shards) shards.push_back({shard.first_group, shard.groups, shard.seconds});
  Json json = {{plan_key, plan_format},
               {"program", plan.program},
               {"command", plan.tuning ? "tune" : "sweep"},
               {"scene_files", plan.scene_files},
               {"presets", plan.presets},
               {"experiment", plan.experiment},
               {"identity", plan.identity},
               {"cells", plan.cells},
               {"parts", plan.parts},
               {"kinds", plan.kinds},
               {"shards", shards}};
  if (plan.tuning) json["tuning"] = to_json(*plan.tuning);
  return json;
}

// One shard a line.
std::string text_of(const ShardPlan& plan) {
  Json json = to_json(plan);
  json["id"] = plan.id;
  std::string text = "{";
  for (const auto& [key, value] : json.items()) {
    text += (text.size() > 1 ? ",\n  " : "\n  ") + Json(key).dump() + ": ";
    if (key != "shards") {
      text += value.dump();
      continue;
    }
    std::string lines;
    for (const Json& shard : value) lines += (lines.empty() ? "\n    " : ",\n    ") + shard.dump();
    text += "[" + lines + "\n  ]";
  }
  return text + "\n}\n";
}

}  // namespace

std::string program_version() { return UMBRAMETER_VERSION; }

void write_plan(const fs::path& folder, ShardPlan& plan, const std::string& experiment) {
  plan.program = program_version();
  plan.experiment = hash_of(experiment);
  if (plan.tuning && plan.tuning->rounds.back().id.empty()) {
    plan.tuning->rounds.back().id = hash_of(to_json(plan).dump());
  }
  plan.id = hash_of(to_json(plan).dump());
  write_text(folder / experiment_name, experiment);
  std::error_code error;
  fs::create_directories(folder / "shards", error);
  if (error) throw_write_error(folder / "shards", error.value());
  write_text(folder / plan_name, text_of(plan));
}

ShardPlan read_plan(const fs::path& folder) {
  const fs::path path = folder / plan_name;
  const auto fail = [&](const std::string& why, const char* remedy = "copy the folder again, or plan again") {
    throw Error(ExitCode::unreadable_input, path.string(), why, remedy);
  };
  const std::optional<std::string> text = text_of_file(path);
  if (!text) fail("there is no plan in this folder", "name a folder that 'umbrameter plan' wrote");
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains(plan_key)) fail("it is damaged");
  ShardPlan plan;
  try {
    plan.program = json.at("program").get<std::string>();
    if (plan.program != program_version() || json.at(plan_key) != plan_format) {
      throw Error(ExitCode::usage, path.string(),
                  fmt::format("umbrameter {} planned it, and this is {}", plan.program, program_version()),
                  "use the version that planned, or plan again");
    }
    plan.id = json.at("id").get<std::string>();
    plan.scene_files = json.at("scene_files").get<std::vector<std::string>>();
    plan.presets = json.at("presets").get<std::vector<std::string>>();
    plan.experiment = json.at("experiment").get<std::string>();
    plan.identity = json.at("identity").get<std::vector<std::pair<std::string, std::string>>>();
    plan.cells = json.at("cells").get<std::size_t>();
    plan.parts = json.at("parts").get<std::size_t>();
    plan.kinds = json.at("kinds").get<std::vector<ValueKind>>();
    for (const Json& shard : json.at("shards")) {
      plan.shards.push_back(
          {shard.at(0).get<std::size_t>(), shard.at(1).get<std::size_t>(), shard.at(2).get<double>()});
    }
    if (json.contains("tuning")) plan.tuning = tuning_of(json["tuning"]);
  } catch (const Json::exception&) {
    fail("it is damaged");
  }
  if (plan.id != hash_of(to_json(plan).dump())) fail("it was changed after planning");
  if (hash_of(text_of_file(folder / experiment_name).value_or("")) != plan.experiment) {
    fail("experiment.toml beside it was changed after planning");
  }
  return plan;
}

const std::string& id_of(const ShardPlan& plan, std::size_t shard) {
  if (!plan.tuning) return plan.id;
  const std::vector<PlannedRound>& rounds = plan.tuning->rounds;
  return std::find_if(rounds.rbegin(), rounds.rend(),
                      [&](const PlannedRound& round) { return round.first_shard <= shard; })
      ->id;
}

void require_planned(const fs::path& folder, const ShardPlan& plan,
                     const std::vector<std::pair<std::string, std::string>>& identity) {
  const std::size_t count = std::max(identity.size(), plan.identity.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](const auto& pairs) {
      return i < pairs.size() ? pairs[i] : std::pair<std::string, std::string>();
    };
    const auto [name, here] = at(identity);
    const auto [planned_name, planned] = at(plan.identity);
    if (name == planned_name && here == planned) continue;
    const std::string what = name == planned_name ? name : planned_name + " or " + name;
    throw Error(
        ExitCode::usage, folder.string(),
        fmt::format("the {} is '{}' in the plan and '{}' here", what, shortened(planned, 60), shortened(here, 60)),
        "run it on the kind of device and with the program and scene that planned, or plan again here");
  }
}

fs::path shard_file(const fs::path& folder, std::size_t shard, const char* extension) {
  return folder / "shards" / fmt::format("{}.{}", shard, extension);
}

std::vector<std::size_t> parse_shards(const std::string& text, std::size_t count) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::usage, "--shard " + shortened(text, 40), why, "write it like 3,7-9, or env for an array job");
  };
  std::vector<std::size_t> shards;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = std::string_view(text).substr(begin, end - begin);
    const std::size_t dash = part.find('-');
    const std::optional<std::size_t> first = parsed<std::size_t>(part.substr(0, dash));
    const std::optional<std::size_t> last = dash == part.npos ? first : parsed<std::size_t>(part.substr(dash + 1));
    if (!first || !last || *last < *first) refuse("it is no list of shards");
    if (*last >= count) refuse(fmt::format("the plan has the shards 0 to {}", count - 1));
    for (std::size_t shard = *first; shard <= *last; ++shard) shards.push_back(shard);
    begin = end + 1;
  }
  std::ranges::sort(shards);
  shards.erase(std::unique(shards.begin(), shards.end()), shards.end());
  return shards;
}

std::string shards_text(const std::vector<std::size_t>& shards) {
  std::string text;
  for (std::size_t i = 0; i < shards.size();) {
    std::size_t last = i;
    while (last + 1 < shards.size() && shards[last + 1] == shards[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(shards[i]);
    if (last > i) text += "-" + std::to_string(shards[last]);
    i = last + 1;
  }
  return text;
}

std::string shard_of_environment() {
  for (const char* variable : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "AWS_BATCH_JOB_ARRAY_INDEX"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr || *value == '\0') continue;
    const std::optional<std::size_t> index = parsed<std::size_t>(value);
    if (!index) throw Error(ExitCode::usage, variable, fmt::format("'{}' is no number", shortened(value, 40)));
    const char* list = std::getenv("UMBRAMETER_SHARDS");
    if (list == nullptr || *list == '\0') return std::to_string(*index);
    const std::vector<std::size_t> shards = parse_shards(list, 10'000'000);
    if (*index < shards.size()) return std::to_string(shards[*index]);
    throw Error(ExitCode::usage, fmt::format("{}={}", variable, *index),
                fmt::format("UMBRAMETER_SHARDS lists only {} shards", shards.size()));
  }
  throw Error(ExitCode::usage, "--shard env",
              "none of SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX and AWS_BATCH_JOB_ARRAY_INDEX is set",
              "start it as a task of an array, or name the shard");
}

}  // namespace umbrameter
