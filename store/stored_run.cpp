#include "store/stored_run.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "reports/files/output.h"
#include "store/run_record.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// The values by the names of the statistics' columns. A number that is undefined is null.
AoStageStatistics ao_stages_of(const Json& values) {
  AoStageStatistics statistics;
  std::vector<std::string> names;
  std::vector<Value> row;
  for (const Column& column : columns_of(statistics)) {
    const Json& value = values.at(column.name);
    names.push_back(column.name);
    if (column.name == pixels_statistic) {
      row.emplace_back(value.get<std::int64_t>());
    } else {
      row.emplace_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
    }
  }
  RowReader(describe(statistics), names).read(row);
  return statistics;
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

}  // namespace

StoredRun read_stored_run(const std::filesystem::path& folder) {
  StoredRun run;
  run.statistics = read_run(folder);
  // "out/" and "." are named like the folders that they mean.
  run.name = run_name(folder);
  const Json summary = Json::parse(*text_of_file(folder / "summary.json"), nullptr, false);
  try {
    run.scene = summary.value("/scene/name"_json_pointer, "");
    run.command = summary.value("command", "");
    const Json parameters = summary.value("parameters", Json::object());
    for (const auto& [key, value] : parameters.items()) {
      run.parameters.emplace_back(key, text_of(value));
    }
    run.environment.emplace_back("version", summary.value("/program/version"_json_pointer, ""));
    for (const auto& [key, name] : {std::pair("camera", "camera"), std::pair("embree", "Embree"),
                                    std::pair("opengl", "OpenGL"), std::pair("engine", "engine")}) {
      run.environment.emplace_back(name, summary.value(key, ""));
    }
    for (const Json& shadow : summary.value("shadows", Json::array())) {
      run.layers[shadow.value("light", "")] = shadow.value("layer", "");
    }
    const auto ao_stages = "/ao/stages/statistics"_json_pointer;
    if (summary.contains(ao_stages)) run.ao_stages = ao_stages_of(summary.at(ao_stages));
  } catch (const Json::exception&) {
    throw Error(ExitCode::unreadable_input, (folder / "summary.json").string(), "is damaged");
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(folder / "images.exr", error)) run.images = read_exr(folder / "images.exr");
  return run;
}

}  // namespace umbrameter
