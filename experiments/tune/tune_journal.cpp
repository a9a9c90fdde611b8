#include "experiments/tune/tune_journal.h"

#include <cerrno>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "reports/files/output.h"
#include "reports/files/value_json.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

std::string line_of(const std::string& key, const TuneRecord& record) {
  Json line = {{"key", key}, {"point", Json::array()}, {"cases", record.cases}};
  for (const Value& value : record.point) line["point"].push_back(to_json(value));
  return line.dump() + "\n";
}

// Nothing for a line that was cut off.
std::optional<std::pair<std::string, TuneRecord>> parse_line(const std::string& text) {
  try {
    const Json line = Json::parse(text);
    TuneRecord record;
    for (const Json& value : line.at("point")) record.point.push_back(to_value(value));
    for (const Json& of_case : line.at("cases")) {
      CaseValues& values = record.cases.emplace_back();
      for (const Json& value : of_case) values.push_back(to_number(to_value(value)));
    }
    return std::pair(line.at("key").get<std::string>(), std::move(record));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

void require_same(const std::filesystem::path& path, const Json& stored,
                  const std::vector<std::pair<std::string, std::string>>& settings) {
  for (const auto& [name, value] : settings) {
    const std::string before = stored.is_object() ? stored.value(name, "") : "";
    if (before == value) continue;
    throw Error(ExitCode::usage, path.string(), "it holds another tuning: " + name + " differs",
                "choose another folder with -o, or start over with --force");
  }
}

}  // namespace

TunePoint scored(const TuneRecord& record, const TuneGoal& goal) {
  return {record.point, record.cases, score_of(goal, record.point, record.cases)};
}

TuneJournal::TuneJournal(const std::filesystem::path& path,
                         const std::vector<std::pair<std::string, std::string>>& settings)
    : path_(path) {
  Json header = Json::object();
  for (const auto& [name, value] : settings) header[name] = value;
  std::string kept = json_text(header) + "\n";
  std::ifstream earlier(path);
  std::string line;
  if (earlier && std::getline(earlier, line)) {
    require_same(path, Json::parse(line, nullptr, false), settings);
    while (std::getline(earlier, line)) {
      std::optional<std::pair<std::string, TuneRecord>> parsed = parse_line(line);
      if (!parsed) break;
      kept += line + "\n";
      records_.insert(std::move(*parsed));
    }
  }
  write_text(path, kept);  // without a line that was cut off
  file_.open(path, std::ios::app | std::ios::binary);
  if (!file_) throw_write_error(path, errno);
}

const TuneRecord* TuneJournal::find(const std::string& key) const {
  const auto found = records_.find(key);
  return found == records_.end() ? nullptr : &found->second;
}

const TuneRecord& TuneJournal::add(const std::string& key, TuneRecord record) {
  errno = 0;
  file_ << line_of(key, record) << std::flush;
  if (!file_) throw_write_error(path_, errno);
  return records_.insert_or_assign(key, std::move(record)).first->second;
}

}  // namespace umbrameter
